"""Edges between attitudes: the shortest word that is free."""

from __future__ import annotations

from math import hypot, inf

import numpy as np
from numba import typeof, types
from numba.experimental import structref
from numpy.typing import NDArray

from motion_planner_node.robots.body import Body
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.steering import (
    MOST_PIECES,
    all_words,
    shortest_word,
    tells_shortest,
    words,
)
from motion_planner_node.robots.steering import shortest_length as length_of_shortest
from motion_planner_node.world.shapes import SHAPES_TYPE, Shapes
from motion_planner_node.world.sweeps import word_is_free

#: One attitude (3,), several (n, 3), or pieces (n, 4).
Row = NDArray[np.float64]
Rows = NDArray[np.float64]


@structref.register
class FrameType(types.StructRef):
    """The type of `Frame` in kernels."""


class Frame(structref.StructRefProxy):
    """What edges are made of and checked against; kernels get a reference to it.

    It has room for the words of one edge at a time: it is one thread's.

    shapes: obstacles and bounds of the world.
    body: shape of the robot and the clearance that it keeps.
    steering: number of its steering function, as `robots.steering` has it.
    radius: its turning radius [m].
    words: (w, 5, 4) pieces of all words of the edge that is looked at, lengths: (w,) theirs [m].
    """

    shapes: Shapes
    body: Body
    steering: int
    radius: float
    words: NDArray[np.float64]
    lengths: Row


structref.define_boxing(FrameType, Frame)

_TYPE = FrameType(
    [
        ('shapes', SHAPES_TYPE),
        ('body', typeof(Body(np.zeros((0, 2)), 0.0, 0.0, 0.0))),
        ('steering', types.int64),
        ('radius', types.float64),
        ('words', types.float64[:, :, ::1]),
        ('lengths', types.float64[::1]),
    ]
)


@kernel
def frame_of(shapes: Shapes, body: Body, steering: int, radius: float) -> Frame:
    """The frame of these parts."""
    frame: Frame = structref.new(_TYPE)
    frame.shapes, frame.body, frame.steering, frame.radius = shapes, body, steering, radius
    frame.words = np.zeros((words(steering), MOST_PIECES, 4))
    frame.lengths = np.empty(words(steering))
    return frame


@kernel
def shortest_word_if_free(
    frame: Frame, start: Row, end: Row, longest: float, pieces: Rows
) -> float:
    """Length [m] of the shortest word of less than ``longest`` [m]; infinite where it is not free.

    Unlike `free_word` this looks at no other words: quick where most attempts are in vain.
    ``pieces`` (5, 4) is overwritten.
    """
    here, there = (start[0], start[1], start[2]), (end[0], end[1], end[2])
    length, number = shortest_word(frame.steering, frame.radius, here, there, longest, pieces)
    if number >= 0 and word_is_free(frame.shapes, frame.body, here, pieces):
        return length
    return inf


@kernel
def shortest_length(frame: Frame, start: Row, end: Row, pieces: Rows) -> float:
    """Length [m] of the shortest word, free or not; ``pieces`` (5, 4) is overwritten."""
    here, there = (start[0], start[1], start[2]), (end[0], end[1], end[2])
    return length_of_shortest(frame.steering, frame.radius, here, there, pieces)


@kernel
def free_word(
    frame: Frame, start: Row, end: Row, longest: float, pieces: Rows
) -> tuple[float, int]:
    """Write the shortest free word of less than ``longest`` [m] to ``pieces`` (5, 4).

    Returns its length [m] and number, infinite and -1 when there is none; ``start`` and ``end`` are
    attitudes (3,), the first of them free.
    """
    if not hypot(end[0] - start[0], end[1] - start[1]) < longest:
        return inf, -1
    here, there = (start[0], start[1], start[2]), (end[0], end[1], end[2])
    blocked = -1
    if tells_shortest(frame.steering):
        # Most words that are free are the shortest ones.
        length, blocked = shortest_word(frame.steering, frame.radius, here, there, longest, pieces)
        if blocked < 0 or word_is_free(frame.shapes, frame.body, here, pieces):
            return length, blocked
    rows, lengths = frame.words, frame.lengths
    all_words(frame.steering, frame.radius, here, there, longest, rows, lengths)
    if blocked >= 0:
        lengths[blocked] = inf
    for _ in range(len(lengths)):
        number = int(np.argmin(lengths))
        length = lengths[number]
        if not length < longest:
            break
        if word_is_free(frame.shapes, frame.body, here, rows[number]):
            pieces[:] = rows[number]
            return length, number
        lengths[number] = inf
    return inf, -1


@kernel
def edge_lengths(frame: Frame, path: Rows) -> Row:
    """Lengths [m], shape (n - 1,), of the edges of ``path`` (n, 3), infinite where none is free."""
    lengths, pieces = np.empty(len(path) - 1), np.zeros((MOST_PIECES, 4))
    for i in range(len(lengths)):
        lengths[i] = free_word(frame, path[i], path[i + 1], inf, pieces)[0]
    return lengths
