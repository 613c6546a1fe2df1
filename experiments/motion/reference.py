"""The reference: which of the random requests can be met, and how short a motion can be.

Run it with ``python -m experiments.motion.reference``: it searches each request exhaustively on the
lattice of `lattice`, makes the best ways shorter by `polishing`, and keeps the results beside this
file, in ``references/<world>.json.gz``. The experiment itself only reads them. A run that is
broken off loses no more than the batch it is at: the next one goes on from there, to the same file.
"""

from __future__ import annotations

import argparse
import gzip
import json
import math
import multiprocessing
import os
import time
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path
from typing import Any

from experiments.motion.aims import Aim
from experiments.motion.connected import Parts
from experiments.motion.grounds import BINS, FINER_BINS, lattice_of
from experiments.motion.lattice import Lattice
from experiments.motion.polishing import polished
from experiments.motion.requests import Request, draw
from experiments.motion.worlds import ROOT, WORLDS, Place

FOLDER = Path(__file__).resolve().parent / 'references'
SEED = 1
REQUESTS = 1000
#: Requests that are searched before the results are written.
BATCH = 8


@dataclass(frozen=True)
class Known:
    """A request that can be met, and the length [m] of the shortest way that the reference knows."""

    number: int
    kind: str
    start: tuple[float, float, float]
    text: str
    length: float


@dataclass(frozen=True)
class Reference:
    """What is kept about one world: ``unsolved`` requests were searched exhaustively in vain."""

    world: str
    seed: int
    known: tuple[Known, ...]
    unsolved: tuple[int, ...]
    unsearched: tuple[int, ...]

    @property
    def tried(self) -> int:
        """How many requests were searched: these are the first ones."""
        return len(self.known) + len(self.unsolved) + len(self.unsearched)

    def with_result(self, told: Mapping[str, Any]) -> Reference:
        """The same with what `Searcher.search` says of the next request."""
        number = told['number']
        if told['length'] is None:
            if told['exhausted']:
                return replace(self, unsolved=(*self.unsolved, number))
            return replace(self, unsearched=(*self.unsearched, number))
        known = Known(**{key.name: told[key.name] for key in fields(Known)})
        return replace(self, known=(*self.known, known))


class Searcher:
    """Searches requests of one world, on a finer lattice where the first finds nothing."""

    def __init__(self, place: Place, seed: int) -> None:
        self._place, self._seed = place, seed
        self._lattices = [lattice_of(place, BINS)]
        self._parts = Parts(self.lattice.ground)

    @property
    def lattice(self) -> Lattice:
        """The lattice that is searched first."""
        return self._lattices[0]

    def request(self, number: int) -> Request:
        """A request as it is drawn."""
        return draw(self._place, self.lattice, self._seed, number)

    def search(self, number: int) -> dict[str, Any]:
        """What is known of a request in the end, ready for JSON."""
        request = self.request(number)
        aim = Aim(*request.goal.numbers, request.samples)
        told: dict[str, Any] = {
            'number': number,
            'kind': request.kind,
            'start': request.start.tolist(),
            'text': request.goal.text,
            'length': None,
            'states': 0,
            'exhausted': True,
        }
        if not self._parts.are_joined(request.start, aim):
            return told
        for lattice in self._each_lattice():
            found = lattice.find(request.start, aim)
            told['states'] += found.states
            told['exhausted'] = found.exhausted
            # What is too much for the first lattice is so all the more for a finer one.
            if found.ways or not found.exhausted:
                break
        firsts = [polished(lattice.ground, way, aim, number, rounds=1) for way in found.ways]
        if firsts:
            way, _ = min(firsts, key=lambda pair: pair[1])
            way, best = polished(lattice.ground, way, aim, number)
            told['end'] = [round(float(value), 6) for value in way[-1]]
            told['length'] = round(best, 4) if best < math.inf else None
        return told

    def _each_lattice(self) -> Iterator[Lattice]:
        yield self.lattice
        if len(self._lattices) == 1:
            self._lattices.append(lattice_of(self._place, FINER_BINS))
        yield self._lattices[1]


_searchers: list[Searcher] = []


def _search(number: int) -> dict[str, Any]:
    return _searchers[0].search(number)


def make(
    place: Place, count: int, kept: Reference, processes: int
) -> Iterator[tuple[Reference, int]]:
    """Go on from what is ``kept`` until ``count`` requests are solved.

    After each batch of requests all that is known by then, and how many states it took.
    """
    if len(kept.known) >= count:
        return
    _searchers[:] = [Searcher(place, kept.seed)]
    # Compiled once, before the processes are forked.
    _search(0)
    with multiprocessing.get_context('fork').Pool(processes) as pool:
        for first in range(kept.tried, 100 * count, BATCH):
            states = 0
            for told in pool.imap(_search, range(first, first + BATCH)):
                if len(kept.known) < count:
                    kept = kept.with_result(told)
                    states += told['states']
            yield kept, states
            if len(kept.known) == count:
                return


def write(reference: Reference, folder: Path = FOLDER) -> Path:
    """Keep what is known of one world."""
    folder.mkdir(parents=True, exist_ok=True)
    document = {
        'world': reference.world,
        'seed': reference.seed,
        'made_by': 'python -m experiments.motion.reference',
        'unsolved': reference.unsolved,
        'unsearched': reference.unsearched,
        'requests': [asdict(known) for known in reference.known],
    }
    path = folder / f'{reference.world}.json.gz'
    text = json.dumps(document, separators=(',', ':'))
    # A run that ends while it writes leaves the file before.
    unfinished = path.with_suffix('.part')
    unfinished.write_bytes(gzip.compress(text.encode(), mtime=0))
    unfinished.replace(path)
    return path


def read(world: str, folder: Path = FOLDER) -> Reference:
    """What is kept about a world."""
    document = json.loads(gzip.decompress((folder / f'{world}.json.gz').read_bytes()))
    known = tuple(
        Known(row['number'], row['kind'], tuple(row['start']), row['text'], row['length'])
        for row in document['requests']
    )
    unsolved, unsearched = tuple(document['unsolved']), tuple(document['unsearched'])
    return Reference(world, document['seed'], known, unsolved, unsearched)


def earlier(world: str, seed: int, folder: Path) -> Reference:
    """What earlier runs with this seed found out about a world."""
    if (folder / f'{world}.json.gz').exists():
        reference = read(world, folder)
        if reference.seed == seed:
            return reference
    return Reference(world, seed, (), (), ())


def main() -> None:
    """Search the requests of all worlds."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--world', choices=WORLDS, action='append', help='only this world')
    parser.add_argument('--requests', type=int, default=REQUESTS, help='solved ones per world')
    parser.add_argument('--seed', type=int, default=SEED, help='seed of the requests')
    parser.add_argument('--processes', type=int, default=os.cpu_count(), help='at a time')
    parser.add_argument('--folder', type=Path, default=FOLDER, help='where the results go')
    arguments = parser.parse_args()
    for world in arguments.world or WORLDS:
        began, total = time.perf_counter(), 0
        place = WORLDS[world](ROOT / 'out' / 'experiments' / 'motion')
        before = earlier(world, arguments.seed, arguments.folder)
        for reference, states in make(place, arguments.requests, before, arguments.processes):
            write(reference, arguments.folder)
            total += states
            print(
                f'{world}: {len(reference.known)} solved, {len(reference.unsolved)} searched '
                f'exhaustively in vain, {len(reference.unsearched)} broken off, '
                f'{total / 1e6:.0f} million states, {time.perf_counter() - began:.0f} s',
                flush=True,
            )


if __name__ == '__main__':
    main()
