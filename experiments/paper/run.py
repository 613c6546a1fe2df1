"""The paper's experiments, and what goes beyond them: all parts, one after the other.

Run it with ``make experiment-paper``; ``--page`` also writes docs/paper-experiments.md.
"""

from __future__ import annotations

import argparse
import importlib
import time
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

from experiments.paper.part import Part, write_csv
from experiments.paper.report import write_page
from experiments.results import Target, write_results

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / 'docs' / 'paper-experiments.md'
#: Modules by the names of the parts; each has ``measure(sizes, seed, folder)``, ``FULL`` and ``QUICK``.
PARTS = {
    'worked_example': 'experiments.paper.worked_example',
    'mission': 'experiments.paper.mission',
    'methods': 'experiments.paper.methods.part',
    'messages': 'experiments.paper.messages',
    'growth': 'experiments.paper.growth',
    'missions': 'experiments.paper.missions',
}


def measure(
    names: Iterable[str], *, quick: bool, seed: int, folder: Path, goals: Sequence[int] = ()
) -> dict[str, Part]:
    """Measure parts in the order given; each leaves its files in a folder of its name.

    Parts that are measured at several numbers of goals are so at ``goals``, where these are given.
    """
    parts = {}
    for name in names:
        print(f'{name}: begins', flush=True)
        began = time.perf_counter()
        module = importlib.import_module(PARTS[name])
        own = folder / name
        own.mkdir(parents=True, exist_ok=True)
        sizes = module.QUICK if quick else module.FULL
        if goals and hasattr(sizes, 'goals'):
            sizes = replace(sizes, goals=tuple(sorted(set(goals))))
        parts[name] = module.measure(sizes, seed, own)
        print(f'{name}: done after {time.perf_counter() - began:.0f} s', flush=True)
    return parts


def _photos(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f'a number of photos is at least 1, not {text!r}')
    return int(text)


def main(arguments: Iterable[str] | None = None) -> None:
    """Run the experiment."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        '--only', choices=PARTS, action='append', help='only this part; may be repeated'
    )
    parser.add_argument('--quick', action='store_true', help='small sizes, to try it')
    parser.add_argument(
        '--goals',
        type=_photos,
        action='append',
        metavar='N',
        help='of parts of several sizes only this number of photos; may be repeated',
    )
    parser.add_argument('--seed', type=int, default=1, help='of all random choices (default: 1)')
    parser.add_argument(
        '--output', type=Path, default=ROOT / 'out' / 'experiments' / 'paper', help='folder'
    )
    parser.add_argument(
        '--page',
        type=Path,
        nargs='?',
        const=PAGE,
        help='write the page on the results here, pictures into images/ beside it '
        f'({PAGE.relative_to(ROOT)})',
    )
    wanted = parser.parse_args(None if arguments is None else list(arguments))
    names = [name for name in PARTS if not wanted.only or name in wanted.only]
    parts = measure(
        names,
        quick=wanted.quick,
        seed=wanted.seed,
        folder=wanted.output,
        goals=wanted.goals or (),
    )
    figures = {name: part.figures for name, part in parts.items()}
    targets: list[Target] = [target for part in parts.values() for target in part.targets]
    print(f'written: {write_results(wanted.output, wanted.seed, figures, targets)}')
    write_csv(wanted.output / 'targets.csv', [target.figures() for target in targets])
    if wanted.page:
        print(f'written: {write_page(wanted.page, parts, wanted.seed)}')
    for target in targets:
        print(target)


if __name__ == '__main__':
    main()
