"""Messages to plain dataclasses and back: what the planners answer, the world, and remarks."""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Mapping
from math import atan2

import numpy as np
from geohtn_msgs import msg
from nav_msgs.msg import OccupancyGrid

from interface_node.plan import (
    Attitude,
    Diagnostic,
    Obstacle,
    Occupancy,
    Plan,
    Residual,
    Robot,
    Segment,
    Step,
    World,
)

#: Names of the outcomes by their value, for example SOLVED.
OUTCOMES: Mapping[int, str] = {
    getattr(msg.Outcome, name): name
    for name in ('SOLVED', 'NO_PLAN', 'LIMIT', 'CANCELLED', 'INVALID', 'UNAVAILABLE', 'FAILED')
}


def plan_from_messages(
    plan: msg.GlobalPlan,
    outcome: msg.Outcome,
    statistics: msg.PlanningStatistics,
    *,
    world_path: str,
    seed: int,
) -> Plan:
    """A plan with how the search for it ended; without a world when the message has none."""
    return Plan(
        mission=plan.mission,
        outcome=OUTCOMES.get(outcome.value, f'outcome {outcome.value}'),
        explanation=outcome.explanation,
        diagnostics=tuple(diagnostic_from_message(remark) for remark in outcome.diagnostics),
        world_path=world_path,
        world=world_from_message(plan.world) if plan.world.revision else None,
        steps=tuple(step_from_message(step) for step in plan.steps),
        seed=seed,
        planning_time=plan.planning_time,
        statistics={
            name: getattr(statistics, name) for name in statistics.get_fields_and_field_types()
        },
    )


def world_from_message(world: msg.World) -> World:
    """The world; an object's fields other than x and y are left out."""
    objects = {}
    for thing in world.objects:
        fields = dict(zip(thing.field_names, thing.field_values, strict=True))
        objects[thing.label] = (float(fields['x']), float(fields['y']))
    return World(
        source=world.source,
        revision=world.revision,
        bounds=(world.x_min, world.y_min, world.x_max, world.y_max),
        objects=objects,
        obstacles=tuple(_outline(obstacle) for obstacle in world.obstacles),
        regions=tuple(_outline(region) for region in world.regions),
        map=_map(world.map[0]) if world.map else None,
        robots=tuple(
            Robot(
                robot.label,
                robot.wheelbase,
                robot.max_steering_angle,
                robot.radius,
                robot.speed,
                robot.model,
                _attitude(robot.start[0]) if robot.start else None,
                tuple((corner.x, corner.y) for corner in robot.footprint),
                robot.safety_margin,
                robot.turning_speed,
            )
            for robot in world.robots
        ),
    )


def _outline(shape: msg.Obstacle | msg.Region) -> Obstacle:
    return Obstacle(
        shape.name,
        tuple((corner.x, corner.y) for corner in shape.polygon),
        (shape.center.x, shape.center.y),
        shape.radius,
    )


def _map(grid: OccupancyGrid) -> Occupancy:
    origin, info = grid.info.origin, grid.info
    cells = np.frombuffer(array('b', grid.data), np.int8).reshape(info.height, info.width)
    return Occupancy(
        float(info.resolution),
        (origin.position.x, origin.position.y),
        cells != 0,
        2.0 * atan2(origin.orientation.z, origin.orientation.w),
    )


def step_from_message(step: msg.Step) -> Step:
    """One action with its answer, if it has one."""
    common = {
        'action': tuple(step.action),
        'cost': step.cost,
        'preconditions': step.preconditions,
        'state': _state(step.start),
    }
    if not step.answer:
        return Step(**common)
    answer = step.answer[0]
    end_state = _state(answer.end)
    motion = answer.motion
    return Step(
        **common,
        agent=answer.agent,
        objects=tuple(answer.objects),
        end=end_state.get(answer.agent),
        end_state=end_state,
        assigned=answer.assigned,
        motion_start=_attitude(motion.start) if motion.segments else None,
        segments=tuple(
            Segment(s.steering_angle, s.length, s.direction, s.turn) for s in motion.segments
        ),
        length=answer.length,
        duration=motion.duration,
        clearance=motion.clearance,
        residuals=tuple(Residual(r.constraint, r.violation, r.satisfied) for r in answer.residuals),
        alternative=answer.alternative,
    )


def diagnostic_from_message(remark: msg.Diagnostic) -> Diagnostic:
    """One remark about a text."""
    return Diagnostic(
        message=remark.message,
        source=remark.source,
        line=remark.line,
        column=remark.column,
        text=remark.text,
        warning=remark.severity == msg.Diagnostic.WARNING,
    )


def diagnostic_to_message(remark: Diagnostic) -> msg.Diagnostic:
    """The inverse of diagnostic_from_message."""
    return msg.Diagnostic(
        severity=msg.Diagnostic.WARNING if remark.warning else msg.Diagnostic.ERROR,
        source=remark.source,
        line=remark.line,
        column=remark.column,
        text=remark.text,
        message=remark.message,
    )


def _attitude(state: msg.AgentState) -> Attitude:
    return Attitude(state.x, state.y, state.heading)


def _state(states: Iterable[msg.AgentState]) -> dict[str, Attitude]:
    return {state.agent: _attitude(state) for state in states}
