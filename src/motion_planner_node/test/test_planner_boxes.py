"""Boxes of the map and the bounded memory."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from motion_planner_node.planning.boxes import Boxes, Pyramid
from motion_planner_node.planning.cache import Cache

coordinates = st.floats(-50, 50)


@given(coordinates, coordinates, st.floats(0, 40))
def test_a_pyramid_answers_like_every_single_box(x: float, y: float, radius: float) -> None:
    boxes = Boxes.tiling(-20.0, -10.0, 30.0, 25.0, 23)

    def touched(
        x_lo: NDArray[np.float64],
        x_hi: NDArray[np.float64],
        y_lo: NDArray[np.float64],
        y_hi: NDArray[np.float64],
    ) -> NDArray[np.bool_]:
        return Boxes.of(x_lo, x_hi, y_lo, y_hi).distances(x, y) <= radius

    selected = Pyramid(boxes).select(touched)
    assert selected.tolist() == np.flatnonzero(boxes.ask(touched)).tolist()


@given(coordinates, coordinates)
def test_distances_are_those_to_the_nearest_point(x: float, y: float) -> None:
    boxes = Boxes.of([-5.0], [3.0], [1.0], [4.0])
    nearest = np.clip(x, -5.0, 3.0), np.clip(y, 1.0, 4.0)
    assert boxes.distances(x, y)[0] == pytest.approx(np.hypot(x - nearest[0], y - nearest[1]))


def test_a_tiling_covers_its_rectangle() -> None:
    boxes = Boxes.tiling(0.0, 0.0, 6.0, 3.0, 4)
    area = (boxes.x_hi - boxes.x_lo) * (boxes.y_hi - boxes.y_lo)
    assert area.sum() == pytest.approx(18.0)
    assert (boxes.x_lo.min(), boxes.x_hi.max()) == (0.0, 6.0)
    assert (boxes.y_lo.min(), boxes.y_hi.max()) == (0.0, 3.0)


def test_a_cache_forgets_what_was_used_longest_ago() -> None:
    made: list[str] = []

    def make(name: str) -> str:
        made.append(name)
        return name.upper()

    cache: Cache[str, str] = Cache(2)
    for name in ('a', 'b', 'a', 'c', 'a', 'b'):
        assert cache.get(name, partial(make, name)) == name.upper()
    assert made == ['a', 'b', 'c', 'b']
    assert len(cache) == 2


def test_a_cache_keeps_no_failure() -> None:
    cache: Cache[str, int] = Cache(2)
    with pytest.raises(ZeroDivisionError):
        cache.get('a', lambda: 1 // 0)
    assert cache.get('a', lambda: 7) == 7
