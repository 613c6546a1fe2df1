"""The schema for editors says what the reader does, and the documentation names every key."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest
import yaml

from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.robots.registry import MODELS
from motion_planner_node.world import read_world

TOP = Path(__file__).parents[3]
MISSIONS = TOP / 'src' / 'interface_node' / 'missions'
SCHEMA: dict[str, Any] = json.loads((MISSIONS / 'world.schema.json').read_text())
ROVER = (MISSIONS / 'rover' / 'world.yaml').read_text()

TYPES: dict[str, Any] = {
    'object': dict,
    'array': list,
    'string': str,
    'number': (int, float),
    'null': type(None),
}


def accepts(schema: dict[str, Any], value: Any) -> bool:
    """Whether ``value`` meets ``schema``: the keywords that the schema of worlds is written with."""
    if '$ref' in schema and not accepts(SCHEMA['$defs'][schema['$ref'].split('/')[-1]], value):
        return False
    types = schema.get('type', [])
    types = [types] if isinstance(types, str) else types
    if types and not any(
        isinstance(value, TYPES[name]) and not isinstance(value, bool) for name in types
    ):
        return False
    if isinstance(value, dict):
        properties = schema.get('properties', {})
        other = schema.get('additionalProperties', {})
        for key, item in value.items():
            rule = properties.get(key, other)
            if rule is False or not accepts(rule, item):
                return False
            if not accepts(schema.get('propertyNames', {}), key):
                return False
        if not set(schema.get('required', [])) <= set(value):
            return False
    if isinstance(value, list):
        if not schema.get('minItems', 0) <= len(value) <= schema.get('maxItems', len(value)):
            return False
        if not all(accepts(schema.get('items', {}), item) for item in value):
            return False
    if isinstance(value, str) and not re.search(schema.get('pattern', ''), value):
        return False
    if isinstance(value, (int, float)) and not (
        schema.get('minimum', value) <= value <= schema.get('maximum', value)
        and value < schema.get('exclusiveMaximum', float('inf'))
    ):
        return False
    if 'const' in schema and value != schema['const']:
        return False
    if 'enum' in schema and value not in schema['enum']:
        return False
    if 'not' in schema and accepts(schema['not'], value):
        return False
    if not all(accepts(rule, value) for rule in schema.get('allOf', [])):
        return False
    return 'oneOf' not in schema or sum(accepts(rule, value) for rule in schema['oneOf']) == 1


def agree(text: str) -> bool:
    """Whether reader and schema both accept ``text``; they must not differ."""
    by_schema = accepts(SCHEMA, yaml.safe_load(text))
    try:
        read_world(text, '')
    except MotionPlannerError:
        assert not by_schema
        return False
    assert by_schema
    return True


def test_the_world_of_the_mission_meets_the_schema() -> None:
    assert agree(ROVER)
    assert '$schema=../world.schema.json' in ROVER.splitlines()[0]


@pytest.mark.parametrize(
    ('old', 'new'),
    [
        ('bounds:', 'bound:'),
        ('[0, 0, 800, 600] ', '[0, 0, 800] '),
        ('[0, 0, 800, 600] ', '[0, 0, 800, 2.0e+8] '),
        ('location0:', 'location-0:'),
        ('location0:', 'pi:'),
        ('{x: 20, y: 20}', '{x: 20}'),
        ('{x: 20, y: 20}', '{x: 20, y: "20"}'),
        ('{x: 20, y: 20}', '{x: 20, y: true}'),
        ('[[165, 0], [185, 0], [185, 95], [165, 95]]', '[[165, 0], [185, 0]]'),
        ('[165, 0]', '[165]'),
        ('polygon:', 'polygone:'),
        ('radius: 28', 'radius: 0'),
        ('center:', 'centre:'),
        ('model: car', 'model: tank'),
        ('wheelbase: 8.0', 'wheelbase: -8.0'),
        ('max_steering_angle: 0.5', 'max_steering_angle: 1.6'),
        ('radius: 5.0', 'radius: -1.0'),
        ('speed: 2.0', ''),
        ('speed: 2.0', 'speed: 2.0\n    start: {x: 20, y: 20}'),
        ('radius: 5.0', 'footprint: [[-1, -1], [1, -1]]'),
        ('radius: 5.0', 'footprint: [[-1, -1], [1, -1], [1, 1]]\n    radius: 5.0'),
        ('radius: 5.0', ''),
        ('speed: 2.0', 'speed: 2.0\n    safety_margin: -1.0'),
        ('speed: 2.0', 'speed: 2.0\n    turning_speed: 1.0'),
        ('model: car', 'model: differential'),
        ('wheelbase: 8.0', ''),
    ],
)
def test_reader_and_schema_refuse_the_same(old: str, new: str) -> None:
    assert old in ROVER
    assert not agree(ROVER.replace(old, new, 1))


DOCK = 'regions: [{name: dock, polygon: [[0, 0], [9, 0], [9, 9]]}]\n'


@pytest.mark.parametrize(
    ('old', 'new'),
    [
        ('name: dock, ', ''),
        ('name: dock', 'name: pi'),
        ('name: dock', 'name: dock-1'),
        ('name: dock', 'name: 7'),
        ('polygon: [[0, 0], [9, 0], [9, 9]]', ''),
        ('polygon: [[0, 0], [9, 0], [9, 9]]', 'polygon: [[0, 0], [9, 0]]'),
        ('}]', ', circle: {center: [1, 2], radius: 3}}]'),
        ('[{name: dock, polygon: [[0, 0], [9, 0], [9, 9]]}]', '{dock: {}}'),
    ],
)
def test_reader_and_schema_refuse_the_same_regions(old: str, new: str) -> None:
    assert old in DOCK
    assert not agree(ROVER + DOCK.replace(old, new, 1))


@pytest.mark.parametrize(
    'text',
    [
        'objects: {}',
        'map:',
        'bounds: [0, 0, 1, 1]\nmap:',
        'map: [a.yaml]',
        'map: {unknown: free}',
        'map: {file: a.yaml, unknown: maybe}',
        'map: {file: a.yaml, known: free}',
        'bounds: [0, 0, 1, 1]\nobstacles: [{geojson: a, name: b}]',
        'bounds: [0, 0, 1, 1]\nobstacles: [{geojson: 7}, {geojson: []}]',
        'bounds: [0, 0, 1, 1]\nregions: [{geojson: a, name: b}]',
        'bounds: [0, 0, 1, 1]\nregions: [{geojson: a, circle: {center: [1, 2], radius: 3}}]',
    ],
)
def test_reader_and_schema_refuse_the_same_files(text: str) -> None:
    assert not agree(text)


def test_reader_and_schema_accept_files(tmp_path: Path) -> None:
    square = [[0, 0], [1, 0], [1, 1], [0, 0]]
    polygon = {'type': 'Polygon', 'coordinates': [square]}
    feature = {'type': 'Feature', 'properties': {'name': 'dock'}, 'geometry': polygon}
    (tmp_path / 'a.geojson').write_text(json.dumps(feature))
    (tmp_path / 'a.yaml').write_text('image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\n')
    (tmp_path / 'a.pgm').write_bytes(b'P5 1 1 255\n\xff')
    for text in (
        'map: a.yaml',
        'map: {file: a.yaml, unknown: free}\nbounds: [0, 0, 2, 2]',
        'map: a.yaml\nobstacles: [{geojson: a.geojson}]\nregions: [{geojson: a.geojson}]',
    ):
        assert accepts(SCHEMA, yaml.safe_load(text))
        assert read_world(text, str(tmp_path / 'world.yaml')).map


def test_reader_and_schema_accept_the_same() -> None:
    assert agree('bounds: [0, 0, 1, 1]')
    assert agree('bounds: [0, 0, 1, 1]\nobjects:\nobstacles:\nrobots:\nregions:\n')
    assert agree(ROVER + DOCK)
    assert agree(ROVER + 'regions: [{name: dock, circle: {center: [1, 2], radius: 3}}]\n')
    assert agree(ROVER.replace('{x: 20, y: 20}', '{x: 20, y: 20, height: 3}'))
    assert agree(ROVER + '    start: {x: 20, y: 20, heading: 7}\n')


def test_reader_and_schema_accept_every_model_and_footprint() -> None:
    shapes = ('radius: 1', 'footprint: [[-1, -1], [2, -1], [2, 1], [-1, 1]]')
    steering = 'wheelbase: 1, max_steering_angle: 0.5'
    commands = {'car': steering, 'reverse_car': steering}
    commands |= dict.fromkeys(('differential', 'omnidirectional'), 'turning_speed: 1')
    assert set(commands) == set(MODELS)
    for model, command in commands.items():
        for shape in shapes:
            robot = f'{{model: {model}, {command}, {shape}, speed: 1, safety_margin: 0.5}}'
            assert agree(f'bounds: [0, 0, 9, 9]\nrobots: {{r: {robot}}}\n'), robot


def keys_of(schema: dict[str, Any]) -> set[str]:
    found = set(schema.get('properties', {}))
    for child in schema.get('properties', {}).values():
        found |= keys_of(child)
    for name in ('additionalProperties', 'items'):
        if isinstance(schema.get(name), dict):
            found |= keys_of(schema[name])
    return found


def test_every_key_is_documented() -> None:
    keys = keys_of(SCHEMA)
    assert len(keys) >= 15
    table = [
        line for line in (TOP / 'docs' / 'world.md').read_text().splitlines() if line[:2] == '| '
    ]
    for key in keys:
        assert any(re.search(rf'`[^`]*\b{key}\b[^`]*`', line) for line in table), key


def test_the_documented_example_is_a_world() -> None:
    text = (TOP / 'docs' / 'world.md').read_text()
    assert agree(text.split('```yaml\n')[1].split('```')[0])
