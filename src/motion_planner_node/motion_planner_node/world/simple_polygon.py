"""Whether a polygon encloses an area and does not cross or touch itself."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Corners = NDArray[np.float64]

#: Areas [m^2] below this count as none.
SMALLEST_AREA = 1e-9


def area(corners: Corners) -> float:
    """Area [m^2] enclosed by ``corners`` (n, 2), positive when they go round to the left."""
    x, y = (corners - corners[0]).T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def _side(a: Corners, b: Corners, c: Corners) -> NDArray[np.float64]:
    """1 where c is on the left of the line from a to b, -1 on its right, 0 on it."""
    left = (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1])
    right = (b[..., 1] - a[..., 1]) * (c[..., 0] - a[..., 0])
    doubt = 4e-16 * (np.abs(left) + np.abs(right))
    return np.where(np.abs(left - right) <= doubt, 0.0, np.sign(left - right))


def _between(a: Corners, b: Corners, c: Corners) -> NDArray[np.bool_]:
    """Whether c, known to be on the line through a and b, is between them."""
    within = (np.minimum(a, b) <= c) & (c <= np.maximum(a, b))
    return np.asarray(within.all(axis=-1))


def _meet(a: Corners, b: Corners, c: Corners, d: Corners) -> NDArray[np.bool_]:
    """Which of the edges from ``c`` to ``d`` (n, 2) have a point of the edge from a to b."""
    side_c, side_d = _side(a, b, c), _side(a, b, d)
    side_a, side_b = _side(c, d, a), _side(c, d, b)
    meet = (side_c * side_d < 0) & (side_a * side_b < 0)
    meet |= (side_c == 0) & _between(a, b, c)
    meet |= (side_d == 0) & _between(a, b, d)
    meet |= (side_a == 0) & _between(c, d, a)
    return np.asarray(meet | ((side_b == 0) & _between(c, d, b)))


def _goes_back(a: Corners, b: Corners, c: Corners) -> bool:
    """Whether the edge from b to c lies on that from a to b."""
    return bool(_side(a, b, c) == 0 and np.dot(b - a, c - b) < 0)


def crossing_edges(corners: Corners) -> tuple[int, int] | None:
    """Two edges (i begins at corner i) that meet where they should not; None when simple."""
    following = np.roll(corners, -1, axis=0)
    count = len(corners)
    for i in range(count - 1):
        a, b = corners[i], following[i]
        meet = _meet(a, b, corners[i + 1 :], following[i + 1 :])
        # Neighbours have a corner in common.
        meet[0] = _goes_back(a, b, following[i + 1])
        if i == 0:
            meet[-1] = _goes_back(corners[-1], a, b)
        if meet.any():
            return i, i + 1 + int(np.argmax(meet))
    return None


def meeting(rings: Sequence[Corners]) -> NDArray[np.bool_]:
    """Which polygons (n, n) have a point of their outlines in common, each two told once: i < k."""
    result = np.zeros((len(rings), len(rings)), np.bool_)
    ends = np.concatenate([np.roll(ring, -1, axis=0) for ring in rings])
    begins = np.concatenate(list(rings))
    owner = np.repeat(np.arange(len(rings)), [len(ring) for ring in rings])
    for i in range(len(begins)):
        later = int(np.searchsorted(owner, owner[i], 'right'))
        meet = _meet(begins[i], ends[i], begins[later:], ends[later:])
        result[owner[i], owner[later:][meet]] = True
    return result


def encloses(corners: Corners, points: Corners) -> NDArray[np.bool_]:
    """Which ``points`` (n, 2) are inside a simple polygon; on its outline either answer can come."""
    (x0, y0), (x1, y1) = corners.T[..., None], np.roll(corners, -1, axis=0).T[..., None]
    x, y = points.T
    with np.errstate(divide='ignore', invalid='ignore'):
        is_left = x < x0 + (y - y0) * (x1 - x0) / (y1 - y0)
    crossed = ((y0 > y) != (y1 > y)) & is_left
    return np.asarray(np.count_nonzero(crossed, axis=0) % 2 == 1)
