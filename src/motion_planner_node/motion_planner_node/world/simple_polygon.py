"""Whether a polygon encloses an area and does not cross or touch itself."""

from __future__ import annotations

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


def crossing_edges(corners: Corners) -> tuple[int, int] | None:
    """Two edges (i begins at corner i) that meet where they should not; None when simple."""
    following = np.roll(corners, -1, axis=0)
    count = len(corners)
    for i in range(count - 1):
        a, b = corners[i], following[i]
        c, d = corners[i + 1 :], following[i + 1 :]
        side_c, side_d = _side(a, b, c), _side(a, b, d)
        side_a, side_b = _side(c, d, a), _side(c, d, b)
        meet = (side_c * side_d < 0) & (side_a * side_b < 0)
        meet |= (side_c == 0) & _between(a, b, c)
        meet |= (side_d == 0) & _between(a, b, d)
        meet |= (side_a == 0) & _between(c, d, a)
        meet |= (side_b == 0) & _between(c, d, b)
        meet[0] = side_d[0] == 0 and np.dot(b - a, d[0] - b) < 0
        if i == 0:
            meet[-1] = side_c[-1] == 0 and np.dot(b - a, a - c[-1]) < 0
        if meet.any():
            return i, i + 1 + int(np.argmax(meet))
    return None
