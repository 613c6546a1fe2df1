"""The page that shows the paper's claims beside what was measured, and the tables of all parts."""

from __future__ import annotations

import shutil
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from experiments.paper.part import Part
from experiments.results import machine

HEAD = """# The paper's experiments, and beyond

`make experiment-paper` measures everything on this page, and `ros2_ws/run python -m experiments.paper.run --page` writes it anew. The same
figures for programs, and more of them, are then in `out/experiments/paper/`: `results.json`, CSV files with a column for each median, extreme
or quartile (lengths in metres, times in seconds), pictures.
[paper-to-code.md](paper-to-code.md) says where the paper's ideas live in the code.
"""


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table in Markdown; columns after the first are aligned at the right."""
    rule = ['---', *('--:' for _ in head[1:])]
    lines = [head, rule, *(list(map(str, row)) for row in rows)]
    return '\n'.join(f'| {" | ".join(line)} |' for line in lines)


def write_page(path: Path, parts: Mapping[str, Part], seed: int) -> Path:
    """Write the page, and copy the parts' pictures into ``images`` beside it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    chapters = [HEAD, _where(seed), _claims(parts.values()), _targets(parts.values())]
    for name, part in parts.items():
        chapters.append(f'## {part.title}\n\n{part.text.strip()}\n')
        chapters += [_shown(path.parent, name, part.title, picture) for picture in part.pictures]
    path.write_text('\n'.join(filter(None, chapters)), encoding='utf-8')
    return path


def _where(seed: int) -> str:
    known = machine()
    return (
        f'Measured with seed {seed} on {known["cores"]} cores ({known["cpu"]}), Python '
        f'{known["python"]}. The same seed gives the same counts and lengths on a machine of this kind, but where a '
        'clock ends something: optimised plans, searches given up after their processor time, requests whose time is '
        'spent. On other machines the last digits of numbers may lead to other plans. Times differ everywhere.\n'
    )


def _claims(parts: Iterable[Part]) -> str:
    rows = [f'| {claim.paper} | {claim.measured} |' for part in parts for claim in part.claims]
    if not rows:
        return ''
    head = [
        '## What the paper says, and what was measured',
        '',
        '| the paper | here |',
        '|---|---|',
    ]
    return '\n'.join([*head, *rows, ''])


def _targets(parts: Iterable[Part]) -> str:
    rows = [
        (
            target.name,
            f'{target.value:.4g}',
            f'{"at least" if target.at_least else "at most"} {target.target:g}',
            'yes' if target.met else '**no**',
        )
        for part in parts
        for target in part.targets
    ]
    if not rows:
        return ''
    return '## Targets\n\n' + table(('', 'measured', 'to reach', 'reached'), rows) + '\n'


def _shown(folder: Path, name: str, title: str, picture: Path) -> str:
    images = folder / 'images'
    images.mkdir(exist_ok=True)
    copy = images / f'paper_{name}_{picture.name}'
    shutil.copyfile(picture, copy)
    return f'![{title}](images/{copy.name})\n'
