"""Buckets over edges and discs: what is near a place, without looking at all the rest.

Square buckets cover the bounds.  Each lists the edges and discs that reach into it, so that a
question about a place looks at the buckets round it alone, however many obstacles there are.
"""

from __future__ import annotations

from math import ceil, floor, isfinite, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel

#: Buckets per edge or disc, and how many there are at least and at most.
BUCKETS_PER_ITEM = 4
FEWEST_BUCKETS = 256
MOST_BUCKETS = 1 << 20
#: The most buckets in a row or a column.
LONGEST_ROW = 4096
#: Columns of ``buckets``.
FIRST, LAST, SKIP, COVER = range(4)
#: Values of COVER: in no polygon; crossed by one's outline; wholly inside a polygon or a disc.
OPEN, CROSSED, COVERED = range(3)
#: What an item may be away from a bucket that lists it, as a share of the bucket's side.
_SLACK = 1e-6


class Index(NamedTuple):
    """Buckets from the corner of a rectangle on, and what is in them.

    frame: (3,) x, y of the corner and side of a bucket [m].
    buckets: (rows, columns, 4) where the bucket's part of ``items`` begins and ends, how many
        buckets away the nearest one with an item is, and one of OPEN, CROSSED, COVERED.
    items: numbers of edges, then of discs counted on from the edges.
    row_starts: (rows + 1,) where the part of ``row_edges`` of each row of buckets begins.
    row_edges: numbers of the edges of polygons that reach into a row, wherever in it.
    """

    frame: NDArray[np.float64]
    buckets: NDArray[np.int32]
    items: NDArray[np.int32]
    row_starts: NDArray[np.int64]
    row_edges: NDArray[np.int32]


@kernel
def _row_range(frame: NDArray[np.float64], rows: int, low: float, high: float) -> tuple[int, int]:
    """First and last row that reach from y ``low`` to ``high`` [m]; none when first > last."""
    slack = _SLACK * frame[2]
    first = floor((low - slack - frame[1]) / frame[2])
    last = floor((high + slack - frame[1]) / frame[2])
    return int(max(first, 0)), int(min(last, rows - 1))


@kernel
def _column_range(
    frame: NDArray[np.float64], columns: int, low: float, high: float
) -> tuple[int, int]:
    slack = _SLACK * frame[2]
    first = floor((low - slack - frame[0]) / frame[2])
    last = floor((high + slack - frame[0]) / frame[2])
    return int(max(first, 0)), int(min(last, columns - 1))


@kernel
def _span(
    frame: NDArray[np.float64], row: int, x0: float, y0: float, x1: float, y1: float
) -> tuple[float, float]:
    """Least and greatest x of the part of an edge that is in a row of buckets."""
    if y1 == y0:
        return min(x0, x1), max(x0, x1)
    slack = _SLACK * frame[2]
    low = frame[1] + row * frame[2] - slack
    high = frame[1] + (row + 1) * frame[2] + slack
    a = min(max((low - y0) / (y1 - y0), 0.0), 1.0)
    b = min(max((high - y0) / (y1 - y0), 0.0), 1.0)
    xa, xb = x0 + a * (x1 - x0), x0 + b * (x1 - x0)
    return min(xa, xb), max(xa, xb)


@kernel
def _list_items(
    frame: NDArray[np.float64],
    buckets: NDArray[np.int32],
    edges: NDArray[np.float64],
    discs: NDArray[np.float64],
    items: NDArray[np.int32],
) -> int:
    """Count the items of each bucket in LAST or, when ``items`` is not empty, write them there."""
    rows, columns, _ = buckets.shape
    listed = 0
    for item in range(len(edges) + len(discs)):
        disc = item - len(edges)
        if disc < 0:
            x0, y0, x1, y1 = edges[item, 0], edges[item, 1], edges[item, 2], edges[item, 3]
            first, last = _row_range(frame, rows, min(y0, y1), max(y0, y1))
        else:
            x0, y0, radius = discs[disc, 0], discs[disc, 1], discs[disc, 2]
            first, last = _row_range(frame, rows, y0 - radius, y0 + radius)
        for j in range(first, last + 1):
            if disc < 0:
                low, high = _span(frame, j, x0, y0, x1, y1)
            else:
                low, high = x0 - radius, x0 + radius
            left, right = _column_range(frame, columns, low, high)
            for i in range(left, right + 1):
                if disc >= 0 and not _meets_circle(frame, j, i, x0, y0, radius):
                    continue
                if len(items):
                    items[buckets[j, i, LAST]] = item
                buckets[j, i, LAST] += 1
                listed += 1
    return listed


