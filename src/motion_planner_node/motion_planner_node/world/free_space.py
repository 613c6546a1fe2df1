"""Where the disc of a robot can be at all, and how far it is to drive there."""

from __future__ import annotations

from collections import OrderedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from motion_planner_node.world.grid import Grid, travel_grid
from motion_planner_node.world.regions import (
    components,
    labels_at,
    travel_at_each,
    travel_distances,
)
from motion_planner_node.world.shapes import Shapes

#: Cells on the shorter side of the map, as far as the number of all cells allows.
CELLS_ON_SHORTER_SIDE = 300
MOST_CELLS = 250_000
#: Distance fields that are kept, one per start.
MOST_FIELDS = 32


class Cells:
    """Boxes of the map [m]: arrays ``x_lo``, ``x_hi``, ``y_lo``, ``y_hi`` of shape (n,)."""

    def __init__(self, grid: Grid, chosen: NDArray[np.bool_]) -> None:
        rows, columns = np.nonzero(chosen)
        self.x_lo = grid.corner[0] + columns * grid.cell
        self.y_lo = grid.corner[1] + rows * grid.cell
        self.x_hi = self.x_lo + grid.cell
        self.y_hi = self.y_lo + grid.cell

    def __len__(self) -> int:
        return len(self.x_lo)


class TravelField:
    """Estimated lengths [m] of motions between one point and all others, obstacles regarded.

    The turning radius is not; see ``robots.driving.shortest_between`` for a bound that does.
    """

    def __init__(self, grid: Grid, distances: NDArray[np.float64], x: float, y: float) -> None:
        #: At the middles of the cells, shape (rows + 2, columns + 2), infinite all round the grid.
        self.distances = distances
        #: The point, and the corner of the grid [m].
        self.origin = (x, y)
        self.corner = grid.corner
        #: Side [m] of a cell.
        self.cell = grid.cell

    def at(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64]:
        """Estimates [m] at points, of the shape of both ``x`` and ``y``; infinite where no way leads.

        Never less than the straight distance.
        """
        xs, ys = np.asarray(x, np.float64), np.asarray(y, np.float64)
        flat = np.ascontiguousarray(xs.reshape(-1)), np.ascontiguousarray(ys.reshape(-1))
        around = travel_at_each(self.distances, *self.corner, self.cell, *flat)
        straight = np.hypot(xs - self.origin[0], ys - self.origin[1])
        return np.asarray(np.maximum(around.reshape(xs.shape), straight))


class FreeSpace:
    """A sound over-approximation of the places where a disc of clearance ``margin`` [m] is free.

    What is not connected here is not connected in truth.  Gaps of less than twice the margin are
    closed as far as ``resolution`` lets them be seen.
    """

    def __init__(self, grid: Grid, travel: Grid) -> None:
        self._grid = grid
        self._labels = components(grid.open)
        self._travel_grid = travel
        self._fields: OrderedDict[tuple[float, float], TravelField] = OrderedDict()

    @classmethod
    def of(cls, shapes: Shapes, margin: float) -> FreeSpace:
        """The free space of a disc of clearance ``margin`` [m] among ``shapes``."""
        grid = Grid(shapes, margin, MOST_CELLS, CELLS_ON_SHORTER_SIDE)
        return cls(grid, travel_grid(shapes, margin, grid))

    def with_more(self, shapes: Shapes, boxes: NDArray[np.float64]) -> FreeSpace:
        """The same where there are more ``shapes``, those in ``boxes`` (n, 4) [m], than before."""
        return FreeSpace(
            self._grid.with_more(shapes, boxes), self._travel_grid.with_more(shapes, boxes)
        )

    @property
    def resolution(self) -> float:
        """Side [m] of a cell."""
        return self._grid.cell

    @property
    def cells(self) -> Cells:
        """All cells that may be free."""
        return Cells(self._grid, self._grid.open)

    def component_of(self, x: float, y: float) -> int:
        """Number of the component that holds (x, y) [m]; -1 when it is not free."""
        return int(self.components_of([x], [y])[0])

    def components_of(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.int32]:
        """Numbers of the components at points of shape (n,); -1 where they are not free."""
        xs, ys = np.ascontiguousarray(x, np.float64), np.ascontiguousarray(y, np.float64)
        return labels_at(self._labels, *self._grid.corner, self._grid.cell, xs, ys)

    def distance_from(self, x: float, y: float) -> TravelField:
        """Estimated lengths [m] of motions between (x, y) and everywhere; kept for the next call."""
        key = (x, y)
        field = self._fields.get(key)
        if field is None:
            grid = self._travel_grid
            distances = travel_distances(
                grid.framed, grid.cell, float(x - grid.corner[0]), float(y - grid.corner[1])
            )
            field = TravelField(grid, distances, x, y)
            self._fields[key] = field
            while len(self._fields) > MOST_FIELDS:
                self._fields.popitem(last=False)
        else:
            self._fields.move_to_end(key)
        return field
