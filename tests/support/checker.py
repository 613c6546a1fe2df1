"""An independent judge of plans: shapely and the textbook, none of the planner's own geometry.

It reads ``plan.json`` and the world file as a stranger's program would, drives every segment by the
robots' equations of motion, and says in sentences what is wrong.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import yaml
from shapely import box, unary_union
from shapely.geometry.base import BaseGeometry

from tests.support.occupancy import occupied_boxes
from tests.support.preconditions import Preconditions
from tests.support.vehicle import TOLERANCE, Pose, Vehicle, gap, motion_faults, outline_of


class Judge:
    """Checks a plan against the world and the domain, beside it, that it was made for."""

    def __init__(self, plan_file: Path, world_file: Path, domain_file: Path | None = None):
        self.plan: dict[str, Any] = json.loads(plan_file.read_text(encoding='utf-8'))
        world = yaml.safe_load(world_file.read_text(encoding='utf-8'))
        self.obstacles = {
            entry.get('name', f'obstacle{number}'): outline_of(entry)
            for number, entry in enumerate(world.get('obstacles', ()), 1)
        }
        hiding = list(self.obstacles.values())
        self.bounds: BaseGeometry
        if 'map' in world:
            self.bounds, cells = occupied_boxes(world_file.parent / world['map'])
            self.obstacles['the occupancy map'] = unary_union(cells)
            hiding += cells
        if 'bounds' in world:
            self.bounds = box(*world['bounds'])
        self.objects: dict[str, dict[str, float]] = world['objects']
        self.robots: dict[str, dict[str, Any]] = world['robots']
        surroundings = {
            'bounds': self.bounds.bounds,
            'objects': self.objects,
            'regions': world.get('regions', ()),
            'obstacles': [hiding_outline(part) for part in hiding],
        }
        domain = (domain_file or world_file.with_name('domain.lisp')).read_text(encoding='utf-8')
        self.asked = Preconditions(domain, surroundings)

    def complaints(self) -> list[str]:
        """Everything that is wrong with the plan, one sentence each."""
        return [*self._robots(), *self._continuity(), *self._motions(), *self._preconditions()]

    def _robots(self) -> Iterator[str]:
        described = {robot['label']: robot for robot in self.plan['robots']}
        for label, robot in self.robots.items():
            for name, value in robot.items():
                if name != 'start' and described[label][name] != value:
                    yield f'{label}: {name} is {described[label][name]}, not {value}'

    def _continuity(self) -> Iterator[str]:
        steps = self.plan['steps']
        ends = self._starts()
        for step in steps:
            before = ends.get(step['agent'])
            if before and not step['assigned'] and gap(before, pose(step['start'])) > TOLERANCE:
                yield f'{step["action"]} starts elsewhere than {step["agent"]} was'
            if step['agent']:
                ends[step['agent']] = pose(step['end'])
        total = sum(step['length'] for step in steps)
        if abs(total - self.plan['length']) > TOLERANCE:
            yield f'the plan is {self.plan["length"]} m long, its steps {total} m'

    def _motions(self) -> Iterator[str]:
        attitudes = self._starts()
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
                self.obstacles | self._standing(attitudes, step['agent']),
                self.bounds,
            )
            yield from (f'{name}: {fault}' for fault in faults)
            attitudes[step['agent']] = pose(step['end'])

    def _standing(self, attitudes: Mapping[str, Pose], driver: str) -> dict[str, BaseGeometry]:
        """The robots that stand while another one drives."""
        return {
            label: Vehicle(self.robots[label]).outline(attitude)
            for label, attitude in attitudes.items()
            if label != driver
        }

    def _preconditions(self) -> Iterator[str]:
        """What the domain asks of attitudes, where every robot stands after each action."""
        attitudes = self._starts()
        for step in self.plan['steps']:
            if not step['agent']:
                continue
            attitudes[step['agent']] = pose(step['end'])
            name = ' '.join(step['action'])
            for fault in self.asked.faults(step['action'], step['agent'], attitudes):
                yield f'{name}: {fault}'

    def _starts(self) -> dict[str, Pose]:
        return {
            label: pose(robot['start']) for label, robot in self.robots.items() if 'start' in robot
        }


def hiding_outline(shape: BaseGeometry) -> dict[str, Any]:
    """An obstacle as it hides things: touching it is no obstruction."""
    return {'polygon': list(shape.buffer(-TOLERANCE, join_style='mitre').exterior.coords)}


def pose(attitude: dict[str, float]) -> Pose:
    """The attitude as (x, y, heading)."""
    return (attitude['x'], attitude['y'], attitude['heading'])
