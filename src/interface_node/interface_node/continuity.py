"""Whether the steps of a plan fit together: nothing is shown that could not be driven."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot, isfinite, remainder, tau

from interface_node.driving import drive
from interface_node.plan import Attitude, Plan, Robot, Segment, Step

#: [m], [rad] that two attitudes which should be the same may differ by.
TOLERANCE = 1e-6


def faults(plan: Plan) -> Iterator[str]:
    """Say in sentences where a step begins elsewhere than the one before ended, and the like.

    Checked are: every step's state against the attitudes that the earlier steps left behind, the
    start of every motion against that state, the end of every motion, driven here, against the
    end that the motion planner gave, and the lengths.
    """
    state: dict[str, Attitude] = {
        robot.label: robot.start
        for robot in (plan.world.robots if plan.world else ())
        if robot.start
    }
    for number, step in enumerate(plan.steps, start=1):
        name = f'step {number}, ({" ".join(step.action)})'
        for agent, attitude in step.state.items():
            if agent in state and not same(attitude, state[agent]):
                yield f'{name}, starts with {agent} at {_words(attitude)}, not {_words(state[agent])}'
        state.update(step.state)
        yield from _motion_faults(name, step, plan)
        state.update(step.end_state)


def same(first: Attitude, second: Attitude) -> bool:
    """Whether two attitudes are equal within TOLERANCE, headings as directions."""
    turned = first.heading - second.heading
    return (
        isfinite(turned)
        and hypot(first.x - second.x, first.y - second.y) <= TOLERANCE
        and abs(remainder(turned, tau)) <= TOLERANCE
    )


def _motion_faults(name: str, step: Step, plan: Plan) -> Iterator[str]:
    if not step.agent:
        return
    robot = plan.world.robot(step.agent) if plan.world else None
    if robot is None:
        yield f'{name}, moves {step.agent}, a robot that the world does not have'
        return
    if step.end is None:
        yield f'{name}, says nothing of where {step.agent} ends'
        return
    if step.assigned:
        return
    before = step.state.get(step.agent, robot.start)
    if before is None:
        yield f'{name}, drives {step.agent}, which stands nowhere yet'
        return
    if not all(_can_be_driven(robot, segment) for segment in step.segments):
        yield f'{name}, has a motion that {step.agent} cannot drive'
        return
    start = step.motion_start or before
    if not same(start, before):
        yield f'{name}, drives from {_words(start)}, but {step.agent} is at {_words(before)}'
    end = drive(start, step.segments, robot.wheelbase)
    if not same(end, step.end):
        yield f'{name}, drives to {_words(end)}, not to {_words(step.end)}'
    length = sum(abs(segment.length) for segment in step.segments)
    if not abs(length - step.length) <= TOLERANCE:
        yield f'{name}, is said to be {step.length:g} m long, its segments {length:g} m'


def _can_be_driven(robot: Robot, segment: Segment) -> bool:
    numbers = (segment.steering_angle, segment.length, segment.direction, segment.turn)
    return all(isfinite(number) for number in numbers) and (
        robot.wheelbase > 0 or not segment.steering_angle
    )


def _words(attitude: Attitude) -> str:
    return f'({attitude.x:.6f}, {attitude.y:.6f}, {attitude.heading:.6f})'
