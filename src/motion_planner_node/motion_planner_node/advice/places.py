"""Attitudes of every candidate, and what it is likely to cost to drive from any to any other."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import inf

import numpy as np

from motion_planner_node.advice.costs import Driven, grouped
from motion_planner_node.advice.tours import goals_of
from motion_planner_node.requests import AdviceAnswer, AdviceRequest, Place
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.stopping import ShouldStop
from motion_planner_node.tours.goals import attitudes
from motion_planner_node.tours.legs import Legs
from motion_planner_node.tours.samples import Samples, next_to

#: Attitudes of all candidates together, at most; each that may be met has one at least.
MOST_PLACES = 512


def with_places(
    answer: AdviceAnswer,
    request: AdviceRequest,
    driven: Mapping[int, Driven],
    should_stop: ShouldStop,
) -> AdviceAnswer:
    """``answer`` with ``request.places`` attitudes of each candidate at most, as far as any are known.

    Ends of the request are the first ones, also of candidates that cannot be met now.  The lengths
    [m], (n + 1, n) row by row, are from where the robots stand now, and then from each place;
    infinite between places of different robots, and of the same candidate.

    :raises Stopped: when ``should_stop`` said so
    """
    possible = {
        index: known for index, known in driven.items() if answer.candidates[index].estimate < inf
    }
    ends = {index: end for index, end in enumerate(request.ends) if end is not None}
    most = max(1, min(request.places, MOST_PLACES // max(1, len(possible.keys() | ends.keys()))))
    places: list[Place] = []
    blocks = []
    for mover, members in grouped(possible):
        first = possible[members[0]]
        ground, goals = first.survey.ground, goals_of(members, possible)
        start = np.array([first.start.x, first.start.y, first.start.heading])
        part = int(ground.parts_of(start[None, :])[0])
        found = attitudes(goals, ground, start[None, :], part, most, should_stop)
        rows_of = dict(zip(members, found, strict=True))
        for index, (robot, end) in ends.items():
            if robot == mover:
                others = rows_of.get(index, np.empty((0, 3)))
                row = np.array([[end.x, end.y, end.heading]])
                rows_of[index] = np.concatenate((row, others))[:most]
        before = np.zeros((len(rows_of) + 1, len(rows_of) + 1), np.bool_)
        before[0, 1:] = True
        legs = Legs(ground, request.seed, should_stop)
        states = list(rows_of.values())
        samples = Samples(ground, legs, start, states, most, next_to(before), should_stop)
        kept = [0]
        for number, (index, rows) in enumerate(rows_of.items(), 1):
            kept.extend(range(samples.first[number], samples.first[number] + len(rows)))
            places += [Place(index, mover, Attitude(*row)) for row in rows.tolist()]
        blocks.append(samples.costs[np.ix_(kept, kept[1:])])
    lengths = np.full((len(places) + 1, len(places)), inf)
    begin = 0
    for block in blocks:
        end_of = begin + block.shape[1]
        lengths[0, begin:end_of] = block[0]
        lengths[begin + 1 : end_of + 1, begin:end_of] = block[1:]
        begin = end_of
    return replace(answer, places=tuple(places), place_lengths=tuple(lengths.ravel().tolist()))
