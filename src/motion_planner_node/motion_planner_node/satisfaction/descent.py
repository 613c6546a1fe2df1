"""From attitudes to attitudes that satisfy a program: the inner loop of Algorithm 1, in batches.

The first steps are the paper's: along the truncated gradient, which turns the robot rather than
moves it. What they do not solve, damped Gauss-Newton steps (Levenberg-Marquardt) on the full
derivatives do, in variables scaled so that a radian and a length weigh alike.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions import Array
from motion_planner_node.satisfaction.descent_kernels import (
    Ends,
    descend_primitive,
    start_all,
    tell_all,
    with_room,
)
from motion_planner_node.satisfaction.machine import (
    BEST,
    DAMPED,
    DONE,
    HEAD,
    MEMORY,
    PHASE,
    TAKEN,
    TRIAL,
    TRUNCATED,
    Limits,
)
from motion_planner_node.satisfaction.room import ANYWHERE, Room
from motion_planner_node.satisfaction.row import wrap
from motion_planner_node.world.clearance import clearances

if TYPE_CHECKING:
    from motion_planner_node.satisfaction.program import Program

#: Of two places on the spiral of retries: angle [rad], and distance in lengths of the options.
_GOLDEN_ANGLE, _SPACING = np.pi * (3.0 - np.sqrt(5.0)), 3.0


@dataclass(frozen=True, slots=True)
class DescentOptions:
    """Limits of a descent.

    Attributes:
        truncated_steps: at most so many steps of the paper come first
        damped_steps: at most so many Levenberg-Marquardt steps follow
        halvings: the step length of equation 5 starts at 1 and is halved so often at most
        length: what weighs as much as a radian [m]
        retries: a descent that fails is tried again so often at most, from places on a spiral
            round the one where it began
    """

    truncated_steps: int = 8
    damped_steps: int = 50
    halvings: int = 4
    length: float = 50.0
    retries: int = 8

    @property
    def limits(self) -> Limits:
        """Those of each descent."""
        return Limits(self.truncated_steps, self.damped_steps, self.halvings, self.length)


@dataclass(frozen=True, slots=True)
class Descent:
    """Where n descents ended.

    Attributes:
        states: (n, 3) x, y [m] and heading [rad] in (-pi, pi]
        satisfied: (n,) whether all constraints are met, and the room's clearance is kept
        violations: (n, m) by how much each constraint is missed
        iterations: (n,) steps taken
    """

    states: Array
    satisfied: NDArray[np.bool_]
    violations: Array
    iterations: NDArray[np.int64]

    @property
    def best(self) -> int:
        """Index of the attitude that comes closest: the least sum of squared violations."""
        with np.errstate(over='ignore'):
            return int(np.argmin((self.violations**2).sum(axis=1)))


def descend(
    program: Program,
    states: Array,
    options: DescentOptions = DescentOptions(),
    room: Room = ANYWHERE,
) -> Descent:
    """Descend from each of ``states`` (n, 3) until all constraints are met or no step helps.

    Obstacles and edges of ``room`` are kept away from like one more constraint. What fails with all
    its retries ends where its first descent did.
    """
    begin = np.array(states, dtype=np.float64).reshape(-1, 3)
    steps = _spiral(options.retries, options.length)
    if program.table is not None:
        return _descend_once(program, begin, options, room, steps)
    result = _descend_once(program, begin, options, room, steps[:1])
    for step in steps[1:]:
        failed = np.flatnonzero(~result.satisfied)
        if not len(failed):
            break
        again = _descend_once(program, begin[failed] + step, options, room, steps[:1])
        result.iterations[failed] += again.iterations
        solved = failed[again.satisfied]
        result.satisfied[solved] = True
        result.states[solved] = again.states[again.satisfied]
        result.violations[solved] = again.violations[again.satisfied]
    return result


@lru_cache(maxsize=16)
def _spiral(retries: int, length: float) -> Array:
    """Steps (retries + 1, 3) from a start to where its descents begin: farther away every time."""
    retry = np.arange(retries + 1)
    angle, reach = _GOLDEN_ANGLE * retry, _SPACING * length * retry
    steps = np.column_stack((reach * np.cos(angle), reach * np.sin(angle), 2.0 * angle))
    return np.ascontiguousarray(steps)


def _descend_once(
    program: Program, begin: Array, options: DescentOptions, room: Room, steps: Array
) -> Descent:
    margin = 2.0 * program.tolerance
    if program.table is None:
        ends = _descend_opaque(program, margin, room, options.limits, begin)
    else:
        shapes, clearance = room
        ends = descend_primitive(
            program.table,
            program.conditions,
            margin,
            shapes,
            clearance,
            options.limits,
            begin,
            steps,
        )
    satisfied = ends.satisfied
    if room.clearance > -np.inf:
        satisfied &= clearances(room.shapes, ends.states) >= room.clearance
    return Descent(ends.states, satisfied, ends.violations, ends.iterations)


def _descend_opaque(
    program: Program, margin: float, room: Room, limits: Limits, states: Array
) -> Ends:
    """Descents whose functions are evaluated by numpy, all that are going on at a time."""
    conditions = with_room(program.conditions, room.clearance, margin)
    heads = np.empty((len(states), HEAD))
    memories = np.empty((len(states), len(conditions), MEMORY))
    start_all(heads, states, limits)
    while (heads[:, PHASE] != DONE).any():
        for phase in (TRUNCATED, DAMPED):
            lanes = np.flatnonzero(heads[:, PHASE] == phase)
            if len(lanes):
                trials = np.ascontiguousarray(heads[lanes, TRIAL : TRIAL + 3])
                told = np.zeros((len(lanes), len(conditions), 4))
                program.differences(trials, told, is_truncated=phase == TRUNCATED)
                tell_all(heads, memories, lanes, limits, room, conditions, margin, told)
    ends = heads[:, BEST : BEST + 3].copy()
    ends[:, 2] = wrap(ends[:, 2])
    violations = program.violations(ends)
    return Ends(ends, program.meets(violations), violations, heads[:, TAKEN].astype(np.int64))
