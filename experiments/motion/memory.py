"""Whether the motion planner's memory grows with the number of requests.

``python -m experiments.motion.memory WORLD.yaml REQUESTS EARLY`` prints one line of JSON; `measure` runs
it in a process of its own, so that nothing else is counted.
"""

from __future__ import annotations

import gc
import json
import subprocess
import sys
from collections.abc import Iterator
from math import pi
from pathlib import Path
from typing import Any

import numpy as np

from experiments.motion.worlds import ROOT, Place
from motion_planner_node.planner import MotionPlanner, warm_up
from motion_planner_node.requests import AdviceRequest, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world import read_world
from motion_planner_node.world.model import World

#: What is asked, of a robot and an object: some places are easy, some hard, some impossible.
TEXTS = (
    '((agent {0})(object {1})(distance({0}, {1}) <= {2}))',
    (
        '((agent {0})(object {1})(distance({0}, {1}) >= {2})(distance({0}, {1}) <= 2 * {2})'
        '(rel_angle({0}, {1}) = cos-and-sin(pi/2)))'
    ),
    '((agent {0})(object {1})(distance({0}, {1}) = {2})({0}.heading = pi/2))',
    '((agent {0})(object {1})(distance({0}, {1}) <= -{2}))',
)
#: Every so many requests one for advice on all objects comes between.
ADVICE_EVERY = 50
#: The size [share of the map's shorter side] of distances that are asked for.
SHARE = 0.1


def measure(place: Place, requests: int = 10_000, early: int = 1_000) -> dict[str, Any]:
    """Resident memory [MB] after ``early`` requests and after all ``requests``, all different."""
    done = subprocess.run(
        [sys.executable, '-m', __spec__.name, str(place.write()), str(requests), str(early)],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        check=True,
        text=True,
    )
    figures: dict[str, Any] = json.loads(done.stdout)
    return figures


def grown(planner: MotionPlanner, requests: int, early: int) -> dict[str, Any]:
    """Ask ``requests`` different requests; see `measure`."""
    after: dict[int, float] = {}
    for number, request in enumerate(_requests(planner.world, requests), 1):
        planner.satisfy(request)
        if number % ADVICE_EVERY == 0:
            robot = next(iter(planner.world.robots))
            texts = tuple(TEXTS[0].format(robot, label, 20.0) for label in planner.world.objects)
            planner.advise(AdviceRequest(texts, request.start, seed=number))
        if number in (early, requests):
            gc.collect()
            after[number] = resident()
    return {
        'requests': requests,
        'early': early,
        'early_mb': after[early],
        'late_mb': after[requests],
        'growth_mb': after[requests] - after[early],
    }


def resident() -> float:
    """Resident memory [MB] of this process."""
    for line in Path('/proc/self/status').read_text(encoding='utf-8').splitlines():
        if line.startswith('VmRSS:'):
            return int(line.split()[1]) / 1024.0
    raise OSError('/proc/self/status tells no resident memory')


def _requests(world: World, count: int) -> Iterator[GeometricRequest]:
    rng = np.random.default_rng(7)
    robot, labels, bounds = next(iter(world.robots)), list(world.objects), world.bounds
    side = SHARE * min(bounds.x_max - bounds.x_min, bounds.y_max - bounds.y_min)
    for number in range(count):
        text = TEXTS[int(rng.integers(len(TEXTS)))]
        label = labels[int(rng.integers(len(labels)))]
        distance = float(np.round(side * rng.uniform(0.5, 1.5), 3))
        start = Attitude(
            float(rng.uniform(bounds.x_min, bounds.x_max)),
            float(rng.uniform(bounds.y_min, bounds.y_max)),
            float(rng.uniform(-pi, pi)),
        )
        yield GeometricRequest(
            text.format(robot, label, distance),
            {robot: start},
            alternative=int(rng.integers(3)),
            seed=number,
        )


def main(path: str, requests: str, early: str) -> None:
    """Print the figures of one world as JSON."""
    warm_up()
    planner = MotionPlanner(read_world(Path(path).read_text(encoding='utf-8'), path))
    planner.prepare()
    print(json.dumps(grown(planner, int(requests), int(early))))


if __name__ == '__main__':
    main(*sys.argv[1:])
