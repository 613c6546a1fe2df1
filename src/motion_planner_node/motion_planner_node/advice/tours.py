"""Tours over the candidates of a request: the order, an end for each, and the length."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import replace
from math import inf

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.advice.costs import Driven, grouped
from motion_planner_node.codes import Purpose
from motion_planner_node.requests import AdviceAnswer, AdviceRequest, End
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.stopping import ShouldStop
from motion_planner_node.tours.goals import Goal
from motion_planner_node.tours.search import Tour, TourSearch

Precedences = NDArray[np.bool_]


def with_tour(
    answer: AdviceAnswer,
    request: AdviceRequest,
    driven: Mapping[int, Driven],
    should_stop: ShouldStop,
) -> AdviceAnswer:
    """``answer`` with a short tour over the candidates that are ``driven`` to.

    Each robot has a tour of its own; they are merged so that all precedences hold.  What needs no
    motion comes as early as it may, what is impossible last.

    :raises Stopped: when ``should_stop`` said so
    """
    count = len(answer.candidates)
    before = _closed(_precedences(request, count))
    possible = [
        index
        for index, item in enumerate(answer.candidates)
        if not item.impossible and item.estimate < inf
    ]
    ends: list[End | None] = [None] * count
    length = 0.0 if len(possible) == count else inf
    for mover, members in grouped({i: driven[i] for i in possible if i in driven}):
        tour = _tour_of(members, driven, before, request, should_stop)
        length += tour.length
        chain = [members[g] for g in tour.order]
        for one, other in itertools.pairwise(chain):
            before[one, other] = True
        before = _closed(before)
        if tour.length < inf:
            for index, row in zip(chain, tour.rows[1:].tolist(), strict=True):
                ends[index] = (mover, Attitude(*row))
    order = _merged(possible, before)
    reached = set(possible)
    order += [index for index in answer.order if index not in reached]
    return replace(answer, order=tuple(order), ends=tuple(ends), tour_length=length)


def _tour_of(
    members: list[int],
    driven: Mapping[int, Driven],
    before: Precedences,
    request: AdviceRequest,
    should_stop: ShouldStop,
) -> Tour:
    first = driven[members[0]]
    return TourSearch(
        first.survey.ground,
        np.array([first.start.x, first.start.y, first.start.heading]),
        goals_of(members, driven),
        before[np.ix_(members, members)],
        request.seed,
        request.effort,
        should_stop,
        _known_ends(members, driven, request),
        request.purpose == Purpose.FIXED_ORDER,
    ).run()


def goals_of(members: list[int], driven: Mapping[int, Driven]) -> list[Goal]:
    """The goals of a tour of one robot, with attitudes that meet them."""
    goals = []
    for index in members:
        program, states = driven[index].survey.problem.program, driven[index].reach.states
        met = program.satisfied(states)
        # Where no destination is known, the middles of cells stand for them.
        goals.append(Goal(program, states[met] if met.any() else states))
    return goals


def _known_ends(
    members: list[int], driven: Mapping[int, Driven], request: AdviceRequest
) -> NDArray[np.float64] | None:
    """The ends (n, 3) of the request, if they meet the preconditions and are free: all of them."""
    rows = []
    for index in members:
        end = request.ends[index] if request.ends else None
        survey = driven[index].survey
        if end is None or end[0] != survey.problem.agent or not survey.holds_at(end[1]):
            return None
        rows.append((end[1].x, end[1].y, end[1].heading))
    states = np.array(rows)
    return states if driven[members[0]].survey.ground.is_free(states).all() else None


def _precedences(request: AdviceRequest, count: int) -> Precedences:
    before = np.zeros((count, count), np.bool_)
    if request.purpose == Purpose.FIXED_ORDER:
        before[np.triu_indices(count, 1)] = True
    else:
        before[list(request.before), list(request.after)] = True
    return before


def _closed(before: Precedences) -> Precedences:
    """What has to come before what, also by way of others."""
    result = before.copy()
    for middle in np.flatnonzero(before.any(axis=0) & before.any(axis=1)):
        result |= np.outer(result[:, middle], result[middle])
    return result


def _merged(possible: list[int], before: Precedences) -> list[int]:
    """The ``possible`` candidates in an order that all precedences allow."""
    left, order = list(possible), []
    while left:
        inner = before[np.ix_(left, left)]
        free = left[int(np.flatnonzero(~inner.any(axis=0))[0])]
        left.remove(free)
        order.append(free)
    return order
