"""The worlds of the experiment: each a world file, and the same as arrays for the reference."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from numpy.typing import NDArray

from experiments.motion.goals import AGENT
from experiments.motion.maps import RESOLUTION, Drawing, draw_office, draw_park

Array = NDArray[np.float64]
ROOT = Path(__file__).resolve().parents[2]
ROVER = ROOT / 'src' / 'interface_node' / 'missions' / 'rover' / 'world.yaml'


@dataclass(frozen=True)
class Place:
    """A world: ``document`` is what its file says; ``occupied`` (rows, columns) its map, south first."""

    name: str
    document: Mapping[str, Any]
    folder: Path
    occupied: NDArray[np.bool_] | None = None
    resolution: float = 0.0

    @property
    def text(self) -> str:
        """The world file."""
        text: str = yaml.safe_dump(dict(self.document), sort_keys=False, default_flow_style=None)
        return text

    def write(self) -> Path:
        """Write the world file beside its map, and say where."""
        self.folder.mkdir(parents=True, exist_ok=True)
        path = self.folder / f'{self.name}_world.yaml'
        path.write_text(self.text, encoding='utf-8')
        return path

    @property
    def robot(self) -> Mapping[str, float]:
        """The car that drives here."""
        robot: Mapping[str, float] = self.document['robots'][AGENT]
        return robot

    @property
    def turning_radius(self) -> float:
        """Radius [m] of the car's tightest turn."""
        return self.robot['wheelbase'] / math.tan(self.robot['max_steering_angle'])

    @property
    def bounds(self) -> Array:
        """x_min, y_min, x_max, y_max [m]."""
        return np.array(self.document['bounds'], float)

    @property
    def objects(self) -> Mapping[str, Mapping[str, float]]:
        """What requests speak of."""
        objects: Mapping[str, Mapping[str, float]] = self.document['objects']
        return objects


def _car(turning_radius: float, radius: float) -> dict[str, Any]:
    angle = 0.5
    return {
        'model': 'car',
        'wheelbase': turning_radius * math.tan(angle),
        'max_steering_angle': angle,
        'radius': radius,
        'speed': 1.0,
    }


def rover(folder: Path) -> Place:
    """The paper's world."""
    document = yaml.safe_load(ROVER.read_text(encoding='utf-8'))
    document['robots'] = {AGENT: document['robots']['rover0']}
    return Place('rover', document, folder)


def maze(folder: Path, columns: int = 14, rows: int = 10) -> Place:
    """Corridors 9.5 m wide, some of whose passages are gates of 3 m for a disc of 2 m; a few ways round."""
    random = np.random.default_rng(4)
    cell, wall, gate = 10.0, 0.5, 3.0
    reached = {(0, 0)}
    joined: set[tuple[tuple[int, int], tuple[int, int]]] = set()
    stack = [(0, 0)]
    while stack:
        i, j = stack[-1]
        around = [(i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)]
        fresh = [
            (a, b) for a, b in around
            if 0 <= a < columns and 0 <= b < rows and (a, b) not in reached
        ]  # fmt: skip
        if not fresh:
            stack.pop()
            continue
        chosen = fresh[int(random.integers(len(fresh)))]
        joined.add((min((i, j), chosen), max((i, j), chosen)))
        reached.add(chosen)
        stack.append(chosen)
    obstacles: list[dict[str, Any]] = []

    def block(x0: float, y0: float, x1: float, y1: float) -> None:
        corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
        obstacles.append({'polygon': [[float(x), float(y)] for x, y in corners]})

    half = 0.5 * wall
    for i in range(columns):
        for j in range(rows):
            for a, b in ((i + 1, j), (i, j + 1)):
                if a == columns or b == rows:
                    continue
                is_open = ((i, j), (a, b)) in joined or random.random() < 0.12
                gap = 0.0
                if is_open:
                    if random.random() < 0.5:
                        continue
                    gap = gate
                at = cell * (a if a > i else b)
                low = cell * (j if a > i else i)
                edge = 0.5 * (cell - gap)
                parts = [(low - half, low + cell + half)] if gap == 0.0 else [
                    (low - half, low + edge), (low + cell - edge, low + cell + half)
                ]  # fmt: skip
                for start, end in parts:
                    if a > i:
                        block(at - half, max(start, 0.0), at + half, min(end, rows * cell))
                    else:
                        block(max(start, 0.0), at - half, min(end, columns * cell), at + half)
    objects = {
        f'mark{k}': {
            'x': float(cell * (random.integers(columns) + 0.5) + random.uniform(-3, 3)),
            'y': float(cell * (random.integers(rows) + 0.5) + random.uniform(-3, 3)),
        }
        for k in range(24)
    }
    document = {
        'bounds': [0.0, 0.0, columns * cell, rows * cell],
        'objects': objects,
        'obstacles': obstacles,
        'robots': {AGENT: _car(3.0, 1.0)},
    }
    return Place('maze', document, folder)


def field(folder: Path, discs: int = 200) -> Place:
    """An open field with round obstacles, which may overlap."""
    random = np.random.default_rng(5)
    size = 400.0
    obstacles: list[dict[str, Any]] = []
    while len(obstacles) < discs:
        x, y = random.uniform(0.0, size, 2)
        radius = random.uniform(3.0, 9.0)
        obstacles.append({'circle': {'center': [float(x), float(y)], 'radius': float(radius)}})
    objects = {
        f'tree{k}': {'x': float(x), 'y': float(y)}
        for k, (x, y) in enumerate(random.uniform(20.0, size - 20.0, (24, 2)))
    }
    document = {
        'bounds': [0.0, 0.0, size, size],
        'objects': objects,
        'obstacles': obstacles,
        'robots': {AGENT: _car(8.0, 2.0)},
    }
    return Place('field', document, folder)


def office(folder: Path) -> Place:
    """Rooms and corridors on a map image, with doors 1.1 m wide for a disc of 0.6 m."""
    return _mapped(folder, 'office', draw_office(), _car(0.8, 0.3), seed=8)


def park(folder: Path) -> Place:
    """A map image of 4,000 by 4,000 cells."""
    return _mapped(folder, 'park', draw_park(), _car(3.0, 1.0), seed=9)


def _mapped(folder: Path, name: str, drawing: Drawing, car: dict[str, Any], seed: int) -> Place:
    """A world with a map and nothing else but objects, the same at each call."""
    occupied = drawing.write(folder, name)
    rows, columns = occupied.shape
    bounds = [0.0, 0.0, columns * RESOLUTION, rows * RESOLUTION]
    places = np.random.default_rng(seed).uniform(bounds[:2], bounds[2:], (24, 2)).round(2)
    document = {
        'bounds': bounds,
        'map': f'{name}.yaml',
        'objects': {f'mark{k}': {'x': float(x), 'y': float(y)} for k, (x, y) in enumerate(places)},
        'robots': {AGENT: car},
    }
    return Place(name, document, folder, occupied, RESOLUTION)


#: The worlds by name.
WORLDS: Mapping[str, Callable[[Path], Place]] = {
    'rover': rover,
    'maze': maze,
    'field': field,
    'office': office,
    'park': park,
}
