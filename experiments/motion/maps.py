"""Draw the maps of the experiment as images in the format of map_server: PNG and YAML."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import yaml
from numpy.typing import NDArray
from PIL import Image, ImageDraw

#: Sides [m] of a cell.
RESOLUTION = 0.05
FREE, OCCUPIED, UNKNOWN = 254, 0, 205

Box = tuple[float, float, float, float]


class Drawing:
    """A map that is drawn in metres, y north."""

    def __init__(self, width: float, height: float) -> None:
        self.height = height
        size = round(width / RESOLUTION), round(height / RESOLUTION)
        self.image = Image.new('L', size, FREE)
        self._draw = ImageDraw.Draw(self.image)

    def box(self, box: Box, shade: int = OCCUPIED) -> None:
        """Fill x_min, y_min, x_max, y_max [m]."""
        x0, y0, x1, y1 = box
        corners = [x0, self.height - y1, x1, self.height - y0]
        left, top, right, bottom = (round(value / RESOLUTION) for value in corners)
        self._draw.rectangle((left, top, right - 1, bottom - 1), shade)

    def polygon(self, corners: NDArray[np.float64]) -> None:
        """Fill a polygon (n, 2) [m]."""
        flipped = np.column_stack([corners[:, 0], self.height - corners[:, 1]]) / RESOLUTION
        self._draw.polygon([(float(x), float(y)) for x, y in flipped], OCCUPIED)

    def write(self, folder: Path, name: str) -> NDArray[np.bool_]:
        """Write ``name``.png and ``name``.yaml; the cells that are not free, southern row first."""
        folder.mkdir(parents=True, exist_ok=True)
        self.image.save(folder / f'{name}.png')
        fields = {
            'image': f'{name}.png',
            'mode': 'trinary',
            'resolution': RESOLUTION,
            'origin': [0.0, 0.0, 0.0],
            'negate': 0,
            'occupied_thresh': 0.65,
            'free_thresh': 0.196,
        }
        text = yaml.safe_dump(fields, sort_keys=False, default_flow_style=None)
        (folder / f'{name}.yaml').write_text(text, encoding='utf-8')
        return np.asarray(np.asarray(self.image)[::-1] != FREE)


def draw_office() -> Drawing:
    """Rooms with desks on both sides of two corridors, 60 m by 40 m."""
    random = np.random.default_rng(6)
    drawing = Drawing(60.0, 40.0)
    wall, door = 0.15, 1.1
    drawing.box((0.0, 0.0, 60.0, wall))
    drawing.box((0.0, 40.0 - wall, 60.0, 40.0))
    drawing.box((0.0, 0.0, wall, 40.0))
    drawing.box((60.0 - wall, 0.0, 60.0, 40.0))
    # Rows of rooms, the side on which their doors are, and the corridors between the rows.
    for south, north, door_north in (
        (0.0, 8.0, 1),
        (10.4, 19.0, 0),
        (19.0, 28.0, 1),
        (30.4, 40.0, 0),
    ):
        for y in (south, north):
            drawing.box((0.0, y - wall / 2, 60.0, y + wall / 2))
        west = 0.0
        while west < 54.0:
            east = min(west + float(random.uniform(4.5, 8.5)), 60.0)
            if east > 55.5:
                east = 60.0
            drawing.box((east - wall / 2, south, east + wall / 2, north))
            at = float(random.uniform(west + 0.5, east - 0.5 - door))
            y = north if door_north else south
            drawing.box((at, y - wall / 2, at + door, y + wall / 2), FREE)
            _furnish(drawing, random, (west, south, east, north), door_north)
            west = east
    # Two passages from one corridor to the other, through the rows between them.
    for west in (17.0, 41.0):
        drawing.box((west, 10.3, west + 1.8, 28.1), FREE)
        for x in (west - wall, west + 1.8):
            drawing.box((x, 10.4, x + wall, 28.0))
    drawing.box((52.0, 30.6, 54.0, 33.0), UNKNOWN)
    return drawing


def _furnish(drawing: Drawing, random: np.random.Generator, room: Box, door_north: int) -> None:
    """Desks along the wall across from the door, and here and there a table."""
    west, south, east, north = room
    x = west + 0.6
    while x + 1.6 < east - 0.6:
        if random.random() < 0.6:
            depth = 0.8
            y = south + 0.1 if door_north else north - 0.1 - depth
            drawing.box((x, y, x + 1.6, y + depth))
        x += 2.4
    if random.random() < 0.6:
        x, y = random.uniform((west + 1.7, south + 2.6), (east - 1.7, north - 2.6))
        angles = np.linspace(0.0, 2.0 * np.pi, 40)
        drawing.polygon(np.column_stack([x + 0.6 * np.cos(angles), y + 0.6 * np.sin(angles)]))


def draw_park() -> Drawing:
    """4,000 by 4,000 cells with 700 irregular groves and some long hedges with gaps."""
    random = np.random.default_rng(7)
    size = 200.0
    drawing = Drawing(size, size)
    for _ in range(700):
        x, y = random.uniform(0.0, size, 2)
        angles = np.sort(random.uniform(0.0, 2.0 * np.pi, 12))
        radius = random.uniform(0.4, 1.0, 12) * random.uniform(0.6, 3.2)
        corners = np.column_stack([x + radius * np.cos(angles), y + radius * np.sin(angles)])
        drawing.polygon(corners)
    for k in range(1, 8):
        at = 25.0 * k
        gaps = np.sort(random.uniform(8.0, size - 8.0, 5))
        start = 0.0
        for gap in [*gaps, size + 3.0]:
            end = float(gap) - 3.0
            if end > start:
                low, high = at - 0.25, at + 0.25
                drawing.box((start, low, end, high) if k % 2 else (low, start, high, end))
            start = max(start, float(gap) + 3.0)
    return drawing
