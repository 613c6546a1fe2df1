"""Polygons out of GeoJSON files (RFC 7946), in metres of the frame ``map``."""

from __future__ import annotations

from collections.abc import Iterator

from motion_planner_node.world.files import LONGEST_PATH, read_file
from motion_planner_node.world.holes import with_holes
from motion_planner_node.world.model import Polygon
from motion_planner_node.world.outlines import read_polygon
from motion_planner_node.world.syntax import Mapping, Node, Sequence, read_tree
from motion_planner_node.world.values import Faults, is_nothing, kind_of, read_text

#: The longest file [bytes].
LONGEST_FILE = 4 << 20

#: A polygon, called after its place in the file, and the property name of its feature.
Named = tuple[str | None, Polygon]


def read_geojson(node: Node, directory: str, faults: Faults) -> list[Named]:
    """The polygons of the file that ``node`` names, relative to ``directory``, in their order.

    What is wrong goes to ``faults``, with a JSON pointer and the line in the file.
    """
    name = read_text(node, 'geojson', faults, LONGEST_PATH)
    if name is None:
        return []
    file = read_file(directory, name, LONGEST_FILE, 'the GeoJSON file', node.place, faults)
    if file is None:
        return []
    root = read_tree(file.content.decode('utf-8', errors='replace'), file.path, LONGEST_FILE)
    own = Faults(file.path)
    found = list(_Reader(own).polygons(root))
    if not found and not own:
        own.add('there is no polygon in the file', root.place)
    faults.include(own)
    return found


class _Reader:
    """Walks through one file; what is wrong goes to ``faults``."""

    def __init__(self, faults: Faults) -> None:
        self._faults = faults

    def polygons(self, root: Node) -> Iterator[Named]:
        kind = self._kind(root, '')
        if kind == 'FeatureCollection':
            features = self._member(root, '', 'features')
            for number, feature in enumerate(self._items(features, '/features')):
                pointer = f'/features/{number}'
                if self._kind(feature, pointer) == 'Feature':
                    yield from self._feature(feature, pointer)
                else:
                    self._faults.add(f'{pointer} is not a Feature', feature.place)
        elif kind == 'Feature':
            yield from self._feature(root, '')
        elif kind is not None:
            yield from self._geometry(root, '', None)

    def _feature(self, feature: Node, pointer: str) -> Iterator[Named]:
        name: str | None = None
        properties = _value(feature, 'properties')
        label = _value(properties, 'name') if properties is not None else None
        if label is not None and not is_nothing(label):
            name = read_text(label, f'{pointer}/properties/name', self._faults)
        geometry = self._member(feature, pointer, 'geometry')
        if geometry is not None:
            yield from self._geometry(geometry, f'{pointer}/geometry', name)

    def _geometry(self, geometry: Node, pointer: str, name: str | None) -> Iterator[Named]:
        kind = self._kind(geometry, pointer)
        if kind is None:
            return
        if kind not in {'Polygon', 'MultiPolygon'}:
            message = f'{pointer or "/"} is a {kind[:40]}; Polygon and MultiPolygon can be used'
            self._faults.add(message, geometry.place)
            return
        where = f'{pointer}/coordinates'
        coordinates = self._member(geometry, pointer, 'coordinates')
        if kind == 'Polygon':
            yield from self._polygon(coordinates, where, name)
            return
        for number, rings in enumerate(self._items(coordinates, where)):
            yield from self._polygon(rings, f'{where}/{number}', name)

    def _polygon(self, rings: Node | None, pointer: str, name: str | None) -> Iterator[Named]:
        items = self._items(rings, pointer)
        if rings is not None and not items:
            self._faults.add(f'{pointer} has no ring', rings.place)
        read = [
            read_polygon(_flat(item), f'{pointer}/{number}', self._faults)
            for number, item in enumerate(items)
        ]
        whole = [polygon for polygon in read if polygon is not None]
        if whole and len(whole) == len(items):
            places = [item.place for item in items[1:]]
            polygon = with_holes(whole[0], whole[1:], places, self._faults)
            if polygon is not None:
                yield name, polygon

    def _kind(self, node: Node, pointer: str) -> str | None:
        if not isinstance(node, Mapping):
            message = f'{pointer or "/"} has to be an object, not {kind_of(node)}'
            self._faults.add(message, node.place)
            return None
        member = self._member(node, pointer, 'type')
        return read_text(member, f'{pointer}/type', self._faults) if member is not None else None

    def _member(self, node: Node, pointer: str, key: str) -> Node | None:
        member = _value(node, key)
        if member is None:
            self._faults.add(f'{pointer or "/"} lacks {key}', node.place)
        return member

    def _items(self, node: Node | None, pointer: str) -> list[Node]:
        if node is None:
            return []
        if not isinstance(node, Sequence):
            self._faults.add(f'{pointer} has to be a list, not {kind_of(node)}', node.place)
            return []
        return node.items


def _value(node: Node, key: str) -> Node | None:
    """The value of a key, the last one if it is there twice, as JSON's readers have it."""
    if not isinstance(node, Mapping):
        return None
    return next((value for name, value in reversed(node.entries) if name.text == key), None)


def _flat(ring: Node) -> Node:
    """A ring whose positions have lost their altitude."""
    if not isinstance(ring, Sequence):
        return ring
    return Sequence(ring.place, [_pair(position) for position in ring.items])


def _pair(position: Node) -> Node:
    if isinstance(position, Sequence) and len(position.items) == 3:
        return Sequence(position.place, position.items[:2])
    return position
