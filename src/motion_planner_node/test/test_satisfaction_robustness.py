"""Any constraints that compile: no crash, no false success, no proof against a destination."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.language import parse
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.satisfaction import compile_program, destinations, restarts
from motion_planner_node.world.model import Bounds, World, WorldObject

BOUNDS = Bounds(0.0, 0.0, 100.0, 80.0)
WORLD = World(
    source='',
    revision='',
    bounds=BOUNDS,
    objects={
        'a': WorldObject('a', {'x': 20.0, 'y': 20.0}),
        'b': WorldObject('b', {'x': 70.0, 'y': 50.0}),
    },
    obstacles=(),
    robots={'r': Robot('r', 8.0, 0.5, 5.0, 2.0)},
)
START = Attitude(20.0, 20.0, 0.0)

NUMBERS = st.recursive(
    st.sampled_from(
        ['0', '2', '50', '1e200', '1e6', 'pi', 'r.x', 'r.y', 'r.heading', 'a.x', 'b.y', 'deg(30)']
    )
    | st.sampled_from(['distance(r, a)', 'distance(b, r)', 'distance(r, r)']),
    lambda inner: (
        st.builds('({} {} {})'.format, inner, st.sampled_from('+-*/'), inner)
        | st.builds('-{}'.format, inner)
    ),
    max_leaves=4,
)
ANGLES = st.builds('rel_angle(r, {})'.format, st.sampled_from('abr')) | st.builds(
    'cos-and-sin({})'.format, NUMBERS
)
COMPARISONS = st.sampled_from(['<', '<=', '>', '>=', '='])
CONSTRAINTS = st.builds('({} {} {})'.format, NUMBERS, COMPARISONS, NUMBERS) | st.builds(
    '({} = {})'.format, ANGLES, ANGLES
)


@settings(max_examples=80, deadline=None)
@given(st.lists(CONSTRAINTS, min_size=1, max_size=3))
def test_whatever_compiles_gives_only_true_destinations(constraints: list[str]) -> None:
    text = '(agent r)(object a)(object b)' + ''.join(constraints)
    try:
        program = compile_program(parse(text), WORLD, {'r': START})
    except MotionPlannerError:
        return
    rng = np.random.default_rng(0)
    found = destinations(program, START, BOUNDS, rng, 4)
    assert np.isfinite(found).all()
    assert program.satisfied(found).all()
    assert all(
        residual.satisfied
        for state in found.tolist()
        for residual in program.residuals(Attitude(*state))
    )
    if '1e200' in text or ' < ' in text or ' > ' in text:
        return  # rounding, and the tolerance of equalities beside a strict bound, blur the proof
    if len(found):
        assert program.contradiction(BOUNDS) is None
    if program.contradiction(BOUNDS):
        descent = restarts(program, BOUNDS, rng, 10)
        x, y = descent.states[:, 0], descent.states[:, 1]
        inside = (x >= 0.0) & (x <= 100.0) & (y >= 0.0) & (y <= 80.0)
        assert not (descent.satisfied & inside).any()
