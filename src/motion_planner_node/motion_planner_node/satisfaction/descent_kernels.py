"""Batches of descents: each attitude is evaluated, and its machine says where to go next."""

from __future__ import annotations

from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions import Array
from motion_planner_node.robots.arcs import wrap_angle
from motion_planner_node.robots.kernel import kernel, part
from motion_planner_node.satisfaction.evaluation import (
    STRICT,
    difference,
    evaluate,
    penalise,
    tell,
    violation,
    workspace,
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
from motion_planner_node.world.shapes import OpenShapes, Shapes, opened
from motion_planner_node.world.slopes import clearance_with_slope


class Ends(NamedTuple):
    """Where n descents end.

    states: (n, 3) x, y [m] and heading [rad] in (-pi, pi]
    satisfied: (n,) whether they will do
    violations: (n, m) by how much each constraint is missed
    iterations: (n,) steps taken
    """

    states: Array
    satisfied: NDArray[np.bool_]
    violations: Array
    iterations: NDArray[np.int64]


class _Bench(NamedTuple):
    """What one descent works with.

    head, memory: a machine; told: what it is told; values, gradients: a `workspace`; missed: by how
    much each constraint is missed at the end
    """

    head: Array
    memory: Array
    told: Array
    values: Array
    gradients: Array
    missed: Array


class _OpenRoom(NamedTuple):
    """A `Room` in inner loops."""

    shapes: OpenShapes
    clearance: float


@kernel
def with_room(conditions: Array, clearance: float, margin: float) -> Array:
    """The ``conditions`` (m, 4) of a program, and one for a room's ``clearance`` [m], if finite."""
    count = len(conditions)
    result = np.zeros((count + (1 if clearance > -inf else 0), 4))
    result[:count] = conditions
    result[count:, 3] = 0.75 * margin
    return result


@part
def _tell_room(room: _OpenRoom, head: Array, margin: float, told: Array) -> None:
    """Fill the last row of ``told``: how much clearance the trial lacks, and its slopes."""
    clearance, by_x, by_y = clearance_with_slope(room.shapes, head[TRIAL], head[TRIAL + 1])
    last = len(told) - 1
    told[last, 0] = max(room.clearance + margin - clearance, 0.0)
    told[last, 1], told[last, 2], told[last, 3] = -by_x, -by_y, 0.0


@part
def _is_satisfied(
    conditions: Array, margin: float, room: _OpenRoom, head: Array, violations: Array
) -> bool:
    """Whether the best place of a descent will do; ``violations`` (m,) are those there."""
    result = True
    for row in range(len(conditions)):
        result = result and violations[row] <= (0.0 if conditions[row, STRICT] else 0.5 * margin)
    if result and room.clearance > -inf:
        clearance, _, _ = clearance_with_slope(room.shapes, head[BEST], head[BEST + 1])
        result = clearance >= room.clearance
    return result


@part
def _descend(
    table: Table, room: _OpenRoom, limits: Limits, asked: Array, margin: float, bench: _Bench
) -> None:
    """Run a machine from its start to its end; the values are then those at its best place."""
    conditions, head, told = asked[: len(table.outputs)], bench.head, bench.told
    while head[PHASE] != DONE:
        is_truncated = head[PHASE] == TRUNCATED
        evaluate(table, head, TRIAL, is_truncated, bench.values, bench.gradients)
        tell(table, bench.values, bench.gradients, told)
        penalise(conditions, margin, told)
        if len(asked) > len(conditions):
            _tell_room(room, head, margin, told)
        advance(head, bench.memory, limits, told, asked)
    head[BEST + 2] = wrap_angle(head[BEST + 2])
    is_elsewhere = head[BEST] != head[TRIAL] or head[BEST + 1] != head[TRIAL + 1]
    if is_elsewhere or head[BEST + 2] != head[TRIAL + 2]:
        evaluate(table, head, BEST, head[PHASE] == TRUNCATED, bench.values, bench.gradients)


@part
def _descend_all(
    table: Table,
    room: _OpenRoom,
    limits: Limits,
    asked: Array,
    margin: float,
    bench: _Bench,
    states: Array,
    steps: Array,
    ends: Ends,
) -> None:
    constraints = len(table.outputs)
    conditions, head, missed = asked[:constraints], bench.head, bench.missed
    for lane in range(len(states)):
        attempt, is_satisfied = 0, False
        while attempt < len(steps) and not is_satisfied:
            x, y = states[lane, 0] + steps[attempt, 0], states[lane, 1] + steps[attempt, 1]
            start(head, x, y, states[lane, 2] + steps[attempt, 2], limits)
            _descend(table, room, limits, asked, margin, bench)
            for row in range(constraints):
                missed[row] = violation(conditions, row, difference(table, row, bench.values))
            ends.iterations[lane] += int(head[TAKEN])
            is_satisfied = _is_satisfied(conditions, margin, room, head, missed)
            if attempt == 0 or is_satisfied:
                for row in range(constraints):
                    ends.violations[lane, row] = missed[row]
                for axis in range(3):
                    ends.states[lane, axis] = head[BEST + axis]
            attempt += 1
        ends.satisfied[lane] = is_satisfied


@kernel
def descend_primitive(
    table: Table,
    conditions: Array,
    margin: float,
    shapes: Shapes,
    clearance: float,
    limits: Limits,
    states: Array,
    steps: Array,
) -> Ends:
    """Descend from each of ``states`` (n, 3), from each of ``steps`` (k, 3) away until one succeeds.

    ``shapes`` and ``clearance`` [m] are those of a `Room`, which is slow to pass from Python.
    Where no descent succeeds the end is that of the first.
    """
    count, constraints = len(states), len(conditions)
    ends = Ends(
        np.empty((count, 3)),
        np.empty(count, np.bool_),
        np.empty((count, constraints)),
        np.zeros(count, np.int64),
    )
    values, gradients = workspace(table)
    room = _OpenRoom(opened(shapes), clearance)
    asked = with_room(conditions, clearance, margin)
    rows = len(asked)
    head, memory, told = np.empty(HEAD), np.empty((rows, MEMORY)), np.zeros((rows, 4))
    bench = _Bench(head, memory, told, values, gradients, np.empty(constraints))
    _descend_all(table, room, limits, asked, margin, bench, states, steps, ends)
    return ends


@kernel
def start_all(heads: Array, states: Array, limits: Limits) -> None:
    """Begin a descent at each of ``states`` (n, 3); ``heads`` is (n, HEAD)."""
    for lane in range(len(states)):
        start(heads[lane], states[lane, 0], states[lane, 1], states[lane, 2], limits)


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
    inner = _OpenRoom(opened(room.shapes), room.clearance)
    constraints = len(conditions) - (1 if limited else 0)
    for index in range(len(lanes)):
        head, memory = heads[lanes[index]], memories[lanes[index]]
        penalise(conditions[:constraints], margin, told[index])
        if limited:
            _tell_room(inner, head, margin, told[index])
        advance(head, memory, limits, told[index], conditions)
