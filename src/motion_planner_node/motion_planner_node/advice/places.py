"""Attitudes of every candidate, and what it is likely to cost to drive from any to any other."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from math import inf

import numpy as np

from motion_planner_node.advice.costs import Driven
from motion_planner_node.advice.tours import goals_of
from motion_planner_node.paths.edges import Row, Rows
from motion_planner_node.planning.ground import Ground
from motion_planner_node.requests import AdviceAnswer, AdviceRequest, Place
from motion_planner_node.robots.motion import Attitude, GeometricState
from motion_planner_node.stopping import ShouldStop
from motion_planner_node.tours.goals import attitudes
from motion_planner_node.tours.legs import Legs
from motion_planner_node.tours.precedences import from_start, next_to
from motion_planner_node.tours.samples import Samples

#: Attitudes of all candidates together, at most; each that may be met has one at least.
MOST_PLACES = 512


def with_places(
    answer: AdviceAnswer,
    request: AdviceRequest,
    driven: Mapping[int, Driven],
    movers: Sequence[str],
    state: GeometricState,
    ground_of: Callable[[str], Ground],
    should_stop: ShouldStop,
) -> AdviceAnswer:
    """``answer`` with ``request.places`` attitudes of each candidate at most, as far as any are known.

    ``movers`` are the robots that meet the candidates, ``state`` is where all stand.  Ends of the request are the first places, also
    of candidates that cannot be met now; those of other robots are left out.  The lengths [m],
    (n + 1, n) row by row, are from where the robots stand now, and then from each place; infinite
    between places of different robots, and of the same candidate.

    :raises Stopped: when ``should_stop`` said so
    """
    possible = {
        index: known for index, known in driven.items() if answer.candidates[index].estimate < inf
    }
    ends = {
        index: end[1]
        for index, end in enumerate(request.ends)
        if end is not None and end[0] == movers[index] and end[0] in state
    }
    known = sorted(possible.keys() | ends.keys())
    most = max(1, min(request.places, MOST_PLACES // max(1, len(known))))
    places: list[Place] = []
    blocks = []
    for mover in dict.fromkeys(movers[index] for index in known):
        ground, here = ground_of(mover), state[mover]
        start = np.array([here.x, here.y, here.heading])
        members = [index for index in possible if movers[index] == mover]
        rows_of = _attitudes(members, possible, ground, start, most, should_stop)
        for index, end in ends.items():
            if movers[index] == mover:
                row = np.array([[end.x, end.y, end.heading]])
                rows_of[index] = np.concatenate((row, rows_of.get(index, row[:0])))[:most]
        adjacent = next_to(from_start(np.zeros((len(rows_of), len(rows_of)), np.bool_)))
        legs = Legs(ground, request.seed, should_stop)
        states = list(rows_of.values())
        samples = Samples(ground, legs, start, states, most, adjacent, should_stop)
        kept = [0]
        for number, (index, rows) in enumerate(rows_of.items(), 1):
            kept.extend(range(samples.first[number], samples.first[number] + len(rows)))
            places += [Place(index, mover, Attitude(*row)) for row in rows.tolist()]
        blocks.append(samples.costs[np.ix_(kept, kept[1:])].astype(np.float64))
    return replace(answer, places=tuple(places), place_lengths=_joined(blocks))


def _attitudes(
    members: list[int],
    driven: Mapping[int, Driven],
    ground: Ground,
    start: Row,
    most: int,
    should_stop: ShouldStop,
) -> dict[int, Rows]:
    """Attitudes of candidates that one robot meets, by number; none where no destination is known."""
    if not members:
        return {}
    goals = goals_of(members, driven)
    part = int(ground.parts_of(start[None, :])[0])
    found = attitudes(goals, ground, start[None, :], part, most, should_stop)
    met = {
        index: rows[goal.program.satisfied(rows)]
        for index, goal, rows in zip(members, goals, found, strict=True)
    }
    return {index: rows for index, rows in met.items() if len(rows)}


def _joined(blocks: Sequence[Rows]) -> tuple[float, ...]:
    """The lengths of all robots, row by row; ``blocks`` (n + 1, n) are those of each."""
    count = sum(block.shape[1] for block in blocks)
    lengths = np.full((count + 1, count), inf)
    begin = 0
    for block in blocks:
        end = begin + block.shape[1]
        lengths[0, begin:end] = block[0]
        lengths[begin + 1 : end + 1, begin:end] = block[1:]
        begin = end
    return tuple(lengths.ravel().tolist())
