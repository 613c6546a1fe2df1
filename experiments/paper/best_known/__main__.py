"""A long search for the shortest tour of the rover's eight photos, by none of the planner's code.

Each round lays attitudes anew, at random turns: rings of them round each objective from where the
photo can be taken, and others that pass the corners of obstacles closely. All are joined by the
shortest Dubins words that are free; the best tours of the best orders among these are found exactly
(`orders`), and then made shorter with everything free to move (`polishing`).

Run it with ``python -m experiments.paper.best_known``; the best tour so far is kept in
``rover.json`` beside this file whenever it gets shorter.
"""

from __future__ import annotations

import argparse
import itertools
import json
import math
import time
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import numpy as np

from experiments.motion.geometry import Array
from experiments.motion.goals import AGENT, TOWARDS, Goal, Ring
from experiments.motion.grounds import lattice_of
from experiments.motion.lattice import Lattice
from experiments.motion.worlds import ROOT, Place, rover
from experiments.paper.best_known import kept
from experiments.paper.best_known.effort import FULL, QUICK, Effort
from experiments.paper.best_known.polishing import polished
from experiments.paper.best_known.roadmap import (
    Roadmap,
    corner_attitudes,
    make,
    photo_attitudes,
)
from experiments.paper.orders import shortest_tours

#: Figure 3: the distances [m] of a photo, and the heading less the bearing of the objective [rad].
LOW, HIGH, ANGLE = 50.0, 100.0, 0.5 * math.pi
START = 'location0'
#: Lengths that differ by less than this share are the same.
SAME = 1e-9


def goals_of(place: Place) -> dict[str, Goal]:
    """A photo of every object but the one at the start."""
    return {
        label: Goal((Ring(label, at['x'], at['y'], LOW, HIGH),), TOWARDS, ANGLE)
        for label, at in place.objects.items()
        if label != START
    }


def corners_of(place: Place) -> Array:
    """The corners (c, 3) of polygons and the discs of a world: x, y, radius."""
    corners = []
    for obstacle in place.document['obstacles']:
        if 'polygon' in obstacle:
            corners += [(x, y, 0.0) for x, y in obstacle['polygon']]
        else:
            corners.append((*obstacle['circle']['center'], obstacle['circle']['radius']))
    return np.array(corners, float)


def roadmap_of(
    place: Place, lattice: Lattice, random: np.random.Generator, effort: Effort
) -> Roadmap:
    """Attitudes of all photos and between them, joined."""
    at = place.objects[START]
    return make(
        np.array([at['x'], at['y'], 0.0]),
        [photo_attitudes(goal, lattice, random, effort) for goal in goals_of(place).values()],
        corner_attitudes(corners_of(place), lattice, random, effort),
        lattice.ground,
    )


def round_of(
    place: Place, lattice: Lattice, random: np.random.Generator, effort: Effort
) -> tuple[list[Array], list[str], float]:
    """The legs of the shortest tour of one round, the labels that they lead to, and the length [m]."""
    goals = goals_of(place)
    roadmap = roadmap_of(place, lattice, random, effort)
    labels, best = list(goals), (list[Array](), list[str](), math.inf)
    for tour in itertools.islice(shortest_tours(roadmap.costs), effort.orders):
        rings = rings_of(goals[labels[i]] for i in tour.order)
        legs, length = polished(lattice.ground, roadmap.legs(tour), rings, random, effort.moves)
        if length < best[2]:
            best = (legs, [labels[i] for i in tour.order], length)
    return best


def rings_of(goals: Iterable[Goal]) -> Array:
    """Where photos are possible, (k, 5) as `polishing.moved` wants it."""
    rings = [goal.rings[0] for goal in goals]
    return np.array([(ring.x, ring.y, ring.low, ring.high, ANGLE) for ring in rings])


def told(length: float, known: float) -> str:
    """How a tour's length [m] is beside that of the one that is kept."""
    if math.isclose(length, known, rel_tol=SAME):
        return 'the length of the tour that is kept'
    if length < known:
        return 'the shortest so far: kept'
    return f'{length - known:.3f} m longer than the tour that is kept'


def main(arguments: Iterable[str] | None = None) -> None:
    """Search, and keep what is better than what is kept."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--seed', type=int, default=1, help='of the first round (default: 1)')
    parser.add_argument('--rounds', type=int, default=8, help='each with a seed of its own')
    parser.add_argument('--orders', type=int, help=f'made shorter in a round ({FULL.orders})')
    parser.add_argument('--quick', action='store_true', help='few attitudes and moves, to try it')
    parser.add_argument('--file', type=Path, default=kept.FILE, help='where the best is kept')
    wanted = parser.parse_args(None if arguments is None else list(arguments))
    effort = QUICK if wanted.quick else FULL
    effort = replace(effort, orders=wanted.orders or effort.orders)
    place = rover(ROOT / 'out' / 'experiments' / 'motion')
    lattice = lattice_of(place)
    for seed in range(wanted.seed, wanted.seed + wanted.rounds):
        began = time.perf_counter()
        legs, labels, length = round_of(place, lattice, np.random.default_rng(seed), effort)
        known = kept.read(wanted.file)['length'] if wanted.file.exists() else math.inf
        print(
            f'seed {seed}: {length:.3f} m, {time.perf_counter() - began:.0f} s, {told(length, known)}',
            flush=True,
        )
        if length < known and not math.isclose(length, known, rel_tol=SAME):
            document = {
                'made_by': 'python -m experiments.paper.best_known'
                f' --seed {seed} --rounds 1 --orders {effort.orders}{" --quick" * wanted.quick}',
                **kept.plan_of(lattice.ground, legs, labels, place.document['robots'][AGENT]),
            }
            wanted.file.write_text(json.dumps(document, indent=1) + '\n', encoding='utf-8')


if __name__ == '__main__':
    main()
