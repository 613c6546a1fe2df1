"""Nonsense in, a sentence out: file, line and column, exit code 2, and the nodes plan on."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.support.missions import ROVER
from tests.support.processes import geohtn

#: [bytes] of the oversized file.
HUGE = 50 * 1024 * 1024


@dataclass(frozen=True)
class Fault:
    """A way to spoil the rover mission, and what the error has to say."""

    name: str
    file: str
    spoil: Callable[[Path], object]
    #: Regular expressions, all of them found in what is printed.
    expected: tuple[str, ...]
    #: Line that the error points at; None where the whole file is at fault.
    line: int | None = None


def replaced(old: str, new: str) -> Callable[[Path], None]:
    def spoil(path: Path) -> None:
        text = path.read_text(encoding='utf-8')
        assert old in text
        path.write_text(text.replace(old, new, 1), encoding='utf-8')

    return spoil


def line_of(file: str, text: str) -> int:
    """The line of the first ``text`` in the good mission's ``file``."""
    lines = (ROVER / file).read_text(encoding='utf-8').splitlines()
    return next(number for number, line in enumerate(lines, 1) if text in line)


#: Encloses every place from which location7 can be photographed; the map's edge closes the south.
WALL = (
    'obstacles:\n'
    '  - {name: wall_n, polygon: [[480, 135], [725, 135], [725, 145], [480, 145]]}\n'
    '  - {name: wall_w, polygon: [[480, 0], [490, 0], [490, 140], [480, 140]]}\n'
    '  - {name: wall_e, polygon: [[712, 0], [722, 0], [722, 140], [712, 140]]}\n'
)
ON_THE_START = (
    'obstacles:\n  - {name: boulder, polygon: [[10, 10], [30, 10], [30, 30], [10, 30]]}\n'
)

FAULTS = [
    Fault('missing file', 'domain.lisp', Path.unlink, ('domain.lisp', 'does not exist')),
    Fault(
        'unbalanced parenthesis',
        'domain.lisp',
        replaced(
            '(rel_angle(?r,?o) = cos-and-sin(pi/2)))', '(rel_angle(?r,?o) = cos-and-sin(pi/2))'
        ),
        (r"'\)' is missing", '!take_photo'),
        line_of('domain.lisp', '(Operator (!take_photo'),
    ),
    Fault(
        'unknown object',
        'problem.lisp',
        replaced('(has_photo_of rover0 location3)', '(has_photo_of rover0 location33)'),
        ('location33',),
        line_of('problem.lisp', '(has_photo_of rover0 location3)'),
    ),
    Fault(
        'object missing in the world',
        'world.yaml',
        replaced('  location3: {x: 362, y: 350}\n', ''),
        ('unknown object', 'location3'),
    ),
    Fault(
        'unknown agent',
        'world.yaml',
        replaced('  rover0:\n', '  rover1:\n'),
        ('rover0',),
    ),
    Fault(
        'unknown function',
        'domain.lisp',
        replaced('(distance(?r, ?o) >= 50)', '(distanse(?r, ?o) >= 50)'),
        ('distanse', 'distance'),
        line_of('domain.lisp', '(distance(?r, ?o) >= 50)'),
    ),
    Fault(
        'unknown property',
        'domain.lisp',
        replaced('(setProperty(?r.x,?o.x))', '(setProperty(?r.z,?o.x))'),
        (r'\bz\b',),
        line_of('domain.lisp', '(setProperty(?r.x,?o.x))'),
    ),
    Fault(
        'unknown comparator',
        'domain.lisp',
        replaced('(distance(?r, ?o) >= 50)', '(distance(?r, ?o) => 50)'),
        ('=>',),
        line_of('domain.lisp', '(distance(?r, ?o) >= 50)'),
    ),
    Fault(
        'operator never defined',
        'domain.lisp',
        replaced('((!take_photo ?r ?o ?c)))', '((!take_picture ?r ?o ?c)))'),
        ('!take_picture', '!take_photo'),
        line_of('domain.lisp', '((!take_photo ?r ?o ?c)))'),
    ),
    Fault(
        'method never defined',
        'problem.lisp',
        replaced('(achieve-goals', '(achieve-gaols'),
        ('achieve-gaols', 'achieve-goals'),
        line_of('problem.lisp', '(achieve-goals'),
    ),
    Fault(
        'wrong number of arguments',
        'domain.lisp',
        replaced('((!take_photo ?r ?o ?c)))', '((!take_photo ?r ?o)))'),
        ('!take_photo', 'argument'),
        line_of('domain.lisp', '((!take_photo ?r ?o ?c)))'),
    ),
    Fault(
        'start inside an obstacle',
        'world.yaml',
        replaced('obstacles:\n', ON_THE_START),
        ('rover0', 'boulder'),
    ),
    Fault(
        'objective walled in',
        'world.yaml',
        replaced('obstacles:\n', WALL),
        ('location7', 'wall'),
    ),
    Fault(
        'contradictory constraints',
        'domain.lisp',
        replaced('(distance(?r, ?o) >= 50)', '(distance(?r, ?o) >= 160)'),
        ('>= 160', '<= 100', 'exclude each other'),
        line_of('domain.lisp', '(distance(?r, ?o) <= 100)'),
    ),
    Fault(
        'coordinate that is not a number',
        'world.yaml',
        replaced('location3: {x: 362', 'location3: {x: .nan'),
        ('location3', 'finite|nan'),
        line_of('world.yaml', 'location3:'),
    ),
    Fault(
        'infinite coordinate',
        'world.yaml',
        replaced('location3: {x: 362', 'location3: {x: -.inf'),
        ('location3', 'finite|inf'),
        line_of('world.yaml', 'location3:'),
    ),
    *(
        Fault(
            f'50 MB of {file}',
            file,
            lambda path: path.write_bytes(b'(' * HUGE),
            ('50.0 MiB', 'at most 1 MiB'),
        )
        for file in ('domain.lisp', 'problem.lisp', 'world.yaml')
    ),
    *(
        Fault(
            f'binary garbage in {file}',
            file,
            lambda path: path.write_bytes(bytes(range(256)) * 40),
            ('UTF-8|text|character',),
        )
        for file in ('domain.lisp', 'problem.lisp', 'world.yaml')
    ),
]


