"""Chains of cells next to each other: a bound of the length of every way through the free space."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel


@kernel
def steps_from(numbers: NDArray[np.int32], row: int, column: int) -> NDArray[np.int32]:
    """The fewest steps from one cell to each of the open ones, by their ``numbers``, shape (n,).

    ``numbers`` (rows, columns) are -1 where cells are closed, as all on the rim are. A step leads to
    one of the eight cells around; 0 where no chain leads.

    A piece of a curve that is no longer than the side of a cell is in two rows and two columns at
    most, so its ends are a step apart at most: a curve through open cells that ends k steps away is
    at least k - 1 sides long, whatever it looks like. That holds of no other weight of the steps
    across corners: along a row of corners the straight line takes one every side.
    """
    columns = numbers.shape[1]
    steps = np.zeros(numbers.max() + 1, np.int32)
    queue = np.empty(len(steps), np.int32)
    seen = (numbers < 0).copy()
    if seen[row, column]:
        return steps
    seen[row, column] = True
    queue[0], count, at = row * columns + column, 1, 0
    while at < count:
        j, i = queue[at] // columns, queue[at] % columns
        at += 1
        farther = steps[numbers[j, i]] + 1
        for b in range(j - 1, j + 2):
            for a in range(i - 1, i + 2):
                if not seen[b, a]:
                    seen[b, a] = True
                    steps[numbers[b, a]] = farther
                    queue[count] = b * columns + a
                    count += 1
    return steps
