"""Obstacles and regions of a world file: outlines with names, or files of them."""

from __future__ import annotations

from collections.abc import Container
from dataclasses import replace

from motion_planner_node.world.geojson import read_geojson
from motion_planner_node.world.map_reader import MAP_NAME
from motion_planner_node.world.model import Circle, Obstacle, Polygon, Region
from motion_planner_node.world.outlines import read_circle, read_polygon
from motion_planner_node.world.scene import MAP_EDGE
from motion_planner_node.world.syntax import Mapping, Node, Place, Sequence
from motion_planner_node.world.values import (
    Faults,
    check_count,
    check_label,
    kind_of,
    read_fields,
    read_text,
)

MOST_OBSTACLES = 10_000
MOST_REGIONS = 1_000
_KINDS = ('polygon', 'circle', 'geojson')


def read_obstacles(node: Node, directory: str, faults: Faults) -> tuple[Obstacle, ...]:
    """The obstacles of a list and of the files, from ``directory`` on, that it names.

    What is wrong with one goes to ``faults``.
    """
    if not isinstance(node, Sequence):
        faults.add(f'obstacles has to be a list, not {kind_of(node)}', node.place)
        return ()
    if not check_count(node, 'obstacles', MOST_OBSTACLES, faults):
        return ()
    lines: dict[str, int] = {MAP_EDGE: 0, MAP_NAME: 0}
    entries: list[tuple[str | None, dict[str, Node]]] = []
    for number, item in enumerate(node.items, 1):
        what = f'obstacle {number}'
        fields = _fields(item, what, (), faults)
        entries.append((_name(fields, what, lines, faults), fields))
    obstacles: list[Obstacle] = []
    numbers: dict[str, int] = {}
    for number, (given, fields) in enumerate(entries, 1):
        name = given or f'obstacle{number}'
        while given is None and name in lines:
            name += '_'
        if 'geojson' in fields:
            for label, polygon in read_geojson(fields['geojson'], directory, faults):
                own = unused_name(label or name, lines, numbers)
                lines[own] = node.place.line
                obstacles.append(replace(polygon, name=own))
        elif outline := _outline(fields, name, faults):
            obstacles.append(outline)
    if len(obstacles) > MOST_OBSTACLES:
        message = f'{len(obstacles)} obstacles are more than the {MOST_OBSTACLES} allowed'
        faults.add(message, node.place)
    return tuple(obstacles)


def read_regions(
    node: Node, directory: str, taken: Container[str], faults: Faults
) -> dict[str, Region]:
    """The regions of a list, and of the files that it names, by name.

    A name is a label that is not ``taken`` by anything else.
    """
    regions: dict[str, Region] = {}
    if not isinstance(node, Sequence):
        faults.add(f'regions has to be a list, not {kind_of(node)}', node.place)
        return regions
    if not check_count(node, 'regions', MOST_REGIONS, faults):
        return regions

    def add(name: str, outline: Region | None, place: Place) -> None:
        check_label(name, place, 'a region', faults)
        if name in regions or name in taken:
            other = 'another region' if name in regions else 'an object or a robot'
            faults.add(f'{name} is the name of {other}, too', place, name)
        if outline is not None:
            regions[name] = outline

    for number, item in enumerate(node.items, 1):
        what = f'region {number}'
        needed = ('name',) if isinstance(item, Mapping) and not _names_file(item) else ()
        fields = _fields(item, what, needed, faults)
        if 'geojson' in fields:
            place = fields['geojson'].place
            for label, polygon in read_geojson(fields['geojson'], directory, faults):
                if label is None:
                    faults.add(f'{what}: {polygon.name} has no property name', place)
                else:
                    add(label, replace(polygon, name=label), place)
        elif 'name' in fields:
            name = read_text(fields['name'], f'the name of {what}', faults)
            if name is not None and ('polygon' in fields) != ('circle' in fields):
                add(name, _outline(fields, name, faults), fields['name'].place)
    if len(regions) > MOST_REGIONS:
        message = f'{len(regions)} regions are more than the {MOST_REGIONS} allowed'
        faults.add(message, node.place)
    return regions


def _names_file(item: Mapping) -> bool:
    return any(key.text == 'geojson' for key, _ in item.entries)


def _fields(item: Node, what: str, needed: tuple[str, ...], faults: Faults) -> dict[str, Node]:
    """The keys of one entry, which is of one kind."""
    fields = read_fields(item, what, needed, ('name', *_KINDS), faults)
    given = [kind for kind in _KINDS if kind in fields]
    if isinstance(item, Mapping) and len(given) != 1:
        faults.add(f'{what} needs either polygon or circle, or geojson', item.place)
    elif given == ['geojson'] and 'name' in fields:
        message = f'{what}: the names of a geojson file are in its features'
        faults.add(message, fields['name'].place)
    return fields


def _outline(fields: dict[str, Node], name: str, faults: Faults) -> Polygon | Circle | None:
    if 'polygon' in fields:
        return read_polygon(fields['polygon'], name, faults)
    return read_circle(fields['circle'], name, faults) if 'circle' in fields else None


def unused_name(name: str, lines: Container[str], numbers: dict[str, int]) -> str:
    """``name``, or with the first number behind it that makes it a new one.

    ``numbers`` says which was the last one behind a name, so that none is tried twice.
    """
    result = name
    while result in lines:
        numbers[name] = numbers.get(name, 1) + 1
        result = f'{name}_{numbers[name]}'
    return result


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
