"""What it costs from each candidate to each other one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.advice.costs import SLACK, Driven, grouped, nearest_of_each
from motion_planner_node.advice.survey import Reach, spread
from motion_planner_node.codes import Code
from motion_planner_node.planning.ground import Ground
from motion_planner_node.requests import CandidateAdvice
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.stopping import ShouldStop, go_on

Matrix = NDArray[np.float64]

#: Boxes that cover the destinations of one candidate at most, for lower bounds.
MOST_BOXES = 64
#: Ways round the obstacles that are worked out, one from each destination that stands for others.
WAYS = 64
#: Destinations that stand for all of a candidate at most, as places to come from.
MOST_ORIGINS = 4
#: Destinations to which ways are worked out, from each that stands for others, and those of them
#: whose steering is looked at, of all candidates together.
MOST_TARGETS, ALL_STEERED = 8192, 1024
#: Destinations of a candidate, the nearest round the obstacles, whose steering is looked at, at most.
STEERED = 4


def matrices(
    candidates: Sequence[CandidateAdvice], driven: Mapping[int, Driven], should_stop: ShouldStop
) -> tuple[Matrix, Matrix]:
    """Lower bounds and estimates [m], both (n, n): row i is what each candidate costs after i.

    Where another robot moves than in i, that is its cost from where it stands now.  After commands
    nothing is known of where the robot drives from: the bound is 0, the estimate that from its
    start.  Infinite for what is impossible, and after it.

    :raises Stopped: when ``should_stop`` said so
    """
    count = len(candidates)
    valid = np.array(
        [not item.impossible and item.code < Code.INVALID_PRECONDITIONS for item in candidates],
        np.bool_,
    )
    bounds = np.tile([item.lower_bound for item in candidates], (count, 1))
    expected = np.tile([item.estimate for item in candidates], (count, 1))
    moved = np.array([index in driven for index in range(count)], np.bool_)
    bounds[np.ix_(~moved, moved)] = 0.0
    for mover, members in grouped(driven):
        reaches = [driven[index].reach for index in members]
        ground = driven[members[0]].survey.ground
        own = np.ix_(members, members)
        bounds[own] = lower_bounds(reaches, should_stop)
        expected[own] = np.maximum(bounds[own], estimates(ground, reaches, should_stop))
        for index, candidate in driven.items():
            # Where this robot stands matters to the candidate, although another one moves.
            if index not in members and mover in candidate.survey.problem.program.agents:
                bounds[members, index] = 0.0
    for matrix in (bounds, expected):
        matrix[~valid, :] = matrix[:, ~valid] = np.inf
        np.fill_diagonal(matrix, np.where(valid, 0.0, np.inf))
    return bounds, expected


def lower_bounds(reaches: Sequence[Reach], should_stop: ShouldStop) -> Matrix:
    """Lengths [m], (n, n), that no motion from a destination of one to one of another is below.

    The straight distances between boxes that cover the rims of the destinations; 0 where two
    candidates have a place in common, and from a candidate to itself.

    :raises Stopped: when ``should_stop`` said so
    """
    covers = [_cover(reach.rim) for reach in reaches]
    around = np.array([_around(cover) for cover in covers])
    boxes = np.concatenate(covers)
    ends = np.cumsum([len(cover) for cover in covers])
    cells = np.stack([reach.cells for reach in reaches])
    result = np.zeros((len(reaches), len(reaches)))
    # What has a cell in common has an outermost cell of one in common: rims of sets that are inside
    # of others can be far apart.
    shared = np.zeros((len(reaches), len(reaches)), np.bool_)
    for one, reach in enumerate(reaches):
        go_on(should_stop)
        _distances(boxes, ends, around, one, result[one])
        _find_shared(cells, reach.outermost, around, one, shared[one])
    result = np.where(shared | shared.T, 0.0, np.maximum(result, result.T))
    return np.maximum(0.0, result * (1.0 - 1e-12) - SLACK)


def estimates(ground: Ground, reaches: Sequence[Reach], should_stop: ShouldStop) -> Matrix:
    """Estimated lengths [m], (n, n), of the motions from one candidate's destinations to another's.

    The least over destinations that stand for the others; infinite where no way is known, and 0
    from a candidate to itself.

    :raises Stopped: when ``should_stop`` said so
    """
    count = len(reaches)
    origins = max(1, min(MOST_ORIGINS, WAYS // count))
    most = max(STEERED, MOST_TARGETS // count)
    steered = max(1, min(STEERED, ALL_STEERED // count))
    chosen = [reach.states[spread(len(reach.states), most)] for reach in reaches]
    states, counts = np.concatenate(chosen), np.array([len(part) for part in chosen])
    owner = np.repeat(np.arange(count), counts)
    result = np.full((count, count), np.inf)
    for one, reach in enumerate(reaches):
        for origin in reach.states[spread(len(reach.states), origins)]:
            go_on(should_stop)
            around = ground.ways_round(Attitude(*map(float, origin)), states)
            near = nearest_of_each(around, counts, steered)
            lengths = np.maximum(around[near], ground.steered(origin, states[near]))
            begins = np.searchsorted(owner[near], np.arange(count))
            result[one] = np.minimum(result[one], np.minimum.reduceat(lengths, begins))
    np.fill_diagonal(result, 0.0)
    return result


def _cover(rim: Matrix) -> Matrix:
    """At most about MOST_BOXES boxes (m, 4) that cover the boxes of ``rim`` (n, 4)."""
    if len(rim) <= MOST_BOXES:
        return rim
    low, high = rim[:, :2].min(axis=0), rim[:, 2:].max(axis=0)
    # A curve of n cells meets some n / k of the squares of k cells' side.
    side = float(max(high - low)) / (MOST_BOXES / 4)
    column, row = np.floor((rim[:, :2] - low) / max(side, 1e-9)).astype(np.int64).T
    _, group = np.unique(row * (column.max() + 1) + column, return_inverse=True)
    while group.max() >= MOST_BOXES:
        group //= 2
    cover = np.tile([np.inf, np.inf, -np.inf, -np.inf], (int(group.max()) + 1, 1))
    for side, outer in enumerate((np.minimum, np.minimum, np.maximum, np.maximum)):
        outer.at(cover[:, side], group, rim[:, side])
    return cover


def _around(boxes: Matrix) -> Matrix:
    """The box (4,) round ``boxes`` (n, 4)."""
    return np.concatenate([boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)])


@kernel
def _square_apart(one: Matrix, other: Matrix) -> float:
    """Squared distance [m^2] between two boxes (4,)."""
    dx = max(one[0] - other[2], other[0] - one[2], 0.0)
    dy = max(one[1] - other[3], other[1] - one[3], 0.0)
    return float(dx * dx + dy * dy)


@kernel
def _distances(
    boxes: Matrix,
    ends: NDArray[np.int64],
    around: Matrix,
    one: int,
    row: NDArray[np.float64],
) -> None:
    """Fill ``row`` with the distances [m] of group ``one`` of the boxes to those that follow it.

    ``around`` (n, 4) are the boxes round each group.
    """
    begin = 0 if one == 0 else ends[one - 1]
    for other in range(one + 1, len(ends)):
        nearest = np.inf
        for i in range(begin, ends[one]):
            if _square_apart(boxes[i], around[other]) >= nearest:
                continue
            for j in range(ends[other - 1], ends[other]):
                nearest = min(nearest, _square_apart(boxes[i], boxes[j]))
            if nearest == 0.0:
                break
        row[other] = np.sqrt(nearest)


@kernel
def _find_shared(
    cells: NDArray[np.uint8],
    outermost: NDArray[np.intp],
    around: Matrix,
    one: int,
    row: NDArray[np.bool_],
) -> None:
    """Mark in ``row`` (n,) which of the sets ``cells`` (n, bytes) hold any of the cells (k,).

    These are those of set ``one``; ``around`` (n, 4) are the boxes round each set.
    """
    for other in range(len(row)):
        if _square_apart(around[one], around[other]) > 0.0:
            continue
        for cell in outermost:
            if cells[other, cell >> 3] >> (7 - (cell & 7)) & 1:
                row[other] = True
                break
