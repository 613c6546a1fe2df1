"""Outlines in a world file: polygons and circles, each with a name of its own."""

from __future__ import annotations

from collections.abc import Container

import numpy as np

from motion_planner_node.world.model import Circle, Obstacle, Polygon, Region
from motion_planner_node.world.scene import MAP_EDGE
from motion_planner_node.world.simple_polygon import SMALLEST_AREA, area, crossing_edges
from motion_planner_node.world.syntax import Mapping, Node, Sequence
from motion_planner_node.world.values import (
    SMALLEST_LENGTH,
    Faults,
    check_count,
    check_label,
    kind_of,
    read_at_least,
    read_fields,
    read_numbers,
    read_text,
)

MOST_OBSTACLES = 10_000
MOST_REGIONS = 1_000
MOST_CORNERS = 1_000


def read_obstacles(node: Node, faults: Faults) -> tuple[Obstacle, ...]:
    """The obstacles of a list; what is wrong with one goes to ``faults``."""
    if not isinstance(node, Sequence):
        faults.add(f'obstacles has to be a list, not {kind_of(node)}', node.place)
        return ()
    if not check_count(node, 'obstacles', MOST_OBSTACLES, faults):
        return ()
    lines: dict[str, int] = {MAP_EDGE: 0}
    entries: list[tuple[str | None, dict[str, Node]]] = []
    for number, item in enumerate(node.items, 1):
        what = f'obstacle {number}'
        fields = read_fields(item, what, (), ('name', 'polygon', 'circle'), faults)
        if isinstance(item, Mapping) and ('polygon' in fields) == ('circle' in fields):
            faults.add(f'{what} needs either polygon or circle', item.place)
        entries.append((_name(fields, what, lines, faults), fields))
    obstacles: list[Obstacle | None] = []
    for number, (given, fields) in enumerate(entries, 1):
        name = given or f'obstacle{number}'
        while given is None and name in lines:
            name += '_'
        if 'polygon' in fields:
            obstacles.append(read_polygon(fields['polygon'], name, faults))
        elif 'circle' in fields:
            obstacles.append(_circle(fields['circle'], name, faults))
    return tuple(obstacle for obstacle in obstacles if obstacle is not None)


def read_regions(node: Node, taken: Container[str], faults: Faults) -> dict[str, Region]:
    """The regions of a list by name, which is a label that is not ``taken`` by anything else."""
    regions: dict[str, Region] = {}
    if not isinstance(node, Sequence):
        faults.add(f'regions has to be a list, not {kind_of(node)}', node.place)
        return regions
    if not check_count(node, 'regions', MOST_REGIONS, faults):
        return regions
    for number, item in enumerate(node.items, 1):
        what = f'region {number}'
        fields = read_fields(item, what, ('name',), ('polygon', 'circle'), faults)
        if isinstance(item, Mapping) and ('polygon' in fields) == ('circle' in fields):
            faults.add(f'{what} needs either polygon or circle', item.place)
            continue
        name = (
            read_text(fields['name'], f'the name of {what}', faults) if 'name' in fields else None
        )
        if name is None:
            continue
        place = fields['name'].place
        check_label(name, place, 'a region', faults)
        if name in regions or name in taken:
            other = 'another region' if name in regions else 'an object or a robot'
            faults.add(f'{name} is the name of {other}, too', place, name)
        if 'polygon' in fields:
            region: Region | None = read_polygon(fields['polygon'], name, faults)
        else:
            region = _circle(fields['circle'], name, faults)
        if region is not None:
            regions[name] = region
    return regions


def _name(fields: dict[str, Node], what: str, lines: dict[str, int], faults: Faults) -> str | None:
    """The name that is given, not used before; ``lines`` says where the names stand."""
    if 'name' not in fields:
        return None
    place = fields['name'].place
    name = read_text(fields['name'], f'the name of {what}', faults)
    if name is None:
        return None
    if name in lines:
        holder = f'the obstacle in line {lines[name]}' if lines[name] else 'the map itself'
        faults.add(f'{what}: the name {name} is taken by {holder}', place, name)
        return None
    lines[name] = place.line
    return name


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


def _circle(node: Node, name: str, faults: Faults) -> Circle | None:
    fields = read_fields(node, f'the circle of {name}', ('center', 'radius'), (), faults)
    if len(fields) < 2:
        return None
    center = read_numbers(fields['center'], f'{name}: center', ('x', 'y'), faults)
    radius = read_at_least(fields['radius'], f'{name}: radius', SMALLEST_LENGTH, faults)
    if not center or radius is None:
        return None
    return Circle(name, (center[0], center[1]), radius)
