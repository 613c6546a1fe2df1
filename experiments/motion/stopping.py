"""How soon a search stops that is told to: the longest that it went on.

Searches are told so as by the node: by a deadline, or by another thread that cancels them. They have
the world to themselves, or another robot stands in it at a new place each time: then all that is
known of the free space is worked out anew within the request.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import replace
from threading import Timer
from time import perf_counter
from typing import Any

import numpy as np

from experiments.motion.asking import planner_for, request_of
from experiments.motion.goals import AGENT
from experiments.motion.reference import Known
from experiments.motion.worlds import Place
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.turns import Turns

OTHER = 'other'
#: Times [s] after which searches are told to stop.
MOMENTS = (0.0, 0.001, 0.003, 0.01, 0.03, 0.1)
#: Budget [s] of requests that are cancelled.
PATIENCE = 60.0


def measure(place: Place, known: Sequence[Known]) -> list[dict[str, Any]]:
    """By how many milliseconds answers came later than the moment at which they were to stop.

    Each row is of one way of telling so, alone or beside another robot; its figures are of the
    requests that were not answered by then.
    """
    crowded = {**place.document, 'robots': {name: dict(place.robot) for name in (AGENT, OTHER)}}
    planner = planner_for(replace(place, name=f'{place.name}_crowded', document=crowded))
    rows: list[dict[str, Any]] = []
    for is_crowded, is_cancelled in itertools.product((False, True), repeat=2):
        late = []
        for number, one in enumerate(known):
            request = replace(request_of(one), request_id='it', seed=len(rows))
            if is_crowded:
                request = _beside(request, _free_place(known, number, place))
            late.append(_late(planner, request, MOMENTS[number % len(MOMENTS)], is_cancelled))
        running = 1e3 * np.array([seconds for seconds in late if seconds > 0.0])
        rows.append({
            'beside_another': is_crowded,
            'told_by': 'cancel' if is_cancelled else 'deadline',
            'requests': len(late),
            'stopped': len(running),
            'late_ms_p50': float(np.median(running)),
            'late_ms_p99': float(np.percentile(running, 99)),
            'late_ms_max': float(running.max()),
        })  # fmt: skip
    return rows


def _late(
    planner: MotionPlanner, request: GeometricRequest, moment: float, is_cancelled: bool
) -> float:
    """Time [s] from the moment at which a request was to stop to its end."""
    turns = Turns()
    timer = Timer(moment, turns.cancel, (request.request_id,))
    began = perf_counter()
    with turns.take(request.request_id, PATIENCE if is_cancelled else moment) as turn:
        if is_cancelled:
            timer.start()
        planner.satisfy(request, turn)
    late = perf_counter() - began - moment
    timer.cancel()
    return late


def _free_place(known: Sequence[Known], number: int, place: Place) -> Attitude:
    """The start of another request, where the other robot stands apart from the one that drives."""
    here = known[number].start
    for other in itertools.chain(known[number + 1 :], known):
        if math.dist(other.start[:2], here[:2]) > 3.0 * place.robot['radius']:
            return Attitude(*other.start)
    raise ValueError('all requests start at one place')


def _beside(request: GeometricRequest, at: Attitude) -> GeometricRequest:
    return replace(request, start={**request.start, OTHER: at})
