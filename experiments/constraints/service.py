"""What a request costs through the service, beside a bare round trip to the same node.

The bare exchange is ``get_parameter_types`` of one parameter, which rclpy answers without the
motion planner. The request is the paper's take_photo from an attitude that meets it already: the
motion planner reads, checks, compiles and solves the constraints, and hands out a motion of length
0, so that no path is planned. Every request starts elsewhere, so that no answer is remembered.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable, Mapping
from math import atan2, cos, pi, remainder, sin, tau
from time import perf_counter
from typing import Any

from geohtn_msgs import msg, srv
from rcl_interfaces.srv import GetParameterTypes

from experiments.constraints.sets import AGENT, WORLD, ConstraintSet, read_map
from experiments.exchange import client, motion_planner, own_namespace

#: Exchanges before the measurement begins.
WARM_UP = 30

Call = Callable[[int], Any]

_BARE = GetParameterTypes.Request(names=['time_budget'])


def measure(take_photo: ConstraintSet, count: int) -> dict[str, Any]:
    """Median times [ms] of ``count`` exchanges of each kind, taken in turns."""
    namespace = own_namespace('constraints')
    services = {
        GetParameterTypes: 'motion_planner_node/get_parameter_types',
        srv.SatisfyPreconditions: 'satisfy_preconditions',
    }
    target = read_map()['objects'][take_photo.objects[0]]
    asked = [_request(take_photo, target, k) for k in range(WARM_UP + count)]
    refused = _request(take_photo, target, 0, revision='another')
    with motion_planner(namespace, WORLD), client(namespace, services) as exchange:
        kinds: dict[str, Call] = {
            'bare': lambda _: exchange(GetParameterTypes, _BARE),
            'refused': lambda _: exchange(srv.SatisfyPreconditions, refused),
            'take_photo': lambda k: exchange(srv.SatisfyPreconditions, asked[k]),
        }
        for k in range(WARM_UP):
            for call in kinds.values():
                call(k)
        times: dict[str, list[float]] = {name: [] for name in kinds}
        within = []
        for k in range(WARM_UP, WARM_UP + count):
            for name, call in kinds.items():
                began = perf_counter()
                response = call(k)
                times[name].append(1e3 * (perf_counter() - began))
            answer = response.answer
            if answer.status != msg.GeometricAnswer.FOUND or answer.motion.segments:
                raise SystemExit(f'take_photo was not answered as expected: {answer.message}')
            within.append(1e3 * answer.time_spent)
    medians = {name: statistics.median(values) for name, values in times.items()}
    return {
        'exchanges': count,
        'median_ms': medians,
        'within_the_node_ms': statistics.median(within),
        'more_than_bare_ms': medians['take_photo'] - medians['bare'],
    }


def _request(
    take_photo: ConstraintSet, target: Mapping[str, float], k: int, revision: str = ''
) -> Any:
    """take_photo from an attitude on a ring round the object, with the object on the right."""
    turned, distance = k * (3.0 - 5.0**0.5) * pi, 60.0 + (k % 7) * 5.0
    x, y = target['x'] + distance * cos(turned), target['y'] + distance * sin(turned)
    heading = remainder(atan2(target['y'] - y, target['x'] - x) + pi / 2, tau)
    start = msg.AgentState(agent=AGENT, x=x, y=y, heading=heading)
    return srv.SatisfyPreconditions.Request(
        request=msg.GeometricRequest(
            preconditions=take_photo.text,
            start=[start],
            agent=AGENT,
            world_revision=revision,
        )
    )
