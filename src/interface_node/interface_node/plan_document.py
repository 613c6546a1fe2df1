"""``plan.json``: the plan for other people's programs (docs/outputs.md)."""

from __future__ import annotations

import json
from collections.abc import Mapping
from math import isfinite
from typing import Any

from interface_node.plan import Attitude, Diagnostic, Plan, Robot, Segment, Step


def plan_document(plan: Plan) -> dict[str, Any]:
    """The plan as JSON values, floats at full precision; what is not finite becomes null.

    A purely symbolic action starts and ends where the plan's robot stands at the time, null
    before it stands anywhere, and drives no segments.
    """
    robot = plan.robot
    standing = robot.start if robot else None
    steps = []
    for step in plan.steps:
        steps.append(_step(step, standing))
        if robot:
            standing = step.end_state.get(robot.label, standing)
    return {
        'outcome': plan.outcome,
        'explanation': plan.explanation,
        'diagnostics': [_diagnostic(remark) for remark in plan.diagnostics],
        'mission': plan.mission,
        'seed': plan.seed,
        'world': plan.world_path,
        'world_revision': plan.world.revision if plan.world else '',
        'robot': _robot(robot) if robot else None,
        'robots': [_robot(item) for item in plan.world.robots] if plan.world else [],
        'steps': steps,
        'length': number(plan.length),
        'duration': number(plan.duration),
        'planning_time': number(plan.planning_time),
        'improvements': [
            {'elapsed': number(told.elapsed), 'length': number(told.length)}
            for told in plan.improvements
        ],
        'statistics': _statistics(plan.statistics),
    }


def to_text(plan: Plan) -> str:
    """The text of ``plan.json``."""
    return json.dumps(plan_document(plan), indent=2, ensure_ascii=False, allow_nan=False) + '\n'


def number(value: float) -> float | None:
    """The value, or null where JSON has no word for it."""
    return value if isfinite(value) else None


def _step(step: Step, standing: Attitude | None) -> dict[str, Any]:
    return {
        'action': list(step.action),
        'agent': step.agent,
        'objects': list(step.objects),
        'assigned': step.assigned,
        'alternative': step.alternative,
        'cost': number(step.cost),
        'start': _attitude(step.start if step.agent else standing),
        'end': _attitude(step.end if step.agent else standing),
        'segments': [_segment(segment) for segment in step.segments],
        'length': number(step.length),
        'duration': number(step.duration),
        'clearance': number(step.clearance) if step.motion_start else None,
        'preconditions': step.preconditions,
        'residuals': [
            {
                'constraint': residual.constraint,
                'violation': number(residual.violation),
                'satisfied': residual.satisfied,
            }
            for residual in step.residuals
        ],
    }


def _segment(segment: Segment) -> list[float | None]:
    """Steering angle and length; direction and turn as well where there is one of them."""
    row = [segment.steering_angle, segment.length]
    if segment.direction or segment.turn:
        row += [segment.direction, segment.turn]
    return [number(value) for value in row]


def _attitude(attitude: Attitude | None) -> dict[str, float | None] | None:
    if attitude is None:
        return None
    return {
        'x': number(attitude.x),
        'y': number(attitude.y),
        'heading': number(attitude.heading),
    }


def _robot(robot: Robot) -> dict[str, Any]:
    return {
        'label': robot.label,
        'model': robot.model,
        'wheelbase': number(robot.wheelbase),
        'max_steering_angle': number(robot.max_steering_angle),
        'radius': number(robot.radius),
        'footprint': [[number(x), number(y)] for x, y in robot.footprint],
        'safety_margin': number(robot.safety_margin),
        'speed': number(robot.speed),
        'turning_speed': number(robot.turning_speed),
    }


def _diagnostic(remark: Diagnostic) -> dict[str, Any]:
    return {
        'severity': 'WARNING' if remark.warning else 'ERROR',
        'source': remark.source,
        'line': remark.line,
        'column': remark.column,
        'text': remark.text,
        'message': remark.message,
    }


def _statistics(statistics: Mapping[str, float]) -> dict[str, float | None]:
    return {name: number(value) for name, value in statistics.items()}
