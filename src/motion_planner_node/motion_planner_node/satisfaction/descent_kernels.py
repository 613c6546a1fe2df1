"""Batches of descents: each attitude is evaluated, and its machine says where to go next."""

from __future__ import annotations

from math import inf

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions import Array
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.satisfaction.evaluation import (
    evaluate,
    penalise,
    violation,
    workspace,
    wrapped,
)
from motion_planner_node.satisfaction.machine import (
    BEST,
    DONE,
    HEAD,
    MEMORY,
    PHASE,
    TAKEN,
    TRIAL,
    TRUNCATED,
    Limits,
    advance,
    start,
)
from motion_planner_node.satisfaction.recording import Table
from motion_planner_node.satisfaction.room import Room
from motion_planner_node.world.slopes import clearance_with_slope


@kernel
def with_room(conditions: Array, room: Room, margin: float) -> Array:
    """The ``conditions`` (m, 4) of a program, and one more for the room, if it has limits."""
    count = len(conditions)
    result = np.zeros((count + (1 if room.clearance > -inf else 0), 4))
    result[:count] = conditions
    result[count:, 3] = 0.75 * margin
    return result


@kernel
def _tell_room(room: Room, head: Array, margin: float, told: Array) -> None:
    """Fill the last row of ``told``: how much clearance the trial lacks, and its slopes."""
    clearance, by_x, by_y = clearance_with_slope(room.shapes, head[TRIAL], head[TRIAL + 1])
    last = len(told) - 1
    told[last, 0] = max(room.clearance + margin - clearance, 0.0)
    told[last, 1], told[last, 2], told[last, 3] = -by_x, -by_y, 0.0


@kernel
def _is_satisfied(
    conditions: Array, margin: float, room: Room, head: Array, violations: Array
) -> bool:
    """Whether the best place of a descent will do; ``violations`` (m,) are those there."""
    for row in range(len(conditions)):
        if not violations[row] <= (0.0 if conditions[row, 2] else 0.5 * margin):
            return False
    if room.clearance > -inf:
        clearance, _, _ = clearance_with_slope(room.shapes, head[BEST], head[BEST + 1])
        return bool(clearance >= room.clearance)
    return True


@kernel
def descend_primitive(
    table: Table,
    conditions: Array,
    margin: float,
    room: Room,
    limits: Limits,
    states: Array,
    steps: Array,
) -> tuple[Array, Array, NDArray[np.int64]]:
    """Descend from each of ``states`` (n, 3), from each of ``steps`` (k, 3) away until one succeeds.

    Returns the ends (n, 3), by how much each constraint is missed there (n, m), and the steps taken
    (n,). Where no descent succeeds it is the end of the first.
    """
    count, constraints = len(states), len(conditions)
    ends, violations = np.empty((count, 3)), np.empty((count, constraints))
    iterations = np.zeros(count, np.int64)
    values, gradients = workspace(table)
    asked = with_room(conditions, room, margin)
    rows = len(asked)
    head, memory, told = np.empty(HEAD), np.empty((rows, MEMORY)), np.zeros((rows, 4))
    missed = np.empty(constraints)
    for lane in range(count):
        for attempt in range(len(steps)):
            start(head, states[lane] + steps[attempt], limits)
            while head[PHASE] != DONE:
                evaluate(table, head, TRIAL, head[PHASE] == TRUNCATED, values, gradients)
                for row in range(constraints):
                    slot = table.outputs[row]
                    told[row, 0] = values[slot]
                    for axis in range(3):
                        told[row, 1 + axis] = gradients[slot, axis]
                penalise(conditions, margin, told)
                if rows > constraints:
                    _tell_room(room, head, margin, told)
                advance(head, memory, limits, told, asked)
            head[BEST + 2] = wrapped(head[BEST + 2])
            evaluate(table, head, BEST, head[PHASE] == TRUNCATED, values, gradients)
            for row in range(constraints):
                missed[row] = violation(conditions, row, values[table.outputs[row]])
            iterations[lane] += int(head[TAKEN])
            is_satisfied = _is_satisfied(conditions, margin, room, head, missed)
            if attempt == 0 or is_satisfied:
                violations[lane] = missed
                ends[lane] = head[BEST : BEST + 3]
            if is_satisfied:
                break
    return ends, violations, iterations


@kernel
def start_all(heads: Array, states: Array, limits: Limits) -> None:
    """Begin a descent at each of ``states`` (n, 3); ``heads`` is (n, HEAD)."""
    for lane in range(len(states)):
        start(heads[lane], states[lane], limits)


@kernel
def tell_all(
    heads: Array,
    memories: Array,
    lanes: NDArray[np.int64],
    limits: Limits,
    room: Room,
    conditions: Array,
    margin: float,
    told: Array,
) -> None:
    """Tell the machines number ``lanes`` (k,) their functions and slopes (k, rows, 4).

    ``conditions`` are those of ``with_room``.
    """
    limited = room.clearance > -inf
    constraints = len(conditions) - (1 if limited else 0)
    for index in range(len(lanes)):
        head, memory = heads[lanes[index]], memories[lanes[index]]
        penalise(conditions[:constraints], margin, told[index])
        if limited:
            _tell_room(room, head, margin, told[index])
        advance(head, memory, limits, told[index], conditions)