@pytest.fixture
def mission(tmp_path: Path) -> Path:
    """A copy of the rover mission that a test may spoil."""
    return Path(shutil.copytree(ROVER, tmp_path / 'mission'))


@pytest.mark.parametrize('fault', FAULTS, ids=lambda fault: fault.name)
def test_a_fault_is_named_with_its_place(fault: Fault, mission: Path, nodes: str) -> None:
    fault.spoil(mission / fault.file)
    done = geohtn('plan', mission, '--namespace', nodes, '--output', mission / 'out', timeout=60)
    printed = done.stdout + done.stderr
    assert done.returncode == 2, printed
    assert 'Traceback' not in printed
    for pattern in fault.expected:
        assert re.search(pattern, printed, re.IGNORECASE), printed
    if fault.line is not None:
        assert re.search(rf'{re.escape(fault.file)}:{fault.line}:\d+', printed), printed


def test_the_nodes_plan_on_after_all_that(mission: Path, nodes: str) -> None:
    done = geohtn('plan', mission, '--namespace', nodes, '--output', mission / 'out')
    assert done.returncode == 0, done.stdout + done.stderr


def test_no_goals_are_an_empty_plan(mission: Path, nodes: str) -> None:
    problem = mission / 'problem.lisp'
    text = problem.read_text(encoding='utf-8')
    tasks = text.index('((!init_rover_attitude')
    problem.write_text(text[:tasks] + '((achieve-goals (list))))', encoding='utf-8')
    done = geohtn('plan', mission, '--namespace', nodes, '--output', mission / 'out')
    assert done.returncode == 0, done.stdout + done.stderr
    plan = json.loads((mission / 'out' / 'plan.json').read_text(encoding='utf-8'))
    assert plan['outcome'] == 'SOLVED'
    assert plan['steps'] == []
