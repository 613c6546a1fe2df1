"""Proofs by turning room: a car that only drives forward gets out of no place without room to turn.

What it may get to from its start is over-estimated by `paths.reach`. Where that comes to an end, and
interval bounds exclude that the constraints hold in it, there is no motion. The same holds for a car
that comes to the destinations, as its way there is a way from there backwards.
"""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, cos, pi, remainder, sin, tau
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.codes import Code, Scope
from motion_planner_node.functions import Array
from motion_planner_node.paths.reach import (
    ENDED,
    GOES_ON,
    HEADINGS,
    OF_CLEARANCE,
    OF_RADIUS,
    STRIDE,
    WINDOW,
    View,
    go_on,
    new_search,
    parts_of,
    strides,
    sweeps,
)
from motion_planner_node.planning.candidates import row_of
from motion_planner_node.planning.ground import Ground
from motion_planner_node.planning.problem import Problem
from motion_planner_node.planning.proofs import Impossible, listed, wanted
from motion_planner_node.robots.body import necessary_clearance
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.satisfaction import branch_and_prune
from motion_planner_node.satisfaction.branch_and_prune import possible

#: Cells of place and heading that are looked at before a proof is given up, and between two looks
#: at the clock.
MOST_CELLS, CHUNK = 20_000, 2_000
#: Boxes of destinations, and cells that cover them, from which a car is followed backwards at most.
MOST_BOXES, MOST_ROOTS = 4_000, 10_000


#: Raises Stopped when the work has to stop.
CheckTime = Callable[[], None]


class Reach(NamedTuple):
    """All that a car may get to, from or to somewhere: boxes (n, 3) of x, y [m] and heading [rad].

    Headings are in order, but go on beyond pi.
    """

    low: Array
    high: Array
    names: tuple[str, ...]


def confined(problem: Problem, ground: Ground, check_time: CheckTime) -> Impossible | None:
    """Whether the car cannot get out of where it starts, and cannot do there what it is to do."""
    if not ground.needs_room_to_turn or ground.can_turn_round(row_of(problem.start), check_time)[0]:
        return None
    reach = _reach(ground, _view(ground, problem.start), np.zeros((1, 3), np.int64), check_time)
    if reach is None or _may_be_met(problem, reach):
        return None
    return Impossible(
        Code.UNREACHABLE,
        Scope.THIS_START,
        f'{problem.agent} cannot get out of where it starts, between {listed(reach.names)}: there is no '
        f'room to turn with a radius of {ground.robot.turning_radius:.4g} m, and nowhere in there '
        f'{wanted(problem)} holds',
        f'{problem.agent} only drives forward: start elsewhere or with another heading',
    )


def unapproachable(
    problem: Problem, ground: Ground, known: Array, check_time: CheckTime
) -> Impossible | None:
    """Whether the car cannot get to where the constraints hold, as there is no room to turn there.

    No proof is looked for where there is room before some of the ``known`` destinations (n, 3).
    """
    backwards = known + np.array([0.0, 0.0, pi])
    if not ground.needs_room_to_turn or ground.can_turn_round(backwards, check_time).any():
        return None
    bounds = ground.scene.world.bounds
    left = branch_and_prune(problem.program, bounds, room=ground.room, budget=MOST_BOXES)
    if not len(left.low):
        return None
    middle = 0.5 * (left.low.min(axis=0) + left.high.max(axis=0))
    view = _view(ground, Attitude(float(middle[0]), float(middle[1]), 0.0))
    roots = _cells_over(left.low, left.high, view)
    reach = None if roots is None else _reach(ground, view, roots, check_time)
    if reach is None or _holds_backwards(reach, problem.start):
        return None
    return Impossible(
        Code.UNREACHABLE,
        Scope.THIS_START,
        f'{problem.agent} cannot get to where {wanted(problem)} holds: between {listed(reach.names)} there '
        f'is no room to turn into it with a radius of {ground.robot.turning_radius:.4g} m',
        f'{problem.agent} only drives forward: ask for other headings or more room',
    )


def _view(ground: Ground, middle: Attitude) -> View:
    radius, needed = ground.robot.turning_radius, necessary_clearance(ground.robot.body)
    side = min(OF_RADIUS * radius, OF_CLEARANCE * needed)
    return View(middle.x, middle.y, cos(middle.heading), sin(middle.heading), side, radius, needed)


