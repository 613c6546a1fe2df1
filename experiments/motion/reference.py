"""The reference: which of the random requests can be met, and how short a motion can be.

Run it with ``python -m experiments.motion.reference``: it searches each request exhaustively on the
lattice of `lattice`, makes the best ways shorter by `polishing`, and keeps the results beside this
file, in ``references/<world>.json.gz``. The experiment itself only reads them.
"""

from __future__ import annotations

import argparse
import gzip
import json
import math
import multiprocessing
import os
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from experiments.motion.aims import Aim
from experiments.motion.grounds import BINS, FINER_BINS, lattice_of
from experiments.motion.lattice import Lattice
from experiments.motion.polishing import polished
from experiments.motion.requests import Request, draw
from experiments.motion.worlds import ROOT, WORLDS, Place

FOLDER = Path(__file__).resolve().parent / 'references'
SEED = 1
REQUESTS = 1000
#: Requests that are handed to the processes at a time.
BATCH = 40


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


class Searcher:
    """Searches requests of one world, on a finer lattice where the first finds nothing."""

    def __init__(self, place: Place, seed: int) -> None:
        self._place, self._seed = place, seed
        self._lattices = [lattice_of(place, BINS)]

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
        }
        for lattice in self._each_lattice():
            found = lattice.find(request.start, aim)
            told['states'] = told.get('states', 0) + found.states
            told['exhausted'] = found.exhausted
            if found.ways:
                break
        best = math.inf
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


def make(place: Place, count: int, seed: int, processes: int) -> Iterator[Mapping[str, Any]]:
    """Search requests until ``count`` are solved; of each what is known of it."""
    _searchers[:] = [Searcher(place, seed)]
    # Compiled once, before the processes are forked.
    _search(0)
    solved = 0
    with multiprocessing.get_context('fork').Pool(processes) as pool:
        for first in range(0, 100 * count, BATCH):
            for told in pool.imap(_search, range(first, first + BATCH)):
                if solved < count:
                    yield told
                    solved += told['length'] is not None
            print(
                f'{place.name}: {min(first + BATCH, 100 * count)} tried, {solved} solved',
                flush=True,
            )
            if solved == count:
                return


def write(world: str, seed: int, rows: Sequence[Mapping[str, Any]], folder: Path = FOLDER) -> Path:
    """Keep the results of one world."""
    folder.mkdir(parents=True, exist_ok=True)
    solved = [
        {key: row[key] for key in ('number', 'kind', 'start', 'text', 'length')}
        for row in rows
        if row['length'] is not None
    ]
    others = [row for row in rows if row['length'] is None]
    document = {
        'world': world,
        'seed': seed,
        'made_by': 'python -m experiments.motion.reference',
        'unsolved': [row['number'] for row in others if row['exhausted']],
        'unsearched': [row['number'] for row in others if not row['exhausted']],
        'requests': solved,
    }
    path = folder / f'{world}.json.gz'
    text = json.dumps(document, separators=(',', ':'))
    path.write_bytes(gzip.compress(text.encode(), mtime=0))
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
        began = time.perf_counter()
        place = WORLDS[world](ROOT / 'out' / 'experiments' / 'motion')
        rows = list(make(place, arguments.requests, arguments.seed, arguments.processes))
        path = write(world, arguments.seed, rows, arguments.folder)
        others = [row for row in rows if row['length'] is None]
        cut = sum(not row['exhausted'] for row in others)
        print(
            f'{world}: {len(rows) - len(others)} solved, {len(others) - cut} searched exhaustively '
            f'in vain, {cut} broken off, {sum(row["states"] for row in rows) / 1e6:.0f} million '
            f'states, {time.perf_counter() - began:.0f} s, {path}',
            flush=True,
        )


if __name__ == '__main__':
    main()
