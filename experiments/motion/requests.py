"""Random requests: where the car stands, and what is asked of the attitude where it shall stand."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from experiments.motion.goals import FIXED, FREE, TOWARDS, Array, Goal, Ring
from experiments.motion.lattice import Lattice
from experiments.motion.worlds import Place

#: Attitudes of a goal that are looked at, and those that are kept as ends for shots.
SAMPLED, KEPT = 400, 64
#: Digits after the point of all random numbers, so that texts are readable.
DECIMALS = 4
KINDS = ('photo', 'near', 'dock', 'look', 'two', 'heading')


@dataclass(frozen=True)
class Request:
    """A start (3,), a goal and free samples (k, 3) of it."""

    number: int
    kind: str
    start: Array
    goal: Goal
    samples: Array


def draw(place: Place, lattice: Lattice, seed: int, number: int) -> Request:
    """Request ``number`` of a seed: the same whatever others are drawn."""
    random = np.random.default_rng([seed, number])
    kind = KINDS[number % len(KINDS)]
    start = _free_start(place, lattice, random)
    while True:
        goal = _goal(place, kind, random)
        samples = goal.sample(random, SAMPLED)
        samples = samples[lattice.is_free(samples)][:KEPT]
        if len(samples):
            return Request(number, kind, start, goal, samples)


def _free_start(place: Place, lattice: Lattice, random: np.random.Generator) -> Array:
    x_min, y_min, x_max, y_max = place.bounds
    while True:
        start = random.uniform([x_min, y_min, -3.14], [x_max, y_max, 3.14]).round(DECIMALS)
        if lattice.is_free(start[None])[0]:
            return start


def _goal(place: Place, kind: str, random: np.random.Generator) -> Goal:
    radius = place.turning_radius
    labels = list(place.objects)

    def ring(label: str, low: float, high: float) -> Ring:
        fields = place.objects[label]
        return Ring(label, float(fields['x']), float(fields['y']), low, high)

    one, other = (labels[k] for k in random.permutation(len(labels))[:2])
    low, more = (random.uniform(0.5, 4.0, 2) * radius).round(DECIMALS).tolist()
    high = round(low + more, DECIMALS)
    angle = round(float(random.uniform(-math.pi, math.pi)), DECIMALS)
    if kind == 'photo':
        right = float(random.choice([0.5 * math.pi, -0.5 * math.pi, angle]))
        return Goal((ring(one, low, high),), TOWARDS, right)
    if kind == 'near':
        return Goal((ring(one, 0.0, low),), FREE)
    if kind == 'dock':
        return Goal((ring(one, 0.0, round(0.05 * low, DECIMALS)),), FIXED, angle)
    if kind == 'look':
        width = round(float(random.uniform(0.1, 0.5)), DECIMALS)
        return Goal((ring(one, low, high),), TOWARDS, 0.0, width)
    if kind == 'two':
        far = round(3.0 * high, DECIMALS)
        return Goal((ring(one, 0.0, far), ring(other, 0.0, far)), TOWARDS, angle)
    return Goal((ring(one, low, high),), FIXED, angle)
