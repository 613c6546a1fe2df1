"""The best tour that is known, kept as a plan in the format of docs/outputs.md."""

from __future__ import annotations

import itertools
import json
from collections.abc import Mapping, Sequence
from math import inf, remainder, tau
from pathlib import Path
from typing import Any

import numpy as np

from experiments.motion.geometry import Array, Ground, free_word, turn_of

FILE = Path(__file__).resolve().parent / 'rover.json'
#: [m] of a segment that is not worth driving.
NOTHING = 1e-9


def read(path: Path = FILE) -> dict[str, Any]:
    """The plan that is kept."""
    document: dict[str, Any] = json.loads(path.read_text(encoding='utf-8'))
    return document


def plan_of(
    ground: Ground, legs: Sequence[Array], labels: Sequence[str], robot: Mapping[str, Any]
) -> dict[str, Any]:
    """The plan that drives ``legs`` and takes a photo of ``labels[i]`` at the end of leg i."""
    first = _attitude(legs[0][0])
    begin = _step(['!init_rover_attitude', 'rover0', 'location0'], first, first, [])
    steps = [begin | {'assigned': True}]
    for leg, label in zip(legs, labels, strict=True):
        action = ['!take_photo', 'rover0', label, 'cam_0']
        segments = _segments(ground, leg, robot['max_steering_angle'])
        steps.append(_step(action, steps[-1]['end'], _attitude(leg[-1]), segments))
    length = sum(step['length'] for step in steps)
    return {'length': length, 'robots': [{'label': 'rover0', **robot}], 'steps': steps}


def _step(
    action: list[str],
    start: Mapping[str, float],
    end: Mapping[str, float],
    segments: list[list[float]],
) -> dict[str, Any]:
    length = sum(segment[1] for segment in segments)
    return {
        'action': action,
        'agent': 'rover0',
        'objects': [action[2]],
        'start': start,
        'end': end,
        'segments': segments,
        'length': length,
        'assigned': False,
    }


def _segments(ground: Ground, leg: Array, steering: float) -> list[list[float]]:
    """Steering angles [rad] and lengths [m] of the words through the attitudes of a leg."""
    segments: list[list[float]] = []
    pieces = np.empty((6, 3))
    for a, b in itertools.pairwise(leg):
        _, word = free_word(ground, a, b, inf, pieces)
        for k in range(3):
            length, angle = float(pieces[word, k]), steering * turn_of(word, k)
            if length <= NOTHING:
                continue
            if segments and segments[-1][0] == angle:
                segments[-1][1] += length
            else:
                segments.append([angle, length])
    return segments


def _attitude(row: Array) -> dict[str, float]:
    x, y, heading = (float(value) for value in row)
    return {'x': x, 'y': y, 'heading': remainder(heading, tau)}
