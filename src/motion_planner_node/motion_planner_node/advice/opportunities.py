"""Where along planned motions the preconditions of other goals are met.

The paper's last research track: its penalty functions evaluated along a path.  They are sampled
along the motions; where one changes its sign between two samples, the place is narrowed down by
halving, so that equalities are found too, which hold at single attitudes only.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.paths.edges import Row, Rows
from motion_planner_node.robots.arcs import advance, wrap_angle
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.motion import Attitude, Motion
from motion_planner_node.robots.robot import Robot
from motion_planner_node.satisfaction import Program

#: Distance [m] and turn [rad] between two samples, wider where there would be more than so many.
SPACING, TURNING = 1.0, 0.1
MOST_SAMPLES = 65536
#: Halvings of an interval: they leave the last bits of its length.
HALVINGS = 50


class Track:
    """Motions of one robot, one after the other; a place on them is the number of a piece and a share.

    Piece k is driven at places k to k + 1.  Each motion ends in an empty piece of its own, so that
    its end is not the start of the next one.
    """

    def __init__(self, motions: Sequence[Motion], robot: Robot) -> None:
        pieces, joints = [], []
        for motion in motions:
            own = np.vstack((robot.pieces_of(motion.segments), np.zeros((1, 4))))
            pieces.append(own)
            start = motion.start
            joints.append(_joints(np.array([start.x, start.y, start.heading]), own))
        counts = np.array([len(own) for own in pieces])
        #: Where each motion begins and the last one ends, (n + 1,).
        self.firsts = np.concatenate(([0], np.cumsum(counts)))
        self._pieces, self._joints = np.concatenate(pieces), np.concatenate(joints)
        self._lengths = np.abs(self._pieces[:, 1])
        turns = np.abs(self._pieces[:, 0] * self._pieces[:, 1]) + np.abs(self._pieces[:, 3])
        steps = np.maximum(self._lengths / SPACING, turns / TURNING)
        steps = np.ceil(steps * min(1.0, MOST_SAMPLES / max(float(steps.sum()), 1.0)))
        steps = np.maximum(steps, 1.0).astype(np.int64)
        piece = np.repeat(np.arange(len(steps)), steps)
        step = np.arange(len(piece)) - np.repeat(np.cumsum(steps) - steps, steps)
        #: Places of the samples (n,), every joint of two segments among them.
        self.samples = piece + step / steps[piece]
        self.rows = self.at(self.samples)
        #: Whether the way goes on from a sample to the next one, (n - 1,).
        self.goes_on = ~np.isin(piece[:-1], self.firsts[1:] - 1)

    def at(self, places: Row) -> Rows:
        """Attitudes (n, 3) at ``places`` (n,), headings in (-pi, pi]."""
        return _at(self._joints, self._pieces, places)

    def attitude(self, place: float) -> Attitude:
        """The attitude at a place."""
        return Attitude(*self.at(np.array([place]))[0].tolist())

    def motion_of(self, places: Row) -> NDArray[np.int64]:
        """Numbers (n,) of the motions that ``places`` (n,) are on."""
        return np.asarray(np.searchsorted(self.firsts, places, side='right') - 1)

    def distance(self, place: float) -> float:
        """Way [m] from the start of the motion to a place on it."""
        piece = int(place)
        first = int(self.firsts[self.motion_of(np.array([place]))[0]])
        driven = float(self._lengths[first:piece].sum())
        return driven + (place - piece) * float(self._lengths[piece])


def first_places(program: Program, track: Track) -> Row:
    """The first place on each motion of ``track`` at which ``program`` is met, in order.

    Motions on which it is not met, as far as the samples show, have none.
    """
    values = _functions(program, track.rows)
    hopeful = track.goes_on.copy()
    met = np.ones(len(track.samples), np.bool_)
    for row, value in zip(program.rows, values, strict=True):
        holds = row.missed(value) <= program.tolerance
        met &= holds
        hopeful &= holds[:-1] | holds[1:] | _crosses(value, row.periodic)
    places = [track.samples[met]]
    for number, value in enumerate(values):
        places.append(_roots(program, track, number, value, hopeful))
    candidates = np.unique(np.concatenate(places))
    candidates = candidates[program.satisfied(track.at(candidates))]
    _, first = np.unique(track.motion_of(candidates), return_index=True)
    return np.asarray(candidates[first])


def _functions(program: Program, states: Rows) -> list[Row]:
    """The functions f_i (n,) of the constraints at attitudes (n, 3)."""
    return [
        np.broadcast_to(np.asarray(function.value, np.float64), (len(states),))
        for function in program.functions(states)
    ]


def _crosses(function: Row, periodic: bool) -> NDArray[np.bool_]:
    """Between which neighbours (n - 1,) the sign changes; a jump by half a turn is no change."""
    one, other = function[:-1], function[1:]
    crosses = ((one <= 0.0) != (other <= 0.0)) & np.isfinite(one) & np.isfinite(other)
    return np.asarray(crosses & (np.abs(one - other) < np.pi) if periodic else crosses)


def _roots(
    program: Program, track: Track, number: int, function: Row, hopeful: NDArray[np.bool_]
) -> Row:
    """Places on both sides of where a function changes its sign, in the ``hopeful`` intervals."""
    part = program.only([number])
    at = np.flatnonzero(hopeful & _crosses(function, part.rows[0].periodic))
    if not len(at):
        return np.empty(0)
    low, high = track.samples[at].copy(), track.samples[at + 1].copy()
    # The end of a piece is where the next one begins.
    is_met = function[at] <= 0.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        same = (_functions(part, track.at(middle))[0] <= 0.0) == is_met
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return np.concatenate((low, high))


@kernel
def _joints(start: Row, pieces: Rows) -> Rows:
    """Attitudes (n, 3) at which ``pieces`` (n, 4) begin; headings are not wrapped."""
    joints = np.empty((len(pieces), 3))
    x, y, heading = start[0], start[1], start[2]
    for k in range(len(pieces)):
        joints[k, 0], joints[k, 1], joints[k, 2] = x, y, heading
        bend, length, direction, turn = pieces[k]
        x, y, heading = advance(x, y, heading, bend, length, direction, turn)
    return joints


@kernel
def _at(joints: Rows, pieces: Rows, places: Row) -> Rows:
    rows = np.empty((len(places), 3))
    for i in range(len(places)):
        k = int(places[i])
        share = places[i] - k
        bend, length, direction, turn = pieces[k]
        x, y, heading = advance(
            joints[k, 0],
            joints[k, 1],
            joints[k, 2],
            bend,
            length * share,
            direction,
            turn * share,
        )
        rows[i, 0], rows[i, 1], rows[i, 2] = x, y, wrap_angle(heading)
    return rows
