"""Polygons with holes: whether the holes are where holes can be, and one chain round it all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from motion_planner_node.world.model import Polygon
from motion_planner_node.world.outlines import MOST_CORNERS
from motion_planner_node.world.simple_polygon import area, encloses, meeting
from motion_planner_node.world.syntax import Place
from motion_planner_node.world.values import Faults


def with_holes(
    outline: Polygon, holes: Sequence[Polygon], places: Sequence[Place], faults: Faults
) -> Polygon | None:
    """``outline`` with ``holes``; what is wrong with these, at their ``places``, goes to ``faults``.

    Each has to be inside of the outline, outside of the others, and touch none of them.
    """
    if not holes:
        return outline
    count = sum(len(polygon.corners) for polygon in (outline, *holes))
    if count > MOST_CORNERS:
        message = f'{outline.name} has {count} corners with its holes: at most {MOST_CORNERS}'
        faults.add(message, places[0])
        return None
    names = [outline.name, *(hole.name for hole in holes)]
    rings = [np.array(polygon.corners) for polygon in (outline, *holes)]
    meet = meeting(rings)
    firsts = np.array([ring[0] for ring in rings])
    inside = np.array([encloses(ring, firsts) for ring in rings])
    is_wrong = False
    for k, place in enumerate(places, 1):
        touched = np.flatnonzero(meet[:, k])
        nested = np.flatnonzero(inside[1:, k] & (np.arange(1, len(rings)) != k)) + 1
        message = ''
        if len(touched):
            message = f'{names[k]}: the hole crosses or touches {names[touched[0]]}'
        elif not inside[0, k]:
            message = f'{names[k]}: the hole is outside of {names[0]}'
        elif len(nested):
            message = f'{names[k]}: the hole is inside {names[nested[0]]}, another one'
        if message:
            faults.add(message, place)
            is_wrong = True
    return None if is_wrong else replace(outline, holes=tuple(hole.corners for hole in holes))


def chain(polygon: Polygon) -> tuple[tuple[float, float], ...]:
    """One closed chain of corners [m] that goes to each hole and comes back on the same line.

    It encloses what the polygon does, by parity of crossings as by winding number: holes are passed
    in the other direction than the outline.
    """
    corners = list(polygon.corners)
    is_left = area(np.array(corners)) > 0.0
    for hole in polygon.holes:
        is_same = (area(np.array(hole)) > 0.0) == is_left
        ring = list(reversed(hole)) if is_same else list(hole)
        away = np.array(corners)[:, None] - np.array(ring)
        at, first = divmod(int(np.argmin((away**2).sum(axis=-1))), len(ring))
        corners[at + 1 : at + 1] = [*ring[first:], *ring[: first + 1], corners[at]]
    return tuple(corners)