def _reach(
    ground: Ground, view: View, roots: NDArray[np.int64], check_time: CheckTime
) -> Reach | None:
    """All that the car may get to from cells ``roots`` (k, 3), where that has an end."""
    parts, search = parts_of(view), new_search(roots, MOST_CELLS)
    state = GOES_ON
    while state == GOES_ON:
        check_time()
        state = go_on(ground.scene.shapes, view, strides(parts), search, CHUNK)
    if state != ENDED:
        return None
    cells, side = search.cells[: search.sizes[0]], view.side
    # During each part of a stride from each cell, as the window has it.
    moves = view.radius * sweeps(parts)[cells[:, 2]].reshape(-1, 4)
    corner = np.repeat((cells[:, :2] - 0.5) * side, parts, axis=0)
    low, high = corner + moves[:, 0::2], corner + side + moves[:, 1::2]
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    c, s = abs(view.cosine), abs(view.sine)
    x = view.x + middle[:, 0] * view.cosine - middle[:, 1] * view.sine
    y = view.y + middle[:, 0] * view.sine + middle[:, 1] * view.cosine
    wide = c * half[:, 0] + s * half[:, 1] + 1e-9 * view.radius
    tall = s * half[:, 0] + c * half[:, 1] + 1e-9 * view.radius
    width = tau / HEADINGS
    heading = atan2(view.sine, view.cosine) + width * np.repeat(cells[:, 2], parts)
    turned = 0.5 * width + np.tile(STRIDE * np.arange(1, parts + 1) / parts, len(cells)) + 1e-9
    clearance = ground.scene.clearance(np.column_stack((x, y)))
    is_free = clearance + np.hypot(wide, tall) * (1.0 + 1e-9) >= view.needed
    boxes_low = np.column_stack((x - wide, y - tall, heading - turned))[is_free]
    boxes_high = np.column_stack((x + wide, y + tall, heading + turned))[is_free]
    places = np.unique(cells[:, :2], axis=0)
    return Reach(boxes_low, boxes_high, _names(ground, places * side, view))


def _names(ground: Ground, places: NDArray[Any], view: View) -> tuple[str, ...]:
    """What is near the rim of ``places`` (n, 2) in the window, most often named first."""
    x = view.x + places[:, 0] * view.cosine - places[:, 1] * view.sine
    y = view.y + places[:, 0] * view.sine + places[:, 1] * view.cosine
    near = [ground.scene.nearest_obstacle(a, b)[0] for a, b in zip(x, y, strict=True)]
    return tuple(sorted(set(near), key=lambda name: (-near.count(name), name)))


def _may_be_met(problem: Problem, reach: Reach) -> bool:
    """Whether the constraints may hold somewhere in ``reach``."""
    for turn in range(-2, 3):
        low, high = reach.low.copy(), reach.high.copy()
        low[:, 2] = np.maximum(low[:, 2] + turn * tau, -pi)
        high[:, 2] = np.minimum(high[:, 2] + turn * tau, pi)
        some = low[:, 2] <= high[:, 2]
        if possible(problem.program, low[some], high[some]).any():
            return True
    return False


def _cells_over(low: Array, high: Array, view: View) -> NDArray[np.int64] | None:
    """Cells (k, 3) over boxes (n, 3) of attitudes, seen backwards; None where they are too many."""
    units = np.array([view.side, view.side, tau / HEADINGS])
    here = np.array([view.x, view.y, -pi])
    first = np.floor((low - here) / units + 0.5 - 1e-6).astype(np.int64)
    last = np.floor((high - here) / units + 0.5 + 1e-6).astype(np.int64)
    counts = (last - first + 1).prod(axis=1)
    is_outside = (first[:, :2] < -WINDOW // 2).any() or (last[:, :2] >= WINDOW // 2).any()
    if is_outside or int(counts.sum()) > 4 * MOST_ROOTS:
        return None
    found = [
        np.stack(np.meshgrid(*map(np.arange, a, b + 1), indexing='ij'), axis=-1).reshape(-1, 3)
        for a, b in zip(first, last, strict=True)
    ]
    cells = np.concatenate(found)
    cells[:, 2] %= HEADINGS
    cells = np.unique(cells, axis=0)
    return cells if len(cells) <= MOST_ROOTS else None


def _holds_backwards(reach: Reach, start: Attitude) -> bool:
    """Whether ``start``, seen backwards, is in ``reach``."""
    is_here = (reach.low[:, 0] <= start.x) & (start.x <= reach.high[:, 0])
    is_here &= (reach.low[:, 1] <= start.y) & (start.y <= reach.high[:, 1])
    middle = 0.5 * (reach.low[is_here, 2] + reach.high[is_here, 2])
    half = 0.5 * (reach.high[is_here, 2] - reach.low[is_here, 2])
    return any(
        abs(remainder(start.heading + pi - m, tau)) <= h
        for m, h in zip(middle.tolist(), half.tolist(), strict=True)
    )
