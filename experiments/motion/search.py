"""The search itself: states in the order of a bound of the way through them."""

from __future__ import annotations

from math import cos, hypot, inf, sin, tau

import numpy as np
from numpy.typing import NDArray

from experiments.motion.aims import Aim, heading_error, in_goal, wanted_heading
from experiments.motion.geometry import (
    Array,
    Ground,
    advanced,
    compiled,
    drive_is_free,
    dubins_length,
    free_word,
)

#: States between attempts to reach the goal from one that is far from it, and attitudes tried then.
SHOT_EVERY, FAR_SHOTS = 40, 2
#: Attitudes of the goal that are tried from one state near it, each time others.
SHOTS = 6
#: Attitudes around a state near the goal that are tried, too, where they are in the goal.
LOCAL = 24
#: Turning radii from the goal that are near.
NEAR = 3.0
#: Ways to the goal, each shorter than the one before, at most.
MOST_SHOTS = 4096

Table = NDArray[np.int32]


@compiled
def _note(shots: Array, count: int, node: int, end: Array, way: float) -> int:
    """Add a way to the goal, and say how many there are now."""
    if count == len(shots):
        return count
    shots[count, 0], shots[count, 4] = node, way
    for axis in range(3):
        shots[count, 1 + axis] = end[axis]
    return count + 1


@compiled
def _shoot(
    ground: Ground,
    aim: Aim,
    state: Array,
    node: int,
    turn: int,
    is_near: bool,
    best: float,
    shots: Array,
    count: int,
) -> tuple[float, int]:
    """Try words from a state (4,) to the goal: the length of the best way now, and the shots."""
    radius, way = ground.radius, state[3]
    pieces, goal = np.empty((6, 3)), np.empty(3)
    near = LOCAL if is_near and turn % 4 == 0 else 0
    for k in range(near + (SHOTS if is_near else FAR_SHOTS)):
        if k < near:
            away, toward = (1.0 + k % 3) * radius, tau * (k // 3) / (LOCAL // 3)
            goal[0], goal[1] = state[0] + away * cos(toward), state[1] + away * sin(toward)
            if not in_goal(aim, goal[0], goal[1], 0.0):
                continue
            goal[2] = wanted_heading(aim, goal[0], goal[1])
        else:
            goal[:] = aim.samples[(turn * SHOTS + k) % len(aim.samples)]
        if way + hypot(goal[0] - state[0], goal[1] - state[1]) >= best:
            continue
        if way + dubins_length(radius, state, goal) >= best:
            continue
        length, word = free_word(ground, state, goal, best - way, pieces)
        if word >= 0:
            best = way + length
            count = _note(shots, count, node, goal, best)
    return best, count


@compiled
def _grown(states: Array, links: Table, size: int) -> tuple[Array, Table]:
    """The same states with twice the room."""
    more = np.empty((2 * len(states), 4))
    more[:size] = states[:size]
    grown = np.empty((3, 2 * len(states)), np.int32)
    grown[:, :size] = links[:, :size]
    return more, grown


@compiled
def search(
    ground: Ground,
    field: Array,
    grid: float,
    bound: Array,
    start: Array,
    aim: Aim,
    kept: Table,
    cell: float,
    most: int,
) -> tuple[Array, Table, Array, bool]:
    """States (n, 4) x, y, heading, way; their parents; shots (m, 5) to the goal; and whether all.

    A shot is its state, the attitude that it ends in, and the length of the whole way. ``kept``
    (rows, columns, bins) is filled with -1, and tells the best state of each cell afterwards.
    """
    radius, corner = ground.radius, ground.bounds
    bins = kept.shape[2]
    step = radius * tau / bins
    rows, columns = field.shape
    states = np.empty((1 << 16, 4))
    # Of each state its parent, its heading bin and the next one in the same bucket.
    links = np.empty((3, 1 << 16), np.int32)
    shots = np.empty((MOST_SHOTS, 5))
    width = 0.25 * step
    heads = np.full(1 << 16, -1, np.int32)
    i = min(int((start[0] - corner[0]) / grid), columns - 1)
    j = min(int((start[1] - corner[1]) / grid), rows - 1)
    if bound[j, i] == inf:
        return states[:1], links[0, :1], shots[:0], True
    states[0, :3], states[0, 3] = start, 0.0
    links[0, 0], links[1, 0], links[2, 0] = -1, 0, -1
    size, count, popped, best = 1, 0, 0, inf
    bucket = int(max(bound[j, i] - 2.0 * grid, 0.0) / width)
    heads[bucket] = 0
    while bucket < len(heads):
        node = heads[bucket]
        if node < 0:
            bucket += 1
            continue
        if bucket * width >= best:
            break
        heads[bucket] = links[2, node]
        state = states[node].copy()
        x, y, heading, way = state[0], state[1], state[2], state[3]
        p = min(int((x - corner[0]) / cell), kept.shape[1] - 1)
        q = min(int((y - corner[1]) / cell), kept.shape[0] - 1)
        other = kept[q, p, links[1, node]]
        if other != node and node > 0 and other >= 0 and states[other, 3] < way:
            continue
        i = min(int((x - corner[0]) / grid), columns - 1)
        j = min(int((y - corner[1]) / grid), rows - 1)
        popped += 1
        is_near = bound[j, i] < NEAR * radius
        if in_goal(aim, x, y, 0.0) and heading_error(aim, x, y, heading) == 0.0:
            if way < best:
                best = way
                count = _note(shots, count, node, state, way)
        elif is_near or popped % SHOT_EVERY == 1:
            best, count = _shoot(ground, aim, state, node, popped, is_near, best, shots, count)
        if size + 3 > most:
            return states[:size], links[0, :size], shots[:count], False
        if size + 3 > len(states):
            states, links = _grown(states, links, size)
        for side in range(-1, 2):
            nx, ny, _ = advanced(x, y, heading, side, step, radius)
            i = int((nx - corner[0]) / grid)
            j = int((ny - corner[1]) / grid)
            if nx <= corner[0] or ny <= corner[1] or i >= columns or j >= rows:
                continue
            total = way + step + max(bound[j, i] - 2.0 * grid, 0.0)
            if not total < best:
                continue
            b = (links[1, node] + side) % bins
            p = min(int((nx - corner[0]) / cell), kept.shape[1] - 1)
            q = min(int((ny - corner[1]) / cell), kept.shape[0] - 1)
            if kept[q, p, b] >= 0 and states[kept[q, p, b], 3] <= way + step + 1e-9:
                continue
            # The disc is free all along where its clearance at the end is a step more than needed.
            gx = corner[0] + (i + 0.5) * grid - nx
            gy = corner[1] + (j + 0.5) * grid - ny
            if field[j, i] - hypot(gx, gy) < ground.margin + step and not drive_is_free(
                ground, x, y, heading, side, step
            ):
                continue
            kept[q, p, b] = size
            states[size, 0], states[size, 1] = nx, ny
            states[size, 2], states[size, 3] = heading + side * (tau / bins), way + step
            slot = max(int(total / width), bucket)
            if slot >= len(heads):
                longer = np.full(max(2 * len(heads), slot + 1), -1, np.int32)
                longer[: len(heads)] = heads
                heads = longer
            links[0, size], links[1, size], links[2, size] = node, b, heads[slot]
            heads[slot] = size
            size += 1
    return states[:size], links[0, :size], shots[:count], True
