"""Where to put labels so that they hide as little as possible."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

#: Directions from its anchor in which a label may stand, the favourite first.
DIRECTIONS = ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, 1), (1, -1), (-1, -1))
#: Gaps between anchor and label, the favourite first.
GAPS = (1.0, 1.8, 2.8)
#: What it costs to cover one crowding point, another label or the edge.
POINT_COST, LABEL_COST, EDGE_COST = 1.0, 60.0, 500.0


def place_labels(
    anchors: Sequence[tuple[float, float]],
    sizes: Sequence[tuple[float, float]],
    gap: float,
    crowd: NDArray[np.float64],
    frame: tuple[float, float, float, float],
) -> list[tuple[float, float]]:
    """Centres of the labels, one by one where each covers least; all in pixels.

    ``sizes`` are widths and heights, ``gap`` is the room between an anchor and its label,
    ``crowd`` of shape (n, 2) holds points that should stay visible, ``frame`` is x_min, y_min,
    x_max, y_max that labels have to stay inside.
    """
    boxes: list[tuple[float, float, float, float]] = []
    centers = []
    for (x, y), (width, height) in zip(anchors, sizes, strict=True):
        best, best_cost = (x, y), np.inf
        for rank, (stretch, (right, up)) in enumerate(
            (stretch, direction) for stretch in GAPS for direction in DIRECTIONS
        ):
            # Diagonal neighbours come closer, so that the gap looks the same all round.
            reach = gap * stretch * (0.7 if right and up else 1.0)
            center = (x + right * (reach + width / 2), y + up * (reach + height / 2))
            box = (
                center[0] - width / 2,
                center[1] - height / 2,
                center[0] + width / 2,
                center[1] + height / 2,
            )
            cost = 0.01 * rank + _cost(box, boxes, crowd, frame)
            if cost < best_cost:
                best, best_cost = center, cost
        centers.append(best)
        (x, y), half_width, half_height = best, width / 2, height / 2
        boxes.append((x - half_width, y - half_height, x + half_width, y + half_height))
    return centers


def _cost(
    box: tuple[float, float, float, float],
    others: Sequence[tuple[float, float, float, float]],
    crowd: NDArray[np.float64],
    frame: tuple[float, float, float, float],
) -> float:
    left, low, right, high = box
    x, y = crowd[:, 0], crowd[:, 1]
    covered = float(np.sum((x > left) & (x < right) & (y > low) & (y < high)))
    overlapping = sum(
        left < other[2] and right > other[0] and low < other[3] and high > other[1]
        for other in others
    )
    outside = left < frame[0] or low < frame[1] or right > frame[2] or high > frame[3]
    return POINT_COST * covered + LABEL_COST * overlapping + EDGE_COST * outside
