"""Drawing what is on the ground: regions, the cells of the map, obstacles."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.patches import Circle, Patch, Polygon
from matplotlib.transforms import Affine2D

from interface_node.plan import Obstacle, World

#: Finer maps are drawn with as many cells on a side at most.
MAX_MAP_SIDE = 2000
OBSTACLE, OBSTACLE_EDGE = '#c3c8cf', '#9aa1ab'
REGION, REGION_EDGE = '#e3f1e6', '#5fa777'


def draw_regions(axes: Axes, world: World) -> None:
    """Draw the named parts of the map, under everything else."""
    style = {'facecolor': REGION, 'edgecolor': REGION_EDGE, 'linewidth': 1.0, 'linestyle': '--'}
    for region in world.regions:
        axes.add_patch(_patch(region, zorder=0.5, **style))


def centroid(shape: Obstacle) -> tuple[float, float]:
    """The mean of the corners, or the centre of a disc [m]."""
    corners = shape.corners or (shape.center,)
    x, y = (sum(values) / len(corners) for values in zip(*corners, strict=True))
    return x, y


def draw_map(axes: Axes, world: World) -> None:
    """Draw the occupied cells of the map; of several in one spot, one is enough."""
    if world.map is None:
        return
    cells, every = world.map.occupied, -(-max(world.map.occupied.shape) // MAX_MAP_SIDE)
    rows, columns = (-(-side // every) for side in cells.shape)
    blocks = np.zeros((rows * every, columns * every), np.bool_)
    blocks[: cells.shape[0], : cells.shape[1]] = cells
    seen = blocks.reshape(rows, every, columns, every).any(axis=(1, 3))
    pixels = np.zeros((rows, columns, 4))
    pixels[seen] = to_rgba(OBSTACLE_EDGE)
    side = every * world.map.resolution
    turn = Affine2D().rotate(world.map.yaw).translate(*world.map.origin)
    axes.imshow(
        pixels,
        origin='lower',
        extent=(0, columns * side, 0, rows * side),
        transform=turn + axes.transData,
        interpolation='nearest',
        aspect=axes.get_aspect(),
        zorder=0.9,
    )
    axes.set_xlim(world.bounds[0], world.bounds[2])
    axes.set_ylim(world.bounds[1], world.bounds[3])


def draw_obstacles(axes: Axes, world: World) -> None:
    """Draw polygons and discs, one over the other."""
    style = {'facecolor': OBSTACLE, 'edgecolor': OBSTACLE_EDGE, 'linewidth': 0.8, 'zorder': 1}
    for obstacle in world.obstacles:
        axes.add_patch(_patch(obstacle, **style))


def _patch(shape: Obstacle, **style: Any) -> Patch:
    if shape.corners:
        return Polygon(shape.corners, closed=True, **style)
    return Circle(shape.center, shape.radius, **style)
