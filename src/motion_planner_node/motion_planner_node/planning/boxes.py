"""Rectangles of the map, and a quick way to ask a question about very many of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: Small boxes along a side of a big one.
FACTOR = 8

Question = Callable[
    [NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]],
    NDArray[np.bool_],
]


@dataclass(frozen=True, slots=True)
class Boxes:
    """Closed rectangles [m], each array of shape (n,)."""

    x_lo: NDArray[np.float64]
    x_hi: NDArray[np.float64]
    y_lo: NDArray[np.float64]
    y_hi: NDArray[np.float64]

    @classmethod
    def of(cls, x_lo: ArrayLike, x_hi: ArrayLike, y_lo: ArrayLike, y_hi: ArrayLike) -> Boxes:
        """The boxes with these sides [m], each of shape (n,)."""
        return cls(*(np.asarray(side, np.float64) for side in (x_lo, x_hi, y_lo, y_hi)))

    @classmethod
    def tiling(cls, x_min: float, y_min: float, x_max: float, y_max: float, count: int) -> Boxes:
        """``count`` by ``count`` equal boxes that cover a rectangle."""
        xs, ys = np.linspace(x_min, x_max, count + 1), np.linspace(y_min, y_max, count + 1)
        columns, rows = (grid.ravel() for grid in np.meshgrid(range(count), range(count)))
        return cls(xs[columns], xs[columns + 1], ys[rows], ys[rows + 1])

    @property
    def centres(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The x and y [m] of the middles."""
        return 0.5 * (self.x_lo + self.x_hi), 0.5 * (self.y_lo + self.y_hi)

    def chosen(self, which: NDArray[np.bool_] | NDArray[np.intp]) -> Boxes:
        """Only some of the boxes, by mask or index."""
        return Boxes(self.x_lo[which], self.x_hi[which], self.y_lo[which], self.y_hi[which])

    def distances(self, x: float, y: float) -> NDArray[np.float64]:
        """Distances [m] from a point to the boxes, 0 inside, shape (n,)."""
        dx = np.maximum(np.maximum(self.x_lo - x, x - self.x_hi), 0.0)
        dy = np.maximum(np.maximum(self.y_lo - y, y - self.y_hi), 0.0)
        return np.asarray(np.hypot(dx, dy))

    def ask(self, question: Question) -> NDArray[np.bool_]:
        """The answers of ``question`` for every box, shape (n,)."""
        return question(self.x_lo, self.x_hi, self.y_lo, self.y_hi)


class Pyramid:
    """Small boxes, gathered in big ones so that a question is asked of few."""

    def __init__(self, boxes: Boxes):
        self.boxes = boxes
        self._big, self._group = _gathered(boxes)

    def select(self, question: Question) -> NDArray[np.intp]:
        """Indices of the small boxes of which ``question`` may be true.

        ``question`` must be sound: when it is false of a box, it is false of all boxes inside.
        """
        hopeful = np.flatnonzero(self._big.ask(question)[self._group])
        return hopeful[self.boxes.chosen(hopeful).ask(question)]


def _gathered(boxes: Boxes) -> tuple[Boxes, NDArray[np.intp]]:
    """Big boxes that enclose neighbours, and for each small box the number of its big one."""
    if not len(boxes.x_lo):
        return boxes, np.zeros(0, dtype=np.intp)
    side = FACTOR * max(float((boxes.x_hi - boxes.x_lo).max()), 1e-9)
    tall = FACTOR * max(float((boxes.y_hi - boxes.y_lo).max()), 1e-9)
    x, y = boxes.centres
    column = np.floor((x - x.min()) / side).astype(np.int64)
    row = np.floor((y - y.min()) / tall).astype(np.int64)
    _, group = np.unique(row * (int(column.max()) + 1) + column, return_inverse=True)
    count = int(group.max()) + 1
    bounds = [np.full(count, sign * np.inf) for sign in (1.0, -1.0, 1.0, -1.0)]
    np.minimum.at(bounds[0], group, boxes.x_lo)
    np.maximum.at(bounds[1], group, boxes.x_hi)
    np.minimum.at(bounds[2], group, boxes.y_lo)
    np.maximum.at(bounds[3], group, boxes.y_hi)
    return Boxes(*bounds), group
