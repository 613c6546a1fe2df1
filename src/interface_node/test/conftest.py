"""A small mission that the tests of the interface share."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pytest

from interface_node.driving import drive
from interface_node.plan import (
    Attitude,
    Obstacle,
    Plan,
    Residual,
    Robot,
    Segment,
    Step,
    World,
)

WORLD = World(
    source='world.yaml',
    revision='r1',
    bounds=(0.0, 0.0, 80.0, 60.0),
    objects={'base': (10.0, 10.0), 'tree': (40.0, 40.0), 'gate': (70.0, 15.0)},
    obstacles=(
        Obstacle('wall', ((30.0, 0.0), (33.0, 0.0), (33.0, 10.0), (30.0, 10.0))),
        Obstacle('pillar', (), (60.0, 45.0), 4.0),
    ),
    robots=(Robot('scout', 1.0, 0.3, 1.0, 1.0), Robot('rover0', 2.0, 0.5, 1.0, 2.0)),
)


def photo(place: str, start: Attitude, *segments: Segment) -> Step:
    """A photo of ``place`` after driving the segments."""
    end = drive(start, segments, 2.0)
    return Step(
        action=('!take_photo', 'rover0', place, 'cam_0'),
        cost=1.0,
        preconditions=f'((agent rover0)(object {place})(distance(rover0, {place}) <= 20))',
        state={'rover0': start},
        agent='rover0',
        objects=(place,),
        end=end,
        end_state={'rover0': end},
        motion_start=start,
        segments=segments,
        length=sum(segment.length for segment in segments),
        duration=7.5,
        clearance=2.5,
        residuals=(Residual(f'distance(rover0, {place}) <= 20', 0.0, satisfied=True),),
    )


@pytest.fixture
def sample_plan() -> Plan:
    """Put in place, photograph the tree, charge (purely symbolic), photograph the gate."""
    start = Attitude(10.0, 10.0, 0.0)
    placed = Step(
        action=('!init_rover_attitude', 'rover0', 'base'),
        preconditions='((agent rover0)(object base)(setProperty(rover0.x, base.x)))',
        agent='rover0',
        objects=('base',),
        end=start,
        end_state={'rover0': start},
        assigned=True,
    )
    tree = photo('tree', start, Segment(0.0, 5.0), Segment(0.5, 4.0), Segment(0.0, 20.0))
    assert tree.end is not None
    charged = Step(action=('!charge', 'rover0'), cost=2.0, state={'rover0': tree.end})
    gate = photo('gate', tree.end, Segment(-0.5, 7.0), Segment(0.0, 1.0 / 3.0))
    return Plan(
        mission='small',
        outcome='SOLVED',
        world_path='missions/world.yaml',
        world=WORLD,
        steps=(placed, tree, charged, gate),
        seed=7,
        planning_time=0.25,
        statistics={'requests': 3, 'answers': 3, 'advices': 0, 'backtracks': 0},
    )


@pytest.fixture
def sample_steps(sample_plan: Plan) -> list[Any]:
    """The steps of the small mission as messages (geohtn_msgs/Step)."""
    from geohtn_msgs import msg

    def states(of: Mapping[str, Attitude]) -> list[Any]:
        return [msg.AgentState(agent=k, x=a.x, y=a.y, heading=a.heading) for k, a in of.items()]

    def answer(step: Step) -> Any:
        motion = msg.Motion(
            agent=step.agent,
            length=step.length,
            duration=step.duration,
            clearance=step.clearance,
        )
        if step.motion_start:
            (motion.start,) = states({step.agent: step.motion_start})
        motion.segments = [
            msg.Segment(steering_angle=s.steering_angle, length=s.length) for s in step.segments
        ]
        return msg.GeometricAnswer(
            agent=step.agent,
            objects=list(step.objects),
            end=states(step.end_state),
            assigned=step.assigned,
            motion=motion,
            length=step.length,
            residuals=[
                msg.ConstraintResidual(constraint=r.constraint, satisfied=r.satisfied)
                for r in step.residuals
            ],
        )

    return [
        msg.Step(
            action=list(step.action),
            cost=step.cost,
            preconditions=step.preconditions,
            start=states(step.state),
            answer=[answer(step)] if step.agent else [],
        )
        for step in sample_plan.steps
    ]
