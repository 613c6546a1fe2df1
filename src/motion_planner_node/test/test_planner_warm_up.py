"""After the warm-up nothing is left to compile: the first mission is as quick as the second."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

WORLD = Path(__file__).resolve().parents[2] / 'interface_node' / 'missions' / 'rover' / 'world.yaml'
SCRIPT = """
import sys
from pathlib import Path

from numba.core.dispatcher import Dispatcher

from motion_planner_node.planner import MotionPlanner, warm_up
from motion_planner_node.requests import AdviceRequest, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world import read_world


def compiled():
    found = {}
    for name, module in sorted(sys.modules.items()):
        for label, value in vars(module).items() if name.startswith('motion_planner_node') else ():
            if isinstance(value, Dispatcher):
                found[name, label] = len(value.signatures)
    return found


def text(k):
    return (
        f'((agent rover0)(object location{k})(distance(rover0, location{k}) >= 50)'
        f'(distance(rover0, location{k}) <= 100)'
        f'(rel_angle(rover0, location{k}) = cos-and-sin(pi/2)))'
    )


warm_up()
before = compiled()
planner = MotionPlanner(read_world(Path(sys.argv[1]).read_text(), 'world.yaml'))
state = {'rover0': Attitude(20.0, 20.0, 0.0)}
planner.advise(AdviceRequest(tuple(map(text, range(1, 9))), state))
for purpose in (1, 2):
    planner.advise(AdviceRequest(tuple(map(text, range(1, 9))), state, purpose=purpose))
planner.advise(AdviceRequest(2 * tuple(map(text, range(1, 9))), state, purpose=1))
for k in range(1, 9):
    answer = planner.satisfy(GeometricRequest(text(k), state))
    state = answer.end or state
    met = AdviceRequest((text(1),), state, purpose=3, motions=(answer.motion,))
    planner.advise(met)
seen = text(1)[:-1] + '(visible(rover0, location1))(clearance(rover0) >= 10))'
planner.satisfy(GeometricRequest(seen, state))
far = '(agent rover0)(object location1)(object location2)(distance(rover0, location1) <= 9)'
for more in (
    '(distance(rover0, location2) <= 9)',
    '(rel_angle(rover0, location1) = cos-and-sin(0))(rover0.heading > 4)',
    '(rover0.x * rover0.y = rover0.heading * 1e6)',
):
    planner.satisfy(GeometricRequest(far + more, state))
planner.satisfy(GeometricRequest(text(1), state, mode='paper'))
late = {key: count for key, count in compiled().items() if count != before.get(key)}
assert before, 'no kernels were found'
assert not late, late
"""


def test_nothing_is_compiled_after_the_warm_up() -> None:
    done = subprocess.run(
        [sys.executable, '-c', SCRIPT, str(WORLD)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
