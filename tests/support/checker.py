"""An independent judge of plans: shapely and the textbook, none of the planner's own geometry.

It reads ``plan.json`` and the world file as a stranger's program would, drives every segment by the
car's equations of motion, and says in sentences what is wrong.
"""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml
from shapely import LineString, Point, Polygon, box
from shapely.geometry.base import BaseGeometry

#: [m], [rad] allowed between two numbers that should be equal.
TOLERANCE = 1e-6
#: [m] between two samples of a driven arc.
SPACING = 0.05

Pose = tuple[float, float, float]


class Judge:
    """Checks a plan against the world that it was made for."""

    def __init__(self, plan_file: Path, world_file: Path):
        self.plan: dict[str, Any] = json.loads(plan_file.read_text(encoding='utf-8'))
        world = yaml.safe_load(world_file.read_text(encoding='utf-8'))
        self.objects: dict[str, dict[str, float]] = world['objects']
        self.bounds: BaseGeometry = box(*world['bounds'])
        self.obstacles = {entry['name']: _shape(entry) for entry in world['obstacles']}
        self.car: dict[str, float] = next(iter(world['robots'].values()))
        self.turning_radius = self.car['wheelbase'] / math.tan(self.car['max_steering_angle'])

    def complaints(self) -> list[str]:
        """Everything that is wrong with the plan, one sentence each."""
        return [*self._robot(), *self._continuity(), *self._motions(), *self._photos()]

    def _robot(self) -> Iterator[str]:
        for name in ('wheelbase', 'max_steering_angle', 'radius'):
            if self.plan['robot'][name] != self.car[name]:
                yield f'robot: {name} is {self.plan["robot"][name]}, not {self.car[name]}'

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
            length = sum(segment[1] for segment in step['segments'])
            if abs(length - step['length']) > TOLERANCE:
                yield f'{name}: {step["length"]} m, its segments {length} m'
            for steering, piece in step['segments']:
                if steering not in (
                    0.0,
                    self.car['max_steering_angle'],
                    -self.car['max_steering_angle'],
                ):
                    yield f'{name}: steering angle {steering} is no command of the car'
                if not piece > 0:
                    yield f'{name}: a segment of {piece} m'
            if not step['segments']:
                yield from self._collisions(name, [pose(step['end'])])
                continue
            driven = list(self.drive(pose(step['start']), step['segments']))
            if gap(driven[-1], pose(step['end'])) > TOLERANCE:
                yield f'{name}: drives to {driven[-1]}, not to {step["end"]}'
            yield from self._collisions(name, driven)

    def _collisions(self, name: str, driven: list[Pose]) -> Iterator[str]:
        points = [(x, y) for x, y, _ in driven]
        track = LineString(points) if len(points) > 1 else Point(points[0])
        # A chord lies inside its arc by at most this much.
        sagitta = SPACING**2 / (8 * self.turning_radius)
        needed = self.car['radius'] - TOLERANCE - sagitta
        for label, obstacle in self.obstacles.items():
            if track.distance(obstacle) < needed:
                yield f'{name}: {track.distance(obstacle)} m from {label}'
        if not self.bounds.covers(track) or track.distance(self.bounds.exterior) < needed:
            yield f'{name}: leaves the map'

    def drive(self, start: Pose, segments: list[list[float]]) -> Iterator[Pose]:
        """Sample the car's motion: x' = cos h, y' = sin h, h' = tan(phi) / L per metre."""
        x, y, heading = start
        yield start
        for steering, length in segments:
            curvature = math.tan(steering) / self.car['wheelbase']
            pieces = max(1, math.ceil(length / SPACING))
            for k in range(1, pieces + 1):
                s = length * k / pieces
                turned = curvature * s
                # The chord of an arc: sinc keeps this exact for straight lines too.
                chord = s * (math.sin(turned / 2) / (turned / 2) if turned else 1.0)
                along = heading + turned / 2
                yield (x + chord * math.cos(along), y + chord * math.sin(along), heading + turned)
            chord = length * (
                math.sin(curvature * length / 2) / (curvature * length / 2) if curvature else 1.0
            )
            x += chord * math.cos(heading + curvature * length / 2)
            y += chord * math.sin(heading + curvature * length / 2)
            heading += curvature * length

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


def gap(first: Pose, second: Pose) -> float:
    """The largest difference between two attitudes [m or rad], headings as directions."""
    turned = math.remainder(first[2] - second[2], math.tau)
    return max(abs(first[0] - second[0]), abs(first[1] - second[1]), abs(turned))


def _shape(entry: dict[str, Any]) -> BaseGeometry:
    if 'polygon' in entry:
        return Polygon(entry['polygon'])
    # A circle is judged by a polygon inside it: the checker must not refuse what is right.
    return Point(entry['circle']['center']).buffer(entry['circle']['radius'], quad_segs=512)
