"""The worlds as the reference sees them."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.path import Path as Outline

from experiments.motion.geometry import Array, Ground, make_ground
from experiments.motion.lattice import GRID, Lattice
from experiments.motion.worlds import Place

#: Heading bins of the lattice, and of the one that is searched where the first has no way.
BINS, FINER_BINS = 32, 48


def lattice_of(place: Place, bins: int = BINS) -> Lattice:
    """The lattice for a world and its car."""
    grid = place.turning_radius / GRID
    x_min, y_min, x_max, y_max = place.bounds
    columns, rows = math.ceil((x_max - x_min) / grid), math.ceil((y_max - y_min) / grid)
    x = x_min + (np.arange(columns) + 0.5) * grid
    y = y_min + (np.arange(rows) + 0.5) * grid
    points = np.column_stack([np.tile(x, rows), np.repeat(y, columns)])
    inside = inside_obstacles(place, points).reshape(rows, columns)
    return Lattice(ground_of(place), inside, grid, bins)


def ground_of(place: Place) -> Ground:
    """The boundaries of a world for its car."""
    edges: list[Array] = [np.empty((0, 4))]
    discs: list[Array] = [np.empty((0, 3))]
    for obstacle in place.document.get('obstacles', ()):
        if 'polygon' in obstacle:
            corners = np.array(obstacle['polygon'], float)
            edges.append(np.hstack([corners, np.roll(corners, -1, axis=0)]))
        else:
            circle = obstacle['circle']
            discs.append(np.array([[*circle['center'], circle['radius']]], float))
    if place.occupied is not None:
        edges.append(map_edges(place))
    return make_ground(
        place.bounds, np.vstack(edges), np.vstack(discs), place.robot['radius'],
        place.turning_radius,
    )  # fmt: skip


def inside_obstacles(place: Place, points: Array) -> Array:
    """Which of ``points`` (n, 2) are in an obstacle."""
    inside = np.zeros(len(points), bool)
    for obstacle in place.document.get('obstacles', ()):
        if 'polygon' in obstacle:
            inside |= Outline(obstacle['polygon']).contains_points(points)
        else:
            circle = obstacle['circle']
            away = np.hypot(*(points - np.array(circle['center'])).T)
            inside |= away < circle['radius']
    if place.occupied is not None:
        rows, columns = place.occupied.shape
        corner = place.bounds[:2]
        i = np.clip((points[:, 0] - corner[0]) / place.resolution, 0, columns - 1).astype(int)
        j = np.clip((points[:, 1] - corner[1]) / place.resolution, 0, rows - 1).astype(int)
        inside |= place.occupied[j, i]
    return inside


def map_edges(place: Place) -> Array:
    """Straight boundaries (e, 4) between occupied and free cells, as long as they are straight."""
    occupied = np.asarray(place.occupied)
    corner, cell = place.bounds[:2], place.resolution
    edges = []
    for upright in (False, True):
        cells = occupied.T if upright else occupied
        changes = np.diff(cells.astype(np.int8), axis=0)
        # Runs of equal changes along each line between two rows of cells.
        padded = np.pad(changes, ((0, 0), (1, 1)))
        steps = np.diff(padded, axis=1)
        line, begin = np.nonzero((steps != 0) & (padded[:, 1:] != 0))
        stop_line, stop = np.nonzero((steps != 0) & (padded[:, :-1] != 0))
        assert np.array_equal(line, stop_line)
        along = corner[1] if upright else corner[0]
        across = corner[0] if upright else corner[1]
        a, b = along + begin * cell, along + stop * cell
        c = across + (line + 1) * cell
        edges.append(np.column_stack([c, a, c, b] if upright else [a, c, b, c]))
    return np.vstack(edges)
