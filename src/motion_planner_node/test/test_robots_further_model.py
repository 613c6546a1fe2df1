"""A further model is one file and its lines in the registry, as docs/robots.md tells; nothing else."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from math import cos, hypot, pi, remainder, sin, tau
from pathlib import Path

import motion_planner_node

PACKAGE = Path(motion_planner_node.__file__).resolve().parent
MODEL = '''
"""A scooter: turns on the spot and drives ahead, never back."""

from math import atan2, hypot

from ompl import base

from motion_planner_node.robots.arcs import other_way, wrap_angle
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.model import Model
from motion_planner_node.robots.motion import COMPONENTS

MODEL = Model(
    name='scooter',
    components=COMPONENTS,
    steers=False,
    reverses=False,
    slides=False,
    turns=True,
    words=2,
    space=lambda _: base.SE2StateSpace(),
)


@kernel
def word(_, number, start, end, pieces):
    """Turn, drive and turn; word 1 turns the long way round at the end."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    course = atan2(dy, dx)
    turn = wrap_angle(end[2] - course)
    pieces[0, 3] = wrap_angle(course - start[2])
    pieces[1, 1] = hypot(dx, dy)
    pieces[2, 3] = other_way(turn) if number == 1 else turn
    return pieces[1, 1]
'''
KERNEL = """\
    if steering == 4:
        return scooter.word(radius, number, start, end, pieces)
    return inf
"""
#: What the registry gets: its import, its place in the list, its number and kernel.
LINES = (
    ('reverse_car\n', 'reverse_car, scooter\n'),
    ('omnidirectional.MODEL)', 'omnidirectional.MODEL, scooter.MODEL)'),
    ('    return inf\n', KERNEL),
)
ASK = """
import json
import numpy as np
from motion_planner_node.paths.lattice_end import moves_of
from motion_planner_node.robots.commands import trouble_with
from motion_planner_node.robots.driving import words_between
from motion_planner_node.robots.motion import Attitude, Segment
from motion_planner_node.robots.registry import STEERING
from motion_planner_node.world import read_world

robot = read_world(
    'bounds: [0, 0, 9, 9]\\n'
    'objects: {}\\n'
    'robots: {r: {model: scooter, radius: 0.2, speed: 1, turning_speed: 1}}\\n',
    'world.yaml',
).robots['r']
words = words_between(Attitude(1.0, 2.0, 0.5), Attitude(6.0, 7.0, -2.0), robot)
space = robot.space((0.0, 0.0, 9.0, 9.0))
print(json.dumps({
    'numbers': STEERING,
    'words': [[[s.length, s.turn] for s in word] for word in words],
    'space': type(space).__name__,
    'backwards': trouble_with(Segment(0.0, -1.0), robot),
    'moves': moves_of(robot, 1.0, 0.5, (1.0,)).tolist(),
}))
"""


def test_a_further_model_is_one_file_and_its_lines_in_the_registry(tmp_path: Path) -> None:
    package = tmp_path / PACKAGE.name
    shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns('__pycache__'))
    (package / 'robots' / 'scooter.py').write_text(MODEL, encoding='utf-8')
    registry = package / 'robots' / 'registry.py'
    text = registry.read_text(encoding='utf-8')
    for old, new in LINES:
        assert text.count(old) == 1
        text = text.replace(old, new)
    registry.write_text(text, encoding='utf-8')
    path = os.pathsep.join([str(tmp_path), *filter(None, sys.path)])
    environment = {**os.environ, 'PYTHONPATH': path, 'NUMBA_OPT': '0'}
    environment.pop('NUMBA_CACHE_DIR', None)
    asked = subprocess.run(
        [sys.executable, '-c', ASK], capture_output=True, text=True, env=environment, check=False
    )
    assert asked.returncode == 0, asked.stderr
    told = json.loads(asked.stdout)
    assert told['numbers'] == {
        'car': 0, 'reverse_car': 1, 'differential': 2, 'omnidirectional': 3, 'scooter': 4,
    }  # fmt: skip
    assert told['space'] == 'SE2StateSpace'
    assert told['backwards'] == 'is driven backwards, -1 m; a scooter does not do so'
    assert told['moves'] == [[0, 1, 0, 0], [0, 0, 0, 0.5], [0, 0, 0, -0.5]]
    assert len(told['words']) == 2
    for word in told['words']:
        x, y, heading = 1.0, 2.0, 0.5
        for length, turn in word:
            x, y, heading = x + length * cos(heading), y + length * sin(heading), heading + turn
        assert hypot(x - 6.0, y - 7.0, remainder(heading + 2.0, tau)) < 1e-9
        assert [length for length, _ in word if length] == [hypot(5.0, 5.0)]
    first, second = (sum(abs(turn) for _, turn in word) for word in told['words'])
    assert first < second < first + tau
    assert abs(remainder(pi / 4 - 0.5, tau)) + abs(remainder(-2.0 - pi / 4, tau)) - first < 1e-9