@kernel
def _meets_circle(
    frame: NDArray[np.float64], row: int, column: int, x: float, y: float, radius: float
) -> bool:
    """Whether the boundary of a disc may reach into a bucket."""
    half = 0.5 * frame[2]
    dx = abs(frame[0] + (column + 0.5) * frame[2] - x)
    dy = abs(frame[1] + (row + 0.5) * frame[2] - y)
    slack = _SLACK * frame[2]
    near_x, near_y = max(dx - half, 0.0), max(dy - half, 0.0)
    far_x, far_y = dx + half, dy + half
    near, far = sqrt(near_x * near_x + near_y * near_y), sqrt(far_x * far_x + far_y * far_y)
    return bool(near <= radius + slack and far >= radius - slack)


@kernel
def _fill_skips(buckets: NDArray[np.int32]) -> None:
    """Chebyshev distances to the nearest bucket with an item, by two passes over the grid."""
    rows, columns, _ = buckets.shape
    for j in range(rows):
        for i in range(columns):
            skip = rows + columns if buckets[j, i, FIRST] == buckets[j, i, LAST] else 0
            if i > 0:
                skip = min(skip, buckets[j, i - 1, SKIP] + 1)
            if j > 0:
                for a in range(max(i - 1, 0), min(i + 2, columns)):
                    skip = min(skip, buckets[j - 1, a, SKIP] + 1)
            buckets[j, i, SKIP] = skip
    for j in range(rows - 1, -1, -1):
        for i in range(columns - 1, -1, -1):
            skip = buckets[j, i, SKIP]
            if i + 1 < columns:
                skip = min(skip, buckets[j, i + 1, SKIP] + 1)
            if j + 1 < rows:
                for a in range(max(i - 1, 0), min(i + 2, columns)):
                    skip = min(skip, buckets[j + 1, a, SKIP] + 1)
            buckets[j, i, SKIP] = skip


@kernel
def _list_rows(
    frame: NDArray[np.float64],
    rows: int,
    edges: NDArray[np.float64],
    counts: NDArray[np.int64],
    row_edges: NDArray[np.int32],
) -> None:
    """Count the edges in each row or, when ``row_edges`` is not empty, write them there."""
    for edge in range(len(edges)):
        y0, y1 = edges[edge, 1], edges[edge, 3]
        first, last = _row_range(frame, rows, min(y0, y1), max(y0, y1))
        for j in range(first, last + 1):
            if len(row_edges):
                row_edges[counts[j]] = edge
            counts[j] += 1


@kernel
def _mark_discs(
    frame: NDArray[np.float64], buckets: NDArray[np.int32], discs: NDArray[np.float64]
) -> None:
    """Mark the buckets that are wholly inside a disc."""
    rows, columns, _ = buckets.shape
    half = 0.5 * frame[2]
    for disc in range(len(discs)):
        x, y, radius = discs[disc, 0], discs[disc, 1], discs[disc, 2]
        first, last = _row_range(frame, rows, y - radius, y + radius)
        left, right = _column_range(frame, columns, x - radius, x + radius)
        for j in range(first, last + 1):
            for i in range(left, right + 1):
                dx = abs(frame[0] + (i + 0.5) * frame[2] - x) + half
                dy = abs(frame[1] + (j + 0.5) * frame[2] - y) + half
                if sqrt(dx * dx + dy * dy) < radius:
                    buckets[j, i, COVER] = COVERED


@kernel
def _mark_polygons(
    frame: NDArray[np.float64],
    buckets: NDArray[np.int32],
    items: NDArray[np.int32],
    row_starts: NDArray[np.int64],
    row_edges: NDArray[np.int32],
    edges: NDArray[np.float64],
    first_edge: NDArray[np.int64],
) -> None:
    """Mark the buckets that an outline crosses, and those wholly inside a polygon."""
    rows, columns, _ = buckets.shape
    inside = np.zeros(columns, np.bool_)
    for j in range(rows):
        y = frame[1] + (j + 0.5) * frame[2]
        at = row_starts[j]
        while at < row_starts[j + 1]:
            polygon = int(np.searchsorted(first_edge, row_edges[at], 'right')) - 1
            first, last = first_edge[polygon], first_edge[polygon + 1]
            inside[:] = False
            while at < row_starts[j + 1] and row_edges[at] < last:
                edge = row_edges[at]
                at += 1
                x0, y0, x1, y1 = edges[edge, 0], edges[edge, 1], edges[edge, 2], edges[edge, 3]
                if (y0 > y) != (y1 > y):
                    crossing = x0 + (y - y0) * (x1 - x0) / (y1 - y0)
                    last_left = floor((crossing - frame[0]) / frame[2] - 0.5)
                    for i in range(int(min(max(last_left + 1, 0), columns))):
                        inside[i] = not inside[i]
            for i in range(columns):
                if inside[i]:
                    crossed = False
                    for k in range(buckets[j, i, FIRST], buckets[j, i, LAST]):
                        crossed = crossed or first <= items[k] < last
                    if not crossed:
                        buckets[j, i, COVER] = COVERED
        for i in range(columns):
            if buckets[j, i, COVER] != COVERED:
                for k in range(buckets[j, i, FIRST], buckets[j, i, LAST]):
                    if items[k] < first_edge[-1]:
                        buckets[j, i, COVER] = CROSSED


