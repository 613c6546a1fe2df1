"""Goals of a tour, and attitudes of each: diverse ones, and ones that are near to other goals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.paths.edges import Rows
from motion_planner_node.planning.ground import Ground
from motion_planner_node.satisfaction import Program, descend
from motion_planner_node.satisfaction.destinations import farthest_points
from motion_planner_node.stopping import ShouldStop, go_on
from motion_planner_node.tours.chains import Indices
from motion_planner_node.tours.legs import spare_body

#: Goals near a goal for whose sake attitudes are looked for.
NEIGHBOURS = 6
#: Attitudes of each of them from which descents begin.
FROM_NEIGHBOUR = 4


@dataclass(frozen=True, slots=True)
class Goal:
    """A set of preconditions: its ``program``, and some attitudes (k, 3), k > 0, that meet it."""

    program: Program
    states: Rows


def fit(goal: Goal, ground: Ground, part: int, rows: Rows) -> Rows:
    """Attitudes (k, 3) that meet ``goal``, descended to from ``rows``: free, and in ``part``."""
    descent = descend(goal.program, rows, room=ground.room)
    states = descent.states[descent.satisfied]
    if len(states):
        free = ground.scene.is_free(states, spare_body(ground.robot))
        states = states[free & (ground.parts_of(states) == part)]
    return np.ascontiguousarray(states)


def neighbours(goals: Sequence[Goal], most: int) -> list[Indices]:
    """Numbers of the ``most`` goals that are nearest to each one, as their middles tell."""
    middles = np.array([goal.states[:, :2].mean(axis=0) for goal in goals])
    result = []
    for index, middle in enumerate(middles):
        order = np.argsort(np.hypot(*(middles - middle).T), kind='stable')
        result.append(order[order != index][:most])
    return result


def attitudes(
    goals: Sequence[Goal],
    ground: Ground,
    start: Rows,
    part: int,
    most: int,
    should_stop: ShouldStop,
) -> list[Rows]:
    """At most ``most`` attitudes of each goal: half far from each other, half near other goals.

    ``start`` (1, 3) counts as another goal.  Dead ends are left out where there is anything else.

    :raises Stopped: when ``should_stop`` said so
    """
    result = []
    for goal, near in zip(goals, neighbours(goals, NEIGHBOURS), strict=True):
        go_on(should_stop)
        others = [start, *(goals[other].states for other in near)]
        begin = [other[_nearest(other, goal.states)[:FROM_NEIGHBOUR]] for other in others]
        states = np.concatenate((goal.states, fit(goal, ground, part, np.concatenate(begin))))
        chosen = list(farthest_points(states, max(1, most // 2)))
        ranked = np.column_stack([_nearest(states, other) for other in others]).ravel()
        chosen += [index for index in dict.fromkeys(ranked.tolist()) if index not in chosen]
        states = states[chosen[:most]]
        roomy = passable(ground, states, should_stop)
        result.append(states[roomy] if roomy.any() else states)
    return result


def passable(ground: Ground, states: Rows, should_stop: ShouldStop) -> NDArray[np.bool_]:
    """At which free attitudes (n, 3) there is room to drive on, and to have come from, shape (n,).

    Where the robot comes from is where it would get to the other way round.

    :raises Stopped: when ``should_stop`` said so
    """

    def check_time() -> None:
        go_on(should_stop)

    roomy = ground.can_turn_round(states, check_time)
    back = states[roomy] + (0.0, 0.0, np.pi)
    roomy[roomy] = ground.can_turn_round(back, check_time)
    return roomy


def _nearest(states: Rows, others: Rows) -> Indices:
    """Indices of ``states`` (n, 3), the one that is nearest to any of ``others`` (m, 3) first."""
    apart = states[:, None, :2] - others[None, :, :2]
    return np.argsort(np.hypot(apart[..., 0], apart[..., 1]).min(axis=1), kind='stable')
