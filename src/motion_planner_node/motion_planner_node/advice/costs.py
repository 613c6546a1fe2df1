"""Costs of many candidates from one attitude, all at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.advice.survey import Reach, Survey
from motion_planner_node.planning.ground import Ground
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.motion import Attitude

#: What a motion may end short of exactly meeting a constraint [m]; taken off lower bounds.
SLACK = 1e-6
#: Destinations of a candidate, the nearest round the obstacles, whose steering is looked at.
STEERED = 16


@dataclass(frozen=True, slots=True)
class Driven:
    """A candidate that may be met by driving from ``start``."""

    survey: Survey
    reach: Reach
    start: Attitude


def grouped(driven: Mapping[int, Driven]) -> list[tuple[str, list[int]]]:
    """Each robot that moves, and the numbers of its candidates."""
    groups: dict[str, list[int]] = {}
    for index, candidate in driven.items():
        groups.setdefault(candidate.survey.problem.agent, []).append(index)
    return list(groups.items())


def lower_bounds(ground: Ground, start: Attitude, reaches: Sequence[Reach]) -> NDArray[np.float64]:
    """Lengths [m], shape (n,), that no motion from ``start`` into what ``reaches`` hold is below.

    The larger of the straight distance to the nearest cell outside of which there is no destination,
    and of what a chain of cells that may be free leads to one of them.
    """
    rims = np.concatenate([reach.rim for reach in reaches])
    dx = np.maximum(np.maximum(rims[:, 0] - start.x, start.x - rims[:, 2]), 0.0)
    dy = np.maximum(np.maximum(rims[:, 1] - start.y, start.y - rims[:, 3]), 0.0)
    firsts = _firsts([reach.rim for reach in reaches])
    straight = np.sqrt(np.minimum.reduceat(dx * dx + dy * dy, firsts))
    outermost = np.concatenate([reach.outermost for reach in reaches])
    around = np.minimum.reduceat(ground.least_ways(start)[outermost], firsts)
    nearest = np.maximum(straight, around)
    cell = ground.cell_of(start)
    inside = np.array([cell >= 0 and reach.holds(cell) for reach in reaches])
    # The last bits of the root and the squares are on the safe side of the slack.
    return np.asarray(np.where(inside, 0.0, np.maximum(0.0, nearest * (1.0 - 1e-12) - SLACK)))


def estimates(ground: Ground, start: Attitude, reaches: Sequence[Reach]) -> NDArray[np.float64]:
    """Estimated lengths [m], shape (n,), of the motions from ``start`` to the nearest destinations.

    The larger of the way round the obstacles and the shortest motion without any; infinite where no
    way is known.
    """
    states = np.concatenate([reach.states for reach in reaches])
    counts = np.array([len(reach.states) for reach in reaches])
    around = ground.ways_round(start, states)
    chosen = nearest_of_each(around, counts, STEERED)
    owner = np.repeat(np.arange(len(reaches)), counts)[chosen]
    here = np.array([start.x, start.y, start.heading])
    lengths = np.maximum(around[chosen], ground.steered(here, states[chosen]))
    firsts = np.searchsorted(owner, np.arange(len(reaches)))
    return np.asarray(np.minimum.reduceat(lengths, firsts))


@kernel
def nearest_of_each(
    values: NDArray[np.float64], counts: NDArray[np.int64], most: int
) -> NDArray[np.int64]:
    """Indices of the ``most`` smallest of ``values`` in each group, groups in their order.

    The groups lie next to each other and have ``counts`` members. The smallest come first, of equal
    ones the one with the lower index.
    """
    chosen = np.empty(np.minimum(counts, most).sum(), np.int64)
    begin, end, first = 0, 0, 0
    for count in counts:
        for index in range(first, first + count):
            at = end
            while at > begin and values[index] < values[chosen[at - 1]]:
                at -= 1
            if at - begin < most:
                end = min(end + 1, begin + most)
                for moved in range(end - 1, at, -1):
                    chosen[moved] = chosen[moved - 1]
                chosen[at] = index
        begin, first = end, first + count
    return chosen


def _firsts(parts: Sequence[NDArray[np.float64]]) -> NDArray[np.int64]:
    """Where each of ``parts`` begins in their concatenation."""
    counts = np.array([len(part) for part in parts], dtype=np.int64)
    return np.asarray(np.cumsum(counts) - counts)
