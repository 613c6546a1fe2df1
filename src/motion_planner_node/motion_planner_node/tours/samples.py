"""Attitudes of all goals, and a matrix of what it is likely to cost to drive between them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.paths.edges import Row, Rows
from motion_planner_node.planning.ground import Ground
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.stopping import ShouldStop, go_on
from motion_planner_node.tours.legs import Legs, expected_lengths

#: Places of each goal for attitudes that are found later; the oldest of them make room.
SPARE, FEW = 24, 32
#: Goals near a goal between which steering is looked at; where there are no more, between all.
STEERED = 10
#: Attitudes of each goal, at least, for which the ways round the obstacles are worked out.
FIELDS = 48


class Samples:
    """Group 0 is the start, group g + 1 goal g; see `chains` for what the arrays are.

    costs: (N, N) [m]; those that were made real ones stay.  They are worked out where a goal may
    come right after another one: ``next_to`` (groups, groups) tells, and they are infinite elsewhere.
    """

    def __init__(
        self,
        ground: Ground,
        legs: Legs,
        start: Row,
        states: Sequence[Rows],
        most: int,
        next_to: NDArray[np.bool_],
        should_stop: ShouldStop,
    ) -> None:
        self._ground, self._legs = ground, legs
        self._next_to = next_to
        spare = SPARE if len(states) <= FEW else 2
        size = most + spare
        self._kept = np.array([1, *(len(rows) for rows in states)])
        self._room = np.array([1, *(min(size, len(rows) + spare) for rows in states)])
        self._added = np.zeros(len(self._room), np.int64)
        self.first = np.cumsum(self._room) - self._room
        self.count = self._kept.copy()
        total = int(self._room.sum())
        self.states = np.zeros((total, 3))
        self.owner = np.repeat(np.arange(len(self._room)), self._room)
        self.costs = np.full((total, total), np.inf, np.float32)
        self._real = np.zeros((total, total), np.bool_)
        for group, rows in enumerate((start[None, :], *states)):
            begin = self.first[group]
            self.states[begin : begin + len(rows)] = rows
        middles = np.array(
            [
                self.states[f : f + c, :2].mean(axis=0)
                for f, c in zip(self.first, self.count, strict=True)
            ]
        )
        self._near = np.zeros((len(middles), len(middles)), np.bool_)
        for group, middle in enumerate(middles):
            order = np.argsort(np.hypot(*(middles - middle).T), kind='stable')
            self._near[group, order[: STEERED + 1]] = True
        self._near |= self._near.T
        self._representatives = max(1, min(4, FIELDS // len(middles)))
        for group in range(len(middles)):
            go_on(should_stop)
            self._fill(group)

    def add(self, goals: np.ndarray, rows: Rows, should_stop: ShouldStop) -> None:
        """Add one more attitude (n, 3) for each of ``goals`` (n,).

        :raises Stopped: when ``should_stop`` said so
        """
        for goal, row in zip(goals, rows, strict=True):
            go_on(should_stop)
            group = int(goal) + 1
            begin, count = self.first[group], self.count[group]
            if (self.states[begin : begin + count] == row).all(axis=1).any():
                continue
            spare = self._room[group] - self._kept[group]
            if spare == 0:
                continue
            at = begin + self._kept[group] + self._added[group] % spare
            self._added[group] += 1
            self.count[group] = min(count + 1, self._room[group])
            self.states[at] = row
            self._real[at], self._real[:, at] = False, False
            around = self._around(row)
            self._cost_from(int(at), around, self._near[group][self.owner])
            self._cost_to(int(at), around)

    def make_real(self, here: int, there: int) -> bool:
        """Replace an expected cost by that of a planned way; whether it was not one yet."""
        if self._real[here, there]:
            return False
        self._real[here, there] = True
        length = self._legs.leg(self.states[here], self.states[there])[0]
        before, self.costs[here, there] = float(self.costs[here, there]), length
        return not abs(length - before) <= 1e-3 * before

    def _fill(self, group: int) -> None:
        begin, count = int(self.first[group]), int(self.count[group])
        own = self.states[begin : begin + count]
        stands = own[np.arange(self._representatives) * count // self._representatives]
        fields = [(row, self._around(row)) for row in stands]
        for index in range(begin, begin + count):
            row = self.states[index]
            apart = [float(np.hypot(*(row - other)[:2])) for other, _ in fields]
            nearest = int(np.argmin(apart))
            self._cost_from(
                index, fields[nearest][1] - apart[nearest], self._near[group][self.owner]
            )

    def _around(self, row: Row) -> Row:
        return self._ground.ways_round(Attitude(*row.tolist()), self.states)

    def _cost_from(self, index: int, around: Row, steered: np.ndarray) -> None:
        """Work out the costs from the attitude number ``index``."""
        active = self._active() & self._next_to[self.owner[index]][self.owner]
        lengths = expected_lengths(
            self._legs.frame,
            self.states[index : index + 1],
            self.states[active],
            around[active],
            steered[active],
        )
        row = self.costs[index]
        known = self._real[index]
        fresh = np.full(len(row), np.inf, np.float32)
        fresh[active] = lengths
        self.costs[index] = np.where(known, row, fresh)

    def _cost_to(self, index: int, around: Row) -> None:
        """Work out the costs to the attitude number ``index`` from all others."""
        group = self.owner[index]
        others = np.flatnonzero(self._active() & self._next_to[self.owner, group])
        self.costs[others, index] = expected_lengths(
            self._legs.frame,
            self.states[others],
            self.states[index : index + 1],
            around[others],
            self._near[self.owner[others], group],
        )

    def _active(self) -> np.ndarray:
        place = np.arange(len(self.states)) - self.first[self.owner]
        return np.asarray(place < self.count[self.owner])
