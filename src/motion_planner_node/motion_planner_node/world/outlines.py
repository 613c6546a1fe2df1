"""Single outlines, polygons and circles, out of a tree of values."""

from __future__ import annotations

import numpy as np

from motion_planner_node.world.model import Circle, Polygon
from motion_planner_node.world.simple_polygon import SMALLEST_AREA, area, crossing_edges
from motion_planner_node.world.syntax import Node, Sequence
from motion_planner_node.world.values import (
    SMALLEST_LENGTH,
    Faults,
    check_count,
    kind_of,
    read_at_least,
    read_fields,
    read_numbers,
)

MOST_CORNERS = 1_000


def read_polygon(node: Node, name: str, faults: Faults, most: int = MOST_CORNERS) -> Polygon | None:
    """A simple polygon of up to ``most`` corners; what is wrong with it goes to ``faults``."""
    if not isinstance(node, Sequence):
        message = f'{name}: polygon has to be a list of [x, y], not {kind_of(node)}'
        faults.add(message, node.place)
        return None
    if not check_count(node, f'corners of {name}', most, faults):
        return None
    corners: list[tuple[float, float]] = []
    for number, item in enumerate(node.items, 1):
        pair = read_numbers(item, f'{name}: corner {number}', ('x', 'y'), faults)
        if pair:
            corners.append((pair[0], pair[1]))
    if len(corners) < len(node.items):
        return None
    if len(corners) > 3 and corners[0] == corners[-1]:
        corners.pop()
    if len(corners) < 3:
        faults.add(f'{name}: a polygon needs 3 corners, this has {len(corners)}', node.place)
        return None
    for number in range(1, len(corners)):
        if corners[number] == corners[number - 1]:
            message = f'{name}: corner {number + 1} repeats the one before it'
            faults.add(message, node.items[number].place)
            return None
    array = np.array(corners)
    if abs(area(array)) < SMALLEST_AREA:
        faults.add(f'{name}: the polygon encloses no area', node.place)
        return None
    crossing = crossing_edges(array)
    if crossing:
        first, second = (edge + 1 for edge in crossing)
        message = (
            f'{name}: the polygon crosses or touches itself, '
            f'at the edges that begin at corners {first} and {second}'
        )
        faults.add(message, node.place)
        return None
    return Polygon(name, tuple(corners))


def read_circle(node: Node, name: str, faults: Faults) -> Circle | None:
    """A circle of a centre and a radius; what is wrong with it goes to ``faults``."""
    fields = read_fields(node, f'the circle of {name}', ('center', 'radius'), (), faults)
    if len(fields) < 2:
        return None
    center = read_numbers(fields['center'], f'{name}: center', ('x', 'y'), faults)
    radius = read_at_least(fields['radius'], f'{name}: radius', SMALLEST_LENGTH, faults)
    if not center or radius is None:
        return None
    return Circle(name, (center[0], center[1]), radius)
