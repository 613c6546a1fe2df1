"""An independent judge of plans: shapely and the textbook, none of the planner's own geometry.

It reads ``plan.json`` and the world file as a stranger's program would, drives every segment by the
robots' equations of motion, and says in sentences what is wrong.
"""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml
from shapely import box
from shapely.geometry.base import BaseGeometry

from tests.support.vehicle import TOLERANCE, Pose, Vehicle, gap, motion_faults, outline_of


class Judge:
    """Checks a plan against the world that it was made for."""

    def __init__(self, plan_file: Path, world_file: Path):
        self.plan: dict[str, Any] = json.loads(plan_file.read_text(encoding='utf-8'))
        world = yaml.safe_load(world_file.read_text(encoding='utf-8'))
        self.objects: dict[str, dict[str, float]] = world['objects']
        self.bounds: BaseGeometry = box(*world['bounds'])
        self.obstacles = {
            entry.get('name', f'obstacle{number}'): outline_of(entry)
            for number, entry in enumerate(world['obstacles'], 1)
        }
        self.robots: dict[str, dict[str, Any]] = world['robots']

    def complaints(self) -> list[str]:
        """Everything that is wrong with the plan, one sentence each."""
        return [*self._robots(), *self._continuity(), *self._motions(), *self._photos()]

    def _robots(self) -> Iterator[str]:
        described = {robot['label']: robot for robot in self.plan['robots']}
        for label, robot in self.robots.items():
            for name, value in robot.items():
                if name != 'start' and described[label][name] != value:
                    yield f'{label}: {name} is {described[label][name]}, not {value}'

    def _continuity(self) -> Iterator[str]:
        steps = self.plan['steps']
        for before, after in itertools.pairwise(steps):
            if gap(pose(before['end']), pose(after['start'])) > TOLERANCE:
                yield f'{after["action"]} starts elsewhere than {before["action"]} ends'
        total = sum(step['length'] for step in steps)
        if abs(total - self.plan['length']) > TOLERANCE:
            yield f'the plan is {self.plan["length"]} m long, its steps {total} m'

    def _motions(self) -> Iterator[str]:
        for step in self.plan['steps']:
            name = ' '.join(step['action'])
            length = sum(abs(segment[1]) for segment in step['segments'])
            if abs(length - step['length']) > TOLERANCE:
                yield f'{name}: {step["length"]} m, its segments {length} m'
            if not step['agent']:
                continue
            vehicle = Vehicle(self.robots[step['agent']])
            faults = motion_faults(
                vehicle,
                pose(step['start']),
                step['segments'],
                pose(step['end']),
                self.obstacles,
                self.bounds,
            )
            yield from (f'{name}: {fault}' for fault in faults)

    def _photos(self) -> Iterator[str]:
        """The constraints of Figure 3: 50 to 100 m away, the objective at a right angle."""
        for step in self.plan['steps']:
            if step['action'][0] != '!take_photo':
                continue
            name = ' '.join(step['action'])
            x, y, heading = pose(step['end'])
            objective = self.objects[step['action'][2]]
            east, north = objective['x'] - x, objective['y'] - y
            distance = math.hypot(east, north)
            if not 50 - TOLERANCE <= distance <= 100 + TOLERANCE:
                yield f'{name}: {distance} m away'
            angle = heading - math.atan2(north, east)
            if abs(math.cos(angle)) > TOLERANCE or abs(math.sin(angle) - 1) > TOLERANCE:
                yield f'{name}: the objective is seen under {math.degrees(angle)} degrees'


def pose(attitude: dict[str, float]) -> Pose:
    """The attitude as (x, y, heading)."""
    return (attitude['x'], attitude['y'], attitude['heading'])
