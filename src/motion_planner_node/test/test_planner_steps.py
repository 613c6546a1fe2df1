"""Bounds of ways by chains of cells, beside ways that are drawn at random."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from motion_planner_node.planning.steps import steps_from

SIZE = 12


def numbered(visited: NDArray[np.bool_]) -> NDArray[np.int32]:
    """Open where a cell is visited, with a closed frame."""
    numbers = np.full((SIZE + 2, SIZE + 2), -1, np.int32)
    numbers[1:-1, 1:-1][visited] = np.arange(np.count_nonzero(visited))
    return numbers


@settings(max_examples=200, deadline=None)
@given(st.integers(0, 2**32 - 1), st.floats(0.02, 2.0), st.integers(1, 60))
def test_no_way_through_its_own_cells_is_shorter(seed: int, stride: float, count: int) -> None:
    """The fewest open cells that a way can have are those that it visits."""
    random = np.random.default_rng(seed)
    moves = random.normal(0.0, stride, (count, 2))
    corners = np.clip(random.uniform(0.0, SIZE, 2) + np.cumsum(moves, axis=0), 0.0, SIZE - 1e-9)
    if seed % 3 == 0:
        corners = np.round(corners).clip(0.0, SIZE - 1.0)
    length = float(np.hypot(*np.diff(corners, axis=0).T).sum())
    shares = np.linspace(0.0, 1.0, 200)[:, None, None]
    along = corners[:-1] + shares * np.diff(corners, axis=0)
    points = np.concatenate([corners, along.reshape(-1, 2)])
    visited = np.zeros((SIZE, SIZE), np.bool_)
    columns, rows = np.floor(points).astype(int).T
    visited[rows, columns] = True
    numbers = numbered(visited)
    (i, j), (a, b) = np.floor(corners[0]).astype(int), np.floor(corners[-1]).astype(int)
    steps = steps_from(numbers, int(j) + 1, int(i) + 1)
    assert steps[numbers[b + 1, a + 1]] - 1 <= length + 1e-9


def test_chains_go_round_closed_cells_and_over_corners() -> None:
    visited = np.ones((SIZE, SIZE), np.bool_)
    visited[1:, 5] = False
    numbers = numbered(visited)
    steps = steps_from(numbers, 12, 4)
    assert steps[numbers[12, 4]] == 0
    assert steps[numbers[11, 3]] == 1
    # Up to the only gap in the wall and down again on its other side.
    assert steps[numbers[12, 8]] == 22
    assert steps_from(numbers, 12, 6).tolist() == [0] * np.count_nonzero(visited)
