"""A solved mission for people: the plan as the paper prints it, a table of steps, the totals."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import accumulate
from math import atan2, degrees, hypot, pi, remainder

from interface_node.command_line.results import MissionResult
from interface_node.plan import Attitude, Plan, Step, World

_HEADINGS = (
    '#',
    'action',
    'x [m]',
    'y [m]',
    'heading [deg]',
    'distance [m]',
    'angle [deg]',
    'path [m]',
    'total [m]',
)
_NOTHING = '-'


def solution_plan(steps: Iterable[Step]) -> tuple[str, ...]:
    """The numbered actions under ``SOLUTION PLAN:``, as the paper prints them."""
    return (
        'SOLUTION PLAN:',
        *(f'{k}:({" ".join(step.action)})' for k, step in enumerate(steps, start=1)),
    )


def objective(step: Step, world: World | None) -> tuple[float, float] | None:
    """Where the first object that a step is about stands [m]; nothing when it is about none."""
    places = world.objects if world else {}
    return next((places[label] for label in step.objects if label in places), None)


def distance_and_angle(
    attitude: Attitude, place: tuple[float, float]
) -> tuple[float, float | None]:
    """Distance [m] from an attitude to a place, and the paper's rel_angle [rad] (Table 2).

    The angle is the heading minus the bearing of the place, in [-pi, pi]: a place on the robot's
    right is at +pi/2, one straight ahead at 0. At the place itself there is none.
    """
    dx, dy = place[0] - attitude.x, place[1] - attitude.y
    distance = hypot(dx, dy)
    if distance == 0.0:
        return distance, None
    return distance, remainder(attitude.heading - atan2(dy, dx), 2 * pi)


def step_table(plan: Plan) -> tuple[str, ...]:
    """One row a step under a row of headings and a rule; numbers are aligned at the right."""
    totals = accumulate(step.length for step in plan.steps)
    numbered = enumerate(zip(plan.steps, totals, strict=True), start=1)
    rows = [_HEADINGS, *(_row(k, s, plan.world, total) for k, (s, total) in numbered)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        '  '.join(
            cell.ljust(width) if k == 1 else cell.rjust(width)
            for k, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]
    rule = '  '.join('-' * width for width in widths)
    return (lines[0], rule, *lines[1:])


def totals(result: MissionResult) -> tuple[str, ...]:
    """Length, time and where it went, requests and backtracks, and the files, a line each."""
    plan = result.plan
    counted = plan.statistics
    search, requests, transport = (
        f'{counted.get(name, 0.0):.3f} s'
        for name in ('search_time', 'request_time', 'transport_time')
    )
    asked, found, impossible, unknown, advices, tasks, destinations = (
        int(counted.get(name, 0))
        for name in (
            'requests',
            'found',
            'impossible',
            'unknown',
            'advices',
            'backtracks',
            'geometric_backtracks',
        )
    )
    times = f'search {search}, requests {requests}, transport {transport}'
    answers = f'{found} found, {impossible} impossible, {unknown} unknown'
    improvements = int(counted.get('improvements', 0))
    met = int(counted.get('opportunities', 0))
    better = f'{improvements} ({met} goals met on the way)' if improvements else ''
    lines = [
        ('length', f'{plan.length:.1f} m'),
        ('planning time', f'{plan.planning_time:.3f} s ({times})'),
        *([('improvements', better)] if better else []),
        ('requests', f'{asked} ({answers}), {advices} advices'),
        ('backtracks', f'{tasks} over tasks, {destinations} over destinations'),
        *(('' if k else 'files', file) for k, file in enumerate(result.files)),
    ]
    return tuple(f'{name:<14} {text}' for name, text in lines)


def _row(number: int, step: Step, world: World | None, total: float) -> tuple[str, ...]:
    place = objective(step, world)
    end = step.end
    distance, angle = distance_and_angle(end, place) if end and place else (None, None)
    return (
        str(number),
        ' '.join(step.action),
        _decimal(end.x if end else None),
        _decimal(end.y if end else None),
        _decimal(degrees(end.heading) if end else None),
        _decimal(distance),
        _decimal(None if angle is None else degrees(angle)),
        _decimal(step.length if end else None),
        _decimal(total),
    )


def _decimal(value: float | None) -> str:
    return _NOTHING if value is None else f'{round(value, 1) + 0.0:.1f}'
