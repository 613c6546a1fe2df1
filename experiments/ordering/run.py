"""The local search of tours beside routing libraries, on the same matrices.

Run it with ``make experiment-ordering``. What is not installed of the libraries is left out.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from math import inf
from pathlib import Path

import numpy as np

from experiments.ordering.libraries import LIBRARIES, installed, length_of, whole
from experiments.ordering.matrices import groups_of
from experiments.paper.part import write_csv
from experiments.paper.report import table
from experiments.results import Target, write_results
from motion_planner_node.stopping import never
from motion_planner_node.tours.chains import Groups, best_chain
from motion_planner_node.tours.local_search import LocalSearch

ROOT = Path(__file__).resolve().parents[2]
LOCAL_SEARCH = 'local search'


@dataclass(frozen=True)
class Sizes:
    """How much is measured.

    goals: numbers of photos
    bridges: double bridges of the local search; compared: those to be no longer than the libraries
    seconds: [s] of search of the libraries
    """

    goals: tuple[int, ...]
    bridges: tuple[int, ...]
    compared: int
    seconds: tuple[float, ...]


FULL = Sizes((16, 32, 64, 128), (0, 64, 256, 1024), 64, (1.0, 10.0))
QUICK = Sizes((4, 6), (0, 16), 16, (0.2,))


@dataclass(frozen=True)
class Found:
    """One tour.

    effort: double bridges of the local search, or seconds of a library
    length: [m]; infinite without a tour
    seconds: [s] it took, processor time of the local search, or of a library with building its model
    """

    photos: int
    method: str
    effort: float
    length: float
    seconds: float


def searched(groups: Groups, bridges: Iterable[int], seed: int) -> Iterator[Found]:
    """The tours of the local search; what is compiled at first is not counted."""
    photos = len(groups.sizes) - 1
    LocalSearch(groups, never).tour(None, 1, np.random.default_rng(0))
    for count in bridges:
        began = time.thread_time()
        order = LocalSearch(groups, never).tour(None, count, np.random.default_rng(seed))
        length = float(best_chain(groups, order)[0])
        yield Found(photos, LOCAL_SEARCH, count, length, time.thread_time() - began)


def by_libraries(
    groups: Groups, names: Iterable[str], seconds: Sequence[float], seed: int
) -> Iterator[Found]:
    """The tours of libraries through the same matrix."""
    photos = len(groups.sizes) - 1
    owner = np.repeat(np.arange(photos + 1), groups.sizes)
    for name in names:
        for limit in seconds:
            began = time.perf_counter()
            tour = LIBRARIES[name](whole(groups.costs), owner, limit, seed)
            spent = time.perf_counter() - began
            yield Found(photos, name, limit, length_of(groups.costs, owner, tour), spent)


def targets_of(found: Iterable[Found], compared: int) -> list[Target]:
    """No tour of the local search is longer than the shortest of the libraries in any of their times."""
    own: dict[int, float] = {}
    others: dict[tuple[int, float], float] = {}
    for one in found:
        if one.method != LOCAL_SEARCH:
            key = one.photos, one.effort
            others[key] = min(one.length, others.get(key, inf))
        elif one.effort == compared:
            own[one.photos] = one.length
    return [
        Target(
            f'{photos} photos: local search over the shortest of the libraries, {seconds:g} s',
            own[photos] / length,
            1.0,
        )
        for (photos, seconds), length in others.items()
    ]


def shown(found: Sequence[Found]) -> str:
    """A table with a line for each number of photos."""
    efforts = list(dict.fromkeys((one.method, one.effort) for one in found))
    cells = {(one.photos, one.method, one.effort): one for one in found}
    head = ['photos']
    for method, effort in efforts:
        head.append(f'{method}, {effort:g} {"bridges" if method == LOCAL_SEARCH else "s"}')
    rows = [
        [photos, *(_cell(cells[photos, method, effort]) for method, effort in efforts)]
        for photos in dict.fromkeys(one.photos for one in found)
    ]
    return table(head, rows)


def _cell(one: Found) -> str:
    return f'{one.length:,.0f}' + (f' ({one.seconds:.1f} s)' if one.method == LOCAL_SEARCH else '')


def measure(sizes: Sizes, seed: int, libraries: Mapping[str, str]) -> list[Found]:
    """Find tours in all ways, the small ones first."""
    found: list[Found] = []
    for photos in sizes.goals:
        groups = groups_of(photos, seed)
        found += searched(groups, sizes.bridges, seed)
        found += by_libraries(groups, libraries, sizes.seconds, seed)
        print(f'{photos} photos: done', flush=True)
    return found


def main(arguments: Iterable[str] | None = None) -> None:
    """Run the experiment."""
    parser = argparse.ArgumentParser(description=(__doc__ or '').partition('\n')[0])
    parser.add_argument('--quick', action='store_true', help='small sizes, to try it')
    parser.add_argument('--goals', type=int, action='append', help='only these numbers of photos')
    parser.add_argument('--seed', type=int, default=1, help='of all random choices (default: 1)')
    parser.add_argument(
        '--output', type=Path, default=ROOT / 'out' / 'experiments' / 'ordering', help='folder'
    )
    wanted = parser.parse_args(None if arguments is None else list(arguments))
    sizes = QUICK if wanted.quick else FULL
    sizes = replace(sizes, goals=tuple(wanted.goals or sizes.goals))
    libraries = installed()
    for name in LIBRARIES.keys() - libraries.keys():
        print(f'{name} is not installed and is left out', flush=True)
    found = measure(sizes, wanted.seed, libraries)
    targets = targets_of(found, sizes.compared)
    tours = [asdict(one) for one in found]
    path = write_results(
        wanted.output, wanted.seed, {'libraries': libraries, 'tours': tours}, targets
    )
    write_csv(wanted.output / 'tours.csv', tours)
    print(f'{shown(found)}\nwritten: {path}')
    for target in targets:
        print(target)


if __name__ == '__main__':
    main()
