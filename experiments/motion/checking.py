"""Judge answers: the end by the constraints' own judge, the motion by shapely and integration."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import shapely

from experiments.constraints.judge import Judge
from experiments.constraints.sets import ConstraintSet
from experiments.motion.goals import AGENT, Array
from experiments.motion.grounds import inside_obstacles, map_edges
from experiments.motion.worlds import Place
from motion_planner_node.requests import GeometricAnswer
from motion_planner_node.robots.motion import Attitude, Motion
from tests.support.vehicle import SPACING, TOLERANCE, Pose, Vehicle, gap

_PART = re.compile(r'\(((?:[^()]|\([^()]*\))*)\)')


def constraints_of(text: str) -> tuple[str, ...]:
    """The constraints in a text of the requests, without its statements."""
    parts = _PART.findall(text[1:-1])
    return tuple(part for part in parts if not part.startswith(('agent ', 'object ')))


class Told(NamedTuple):
    """What an answer says of its motion: length [m], duration [s] and clearance [m]."""

    length: float
    duration: float
    clearance: float

    @classmethod
    def by(cls, answer: GeometricAnswer) -> Told:
        """The figures of an answer."""
        return cls(answer.length, answer.duration, answer.clearance)


class Checker:
    """Checks motions in one world; it shares no geometry with the motion planner."""

    def __init__(self, place: Place) -> None:
        self._place = place
        self._vehicle = Vehicle(place.robot)
        self._judge = Judge({'regions': [], 'obstacles': [], **place.document}, AGENT)
        x_min, y_min, x_max, y_max = place.bounds
        corners = [[x_min, y_min], [x_max, y_min], [x_max, y_max], [x_min, y_max]]
        outlines = [_sides(corners)]
        discs = []
        for obstacle in place.document.get('obstacles', ()):
            if 'polygon' in obstacle:
                outlines.append(_sides(obstacle['polygon']))
            else:
                discs.append((*obstacle['circle']['center'], obstacle['circle']['radius']))
        if place.occupied is not None:
            outlines.append(map_edges(place).reshape(-1, 2, 2))
        # Side by side: a tree of short lines finds the nearest soonest.
        self._boundaries = shapely.STRtree(shapely.linestrings(np.concatenate(outlines)))
        self._discs = np.array(discs, np.float64).reshape(-1, 3)

    def missed(self, text: str, pose: Pose) -> float:
        """By how much an attitude misses the constraints in a text [m or rad]."""
        constraints = ConstraintSet('', constraints_of(text), feasible=True, agents=(), objects=())
        return self._judge.violation(constraints, pose)

    def faults(
        self, text: str, start: Pose, motion: Motion, end: Attitude, told: Told | None = None
    ) -> Iterator[str]:
        """Everything that is wrong with the answer to a request, in sentences."""
        first, pose = _pose(motion.start), _pose(end)
        if not gap(first, start) <= TOLERANCE:
            yield f'starts at {first}, not at {start}'
        missed = self.missed(text, pose)
        if not missed <= TOLERANCE:
            yield f'the end {pose} misses the constraints by {missed}'
        segments = [[s.steering_angle, s.length, s.direction, s.turn] for s in motion.segments]
        yield from self._vehicle.wrong_commands(segments)
        driven = self._vehicle.drive(start, segments)
        last = _pose(Attitude(*driven[-1].tolist()))
        if not gap(last, pose) <= TOLERANCE:
            yield f'drives to {last}, not to {pose}'
        radius = self._vehicle.radius
        needed = reach = radius - TOLERANCE
        if told and math.isfinite(told.clearance):
            reach = max(needed, told.clearance + radius + SPACING)
        nearest = self._clearance(driven[:, :2], reach)
        if nearest < needed:
            yield f'{nearest} m from an obstacle or the edge, not {radius}'
        if inside_obstacles(self._place, driven[[0, -1], :2]).any():
            yield 'starts or ends inside an obstacle'
        if told:
            yield from self._wrong_figures(told, driven, nearest - radius)

    def _wrong_figures(self, told: Told, driven: Array, clearance: float) -> Iterator[str]:
        """Figures that are not those of attitudes ``driven`` (n, 3), whose least is ``clearance``."""
        length = float(np.hypot(*np.diff(driven[:, :2], axis=0).T).sum())
        # Chords are shorter than arcs, and the nearest place is between two samples.
        slack = TOLERANCE + length * (SPACING / self._place.turning_radius) ** 2 / 20.0
        if not -TOLERANCE <= told.length - length <= slack:
            yield f'is told to be {told.length} m long, not {length}'
        if not -TOLERANCE <= told.duration * self._place.robot['speed'] - length <= slack:
            yield f'is told to take {told.duration} s for {length} m'
        if not -TOLERANCE <= clearance - told.clearance <= 0.5 * SPACING + TOLERANCE:
            yield f'is told to have {told.clearance} m of room, not {clearance}'

    def _clearance(self, points: Array, reach: float) -> float:
        """Distance [m] of the nearest of ``points`` (n, 2) to an obstacle, where it is below ``reach``."""
        _, distances = self._boundaries.query_nearest(
            shapely.points(points), max_distance=reach, return_distance=True
        )
        nearest = float(np.min(distances, initial=math.inf))
        for x, y, radius in self._discs:
            away = np.hypot(points[:, 0] - x, points[:, 1] - y)
            nearest = min(nearest, float(away.min()) - radius)
        return nearest


def _pose(attitude: Attitude) -> Pose:
    return attitude.x, attitude.y, attitude.heading


def _sides(corners: Sequence[Sequence[float]]) -> Array:
    """The sides (n, 2, 2) of a polygon."""
    rows = np.array(corners, np.float64)
    return np.stack([rows, np.roll(rows, -1, axis=0)], axis=1)
