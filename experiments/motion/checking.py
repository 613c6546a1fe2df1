"""Judge answers: the end by the constraints' own judge, the motion by shapely and integration."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

import numpy as np
import shapely
from tests.support.vehicle import TOLERANCE, Pose, Vehicle, gap

from experiments.constraints.judge import Judge
from experiments.constraints.sets import ConstraintSet
from experiments.motion.goals import AGENT
from experiments.motion.grounds import inside_obstacles, map_edges
from experiments.motion.worlds import Place
from motion_planner_node.robots.motion import Attitude, Motion

_PART = re.compile(r'\(((?:[^()]|\([^()]*\))*)\)')


def constraints_of(text: str) -> tuple[str, ...]:
    """The constraints in a text of the requests, without its statements."""
    parts = _PART.findall(text[1:-1])
    return tuple(part for part in parts if not part.startswith(('agent ', 'object ')))


class Checker:
    """Checks motions in one world; it shares no geometry with the motion planner."""

    def __init__(self, place: Place) -> None:
        self._place = place
        self._vehicle = Vehicle(place.robot)
        self._judge = Judge({'regions': [], 'obstacles': [], **place.document}, AGENT)
        outlines = []
        for obstacle in place.document.get('obstacles', ()):
            if 'polygon' in obstacle:
                outlines.append(shapely.Polygon(obstacle['polygon']).exterior)
            else:
                # A polygon inside the circle: what is right must not be refused.
                circle = obstacle['circle']
                disc = shapely.Point(circle['center']).buffer(circle['radius'], quad_segs=512)
                outlines.append(disc.exterior)
        outlines.append(shapely.box(*place.bounds).exterior)
        if place.occupied is not None:
            outlines += list(shapely.linestrings(map_edges(place).reshape(-1, 2, 2)))
        self._boundaries = shapely.STRtree(outlines)

    def missed(self, text: str, pose: Pose) -> float:
        """By how much an attitude misses the constraints in a text [m or rad]."""
        constraints = ConstraintSet('', constraints_of(text), feasible=True, agents=(), objects=())
        return self._judge.violation(constraints, pose)

    def faults(self, text: str, start: Pose, motion: Motion, end: Attitude) -> Iterator[str]:
        """Everything that is wrong with the answer to a request, in sentences."""
        pose = (end.x, end.y, end.heading)
        missed = self.missed(text, pose)
        if not missed <= TOLERANCE:
            yield f'the end {pose} misses the constraints by {missed}'
        segments = [[s.steering_angle, s.length, s.direction, s.turn] for s in motion.segments]
        yield from self._vehicle.wrong_commands(segments)
        driven = self._vehicle.drive(start, segments)
        last = (float(driven[-1, 0]), float(driven[-1, 1]), float(driven[-1, 2]))
        if not gap(last, pose) <= TOLERANCE:
            yield f'drives to {last}, not to {pose}'
        needed = self._vehicle.radius - TOLERANCE
        _, distances = self._boundaries.query_nearest(
            shapely.points(driven[:, :2]), max_distance=needed, return_distance=True
        )
        nearest = float(np.min(distances, initial=math.inf))
        if nearest < needed:
            yield f'{nearest} m from an obstacle or the edge, not {self._vehicle.radius}'
        if inside_obstacles(self._place, driven[[0, -1], :2]).any():
            yield 'starts or ends inside an obstacle'
