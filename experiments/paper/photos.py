"""Missions of photos in the paper's manner: its problem in a given order, and random ones of any size."""

from __future__ import annotations

import math
import shutil
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import shapely
import yaml

from experiments.motion.worlds import ROVER
from experiments.paper.lower_bound import outlines

#: Photos of a mission that only warms the nodes up: enough for a tour.
WARM_UP = 3
#: Goals in a world of the paper's size.
PER_TILE = 8
#: An objective is laid where this share of a ring round it is free for a robot with some room.
FREE_SHARE, ROOM, RING, BEARINGS = 0.5, 8.0, 75.0, 24
DIGITS = 1


def problem(labels: Sequence[str], *, in_order: bool = False) -> str:
    """The paper's problem with photos of ``labels``, to be taken in that order or in any."""
    goals = [f'(has_photo_of rover0 {label})' for label in labels]
    tasks = f'(achieve-goals (list {" ".join(goals)}))'
    if in_order:
        achieved = ' '.join(f'(achieve {goal})' for goal in goals)
        tasks = f'(note-goals ({" ".join(goals)})) {achieved}'
    locations = ''.join(f'(location {label})' for label in ('location0', *labels))
    return (
        '(defproblem photos rover\n'
        f'((rover rover0)(available rover0)(camera cam_0)(has_camera rover0 cam_0){locations})\n'
        f'((!init_rover_attitude rover0 location0) {tasks}))\n'
    )


def tiled_world(count: int, seed: int, *, tiles: int = 0) -> dict[str, Any]:
    """A world with ``count`` random objectives among the paper's obstacles.

    The obstacles are laid side by side as often as it takes for eight objectives in each copy, as in
    the paper: the density is the same at every size. ``tiles`` names another number of copies.
    """
    document: dict[str, Any] = yaml.safe_load(ROVER.read_text(encoding='utf-8'))
    width, height = document['bounds'][2:]
    tiles = tiles or math.ceil(count / PER_TILE)
    rows = 2 ** (int(math.log2(tiles)) // 2)
    columns = math.ceil(tiles / rows)
    corners = [(width * i, height * j) for j in range(rows) for i in range(columns)]
    document['bounds'] = [0, 0, width * columns, height * rows]
    document['obstacles'] = [
        _shifted(obstacle, x, y, f'_{k}')
        for k, (x, y) in enumerate(corners)
        for obstacle in document['obstacles']
    ]
    random = np.random.default_rng([seed, count])
    places = _places(document, count, random)
    document['objects'] = {'location0': document['objects']['location0']} | {
        f'location{k}': {'x': x, 'y': y} for k, (x, y) in enumerate(places, 1)
    }
    return document


def write_mission(folder: Path, count: int, seed: int, *, tiles: int = 0) -> Path:
    """Write a mission of ``count`` photos of random objectives, and return its folder."""
    folder.mkdir(parents=True, exist_ok=True)
    world = tiled_world(count, seed, tiles=tiles)
    shutil.copyfile(ROVER.parent / 'domain.lisp', folder / 'domain.lisp')
    labels = [f'location{k}' for k in range(1, count + 1)]
    (folder / 'problem.lisp').write_text(problem(labels), encoding='utf-8')
    (folder / 'world.yaml').write_text(yaml.safe_dump(world, sort_keys=False), encoding='utf-8')
    return folder


def _shifted(obstacle: dict[str, Any], x: float, y: float, suffix: str) -> dict[str, Any]:
    name = obstacle['name'] + suffix
    if 'polygon' in obstacle:
        return {'name': name, 'polygon': [[a + x, b + y] for a, b in obstacle['polygon']]}
    a, b = obstacle['circle']['center']
    return {'name': name, 'circle': {**obstacle['circle'], 'center': [a + x, b + y]}}


def _places(
    document: dict[str, Any], count: int, random: np.random.Generator
) -> Iterable[tuple[float, float]]:
    """Places in the open, and not so near the start that a photo could be taken there."""
    solid = shapely.union_all(outlines(document['obstacles']))
    free = shapely.difference(shapely.box(*document['bounds']), solid).buffer(-ROOM)
    shapely.prepare(free)
    low, high = np.array(document['bounds'][:2]), np.array(document['bounds'][2:])
    start = document['objects']['location0']
    angles = np.linspace(0.0, 2.0 * math.pi, BEARINGS, endpoint=False)
    ring = RING * np.column_stack([np.cos(angles), np.sin(angles)])
    places: list[tuple[float, float]] = []
    while len(places) < count:
        place = random.uniform(low, high).round(DIGITS)
        far = math.hypot(place[0] - start['x'], place[1] - start['y']) > 2.0 * RING
        on_ring = shapely.contains(free, shapely.points(place + ring))
        if far and shapely.contains(free, shapely.Point(place)) and on_ring.mean() >= FREE_SHARE:
            places.append((float(place[0]), float(place[1])))
    return places
