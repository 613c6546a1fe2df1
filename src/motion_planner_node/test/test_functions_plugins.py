"""Functions of other packages: the example package is built and used, broken ones are refused."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from shutil import copytree
from typing import Any

import pytest

from motion_planner_node.functions import FUNCTIONS, Function, Kind
from motion_planner_node.functions.plugins import fault_of

EXAMPLE = Path(__file__).resolve().parents[3] / 'examples' / 'geohtn_example_functions'
ROOM = Path(__file__).resolve().parents[1]

USE = """
import numpy as np
from motion_planner_node.functions import load_plugins
from motion_planner_node.language import parse
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.satisfaction import compile_program, destinations
from motion_planner_node.world import read_world

assert load_plugins() == ('aspect_ratio', 'behind')
world = read_world('''
bounds: [0, 0, 100, 100]
objects: {a: {x: 30, y: 50}, b: {x: 60, y: 50}}
robots:
  r: {model: car, wheelbase: 2, max_steering_angle: 0.5, radius: 1, speed: 1}
  s: {model: car, wheelbase: 2, max_steering_angle: 0.5, radius: 1, speed: 1}
''', '')
text = '(agent r)(agent s)(object a)(object b)(aspect_ratio(r, a, b) = 2)(behind(r, s))'
start = {'r': Attitude(10, 10, 0), 's': Attitude(35, 80, 0)}
program = compile_program(parse(text), world, start)
found = destinations(program, start['r'], world.bounds, np.random.default_rng(0), 4)
assert len(found)
for x, y, _ in found:
    ratio = np.hypot(x - 60, y - 50) / np.hypot(x - 30, y - 50)
    assert abs(ratio - 2) < 1e-8 and x <= 35
print('used')
"""

LOAD = """
from motion_planner_node.functions import PluginError, load_plugins
try:
    load_plugins()
except PluginError as error:
    print(error)
"""


def run(script: str, *paths: Path) -> str:
    code = f'import sys\nsys.path[:0] = {[*map(str, paths), str(ROOM)]!r}\n{script}'
    done = subprocess.run([sys.executable, '-c', code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def test_the_example_package_is_built_and_used(tmp_path: Path) -> None:
    package = copytree(EXAMPLE, tmp_path / 'package')
    built = subprocess.run(
        [sys.executable, 'setup.py', '-q', 'egg_info'],
        cwd=package,
        capture_output=True,
        text=True,
        check=False,
    )
    assert built.returncode == 0, built.stderr
    assert run(USE, package) == 'used'


def test_a_package_that_is_not_there_changes_nothing() -> None:
    assert run(LOAD) == ''


@pytest.mark.parametrize(
    ('source', 'words'),
    [
        ('raise ImportError("no such sensor")', 'cannot be loaded: ImportError: no such sensor'),
        ('FUNCTIONS = 5', 'is not a Function'),
        ('FUNCTIONS = (distance,)', 'function distance: its name is taken'),
        ('FUNCTIONS = (replace(distance, name="a b"),)', 'cannot be written'),
        (
            'FUNCTIONS = replace(distance, name="new", value=lambda a, b: 5)',
            'it gives int for Dual',
        ),
        ('FUNCTIONS = replace(distance, name="new", value=lambda a: a.x)', 'it fails on Dual'),
    ],
)
def test_a_broken_package_is_refused_in_one_sentence(
    tmp_path: Path, source: str, words: str
) -> None:
    before = 'from dataclasses import replace\nfrom motion_planner_node.functions import FUNCTIONS'
    (tmp_path / 'broken.py').write_text(
        f'{before} as known\ndistance = known["distance"]\n{source}\n'
    )
    information = tmp_path / 'broken-1.dist-info'
    information.mkdir()
    (information / 'METADATA').write_text('Metadata-Version: 2.1\nName: broken\nVersion: 1\n')
    (information / 'entry_points.txt').write_text(
        '[motion_planner_node.functions]\nbad = broken:FUNCTIONS\n'
    )
    message = run(LOAD, tmp_path)
    assert message.startswith('the plugin bad (broken:FUNCTIONS)')
    assert words in message
    assert len(message.splitlines()) == 1


@pytest.mark.parametrize(
    ('changes', 'words'),
    [
        ({'result': Kind.PLACE}, 'NUMBER or ANGLE'),
        ({'condition': '<'}, 'its condition'),
        ({'result': Kind.ANGLE, 'condition': '<='}, 'its condition'),
        ({'arguments': ()}, 'take arguments'),
        ({'derived_codes': ('z',)}, 'derived_codes names z'),
        ({'name': 'not'}, 'its name'),
    ],
)
def test_faults_are_named(changes: dict[str, Any], words: str) -> None:
    assert words in fault_of(replace(FUNCTIONS['distance'], **changes))


@pytest.mark.parametrize('function', FUNCTIONS.values(), ids=FUNCTIONS)
def test_the_library_has_no_faults(function: Function) -> None:
    assert fault_of(function) == ''