def _grid(box: NDArray[np.float64], items: int) -> tuple[NDArray[np.float64], int, int]:
    """Corner and side [m] of the buckets over a rectangle, and how many rows and columns."""
    low, high = (box[:2], box[2:]) if np.isfinite(box).all() else (np.zeros(2), np.ones(2))
    width, height = (max(float(side), 1e-3) for side in high - low)
    number = min(max(BUCKETS_PER_ITEM * items, FEWEST_BUCKETS), MOST_BUCKETS)
    size = max(sqrt(width * height / number), max(width, height) / LONGEST_ROW)
    return np.array([low[0], low[1], size]), ceil(height / size), ceil(width / size)


def index_of(
    bounds: NDArray[np.float64],
    edges: NDArray[np.float64],
    first_edge: NDArray[np.int64],
    discs: NDArray[np.float64],
) -> Index:
    """The index over ``edges`` (e, 4) and ``discs`` (d, 3) inside ``bounds`` (4,), all in metres.

    The edges of polygon p are those from ``first_edge[p]`` to ``first_edge[p + 1]``; edges after
    the last of them belong to no polygon.  Without finite bounds everything is inside.
    """
    box = bounds
    if not all(isfinite(value) for value in bounds):
        points = np.concatenate([edges[:, :2], edges[:, 2:], discs[:, :2]])
        reach = np.concatenate([np.zeros(2 * len(edges)), discs[:, 2]])[:, None]
        empty = np.full((1, 2), np.inf)
        low = np.min(np.concatenate([points - reach, empty]), axis=0)
        box = np.concatenate([low, np.max(np.concatenate([points + reach, -empty]), axis=0)])
    frame, rows, columns = _grid(box, len(edges) + len(discs))
    buckets = np.zeros((rows, columns, 4), np.int32)
    nothing = np.zeros(0, np.int32)
    items = np.empty(_list_items(frame, buckets, edges, discs, nothing), np.int32)
    ends = np.cumsum(buckets[..., LAST]).reshape(rows, columns)
    buckets[..., FIRST] = buckets[..., LAST] = ends - buckets[..., LAST]
    if len(items):
        _list_items(frame, buckets, edges, discs, items)
    _fill_skips(buckets)
    outlines = edges[: first_edge[-1]]
    counts = np.zeros(rows, np.int64)
    _list_rows(frame, rows, outlines, counts, nothing)
    row_starts = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
    row_edges = np.empty(row_starts[-1], np.int32)
    if len(row_edges):
        _list_rows(frame, rows, outlines, row_starts[:-1].copy(), row_edges)
    _mark_discs(frame, buckets, discs)
    _mark_polygons(frame, buckets, items, row_starts, row_edges, edges, first_edge)
    return Index(frame, buckets, items, row_starts, row_edges)


@kernel
def bucket_at(
    frame: NDArray[np.float64], buckets: NDArray[np.int32], x: float, y: float
) -> tuple[int, int, float]:
    """Row and column of the bucket at (x, y), or the nearest one, and how far its rim is [m].

    The distance to the rim is one that a step out of the bucket has at least.
    """
    rows, columns, _ = buckets.shape
    along, across = (x - frame[0]) / frame[2], (y - frame[1]) / frame[2]
    column = min(max(floor(along), 0), columns - 1)
    row = min(max(floor(across), 0), rows - 1)
    along = min(max(along - column, 0.0), 1.0)
    across = min(max(across - row, 0.0), 1.0)
    rim = min(across, 1.0 - across, along, 1.0 - along) * frame[2]
    return int(row), int(column), rim


@kernel
def empty_radius(
    frame: NDArray[np.float64], buckets: NDArray[np.int32], x: float, y: float
) -> float:
    """A distance [m] from (x, y) within which there is surely neither an edge nor a disc's rim."""
    row, column, rim = bucket_at(frame, buckets, x, y)
    skip = buckets[row, column, SKIP]
    return 0.0 if skip == 0 else (skip - 1) * frame[2] + rim
