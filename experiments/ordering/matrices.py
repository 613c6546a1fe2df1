"""Matrices of tours through photos, and the tours that the local search finds through them.

``ros2_ws/run python -m experiments.ordering.matrices`` writes a file for each number of photos that
`experiments.ordering.libraries` reads: the expected costs [m] between all attitudes, infinite where
there is no way, the photo that each attitude is for (0 is the start), and the tours found here.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from pathlib import Path

import numpy as np

from experiments.paper.beforehand import PHOTO, START
from experiments.paper.photos import write_mission
from motion_planner_node.advice.survey import Survey
from motion_planner_node.language import parse
from motion_planner_node.planning.ground import Ground
from motion_planner_node.planning.problem import read_problem
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.stopping import never
from motion_planner_node.tours.chains import Groups, best_chain
from motion_planner_node.tours.goals import Goal, attitudes
from motion_planner_node.tours.legs import Legs
from motion_planner_node.tours.local_search import LocalSearch
from motion_planner_node.tours.samples import Samples
from motion_planner_node.tours.search import MOST_ATTITUDES, Work
from motion_planner_node.world import Scene
from motion_planner_node.world.reader import read_world

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / 'out' / 'experiments' / 'ordering'
GOALS = (16, 32, 64, 128)
#: Double bridges of the local search.
BRIDGES = (0, 64, 256, 1024)


def groups_of(photos: int, seed: int) -> Groups:
    """The costs of a first tour through random photos, as the motion planner works them out."""
    with tempfile.TemporaryDirectory() as folder:
        text = (write_mission(Path(folder), photos, seed) / 'world.yaml').read_text('utf-8')
    world = read_world(text, 'world.yaml')
    start = Attitude(*START)
    ground = Ground(Scene(world), world.robots['rover0'])
    part = ground.part_of(start)
    goals = []
    for number in range(1, photos + 1):
        preconditions = parse(PHOTO.format(f'location{number}'))
        problem = read_problem(world, preconditions, {'rover0': start})
        states = Survey.of(problem, ground, seed).reach(start, part).states
        goals.append(Goal(problem.program, states[problem.program.satisfied(states)]))
    row = np.array(START)
    most = min(Work.of(0, photos).attitudes, MOST_ATTITUDES // photos)
    rows = attitudes(goals, ground, row[None, :], part, most, never)
    samples = Samples(ground, Legs(ground, seed, never), row, rows, most, never)
    # Only what is there, without the room for more.
    groups = np.repeat(np.arange(photos + 1), samples.count)
    sizes = samples.count
    kept = np.concatenate([f + np.arange(c) for f, c in zip(samples.first, sizes, strict=True)])
    before = np.zeros((photos + 1, photos + 1), np.bool_)
    before[0, 1:] = True
    costs = np.ascontiguousarray(samples.costs[np.ix_(kept, kept)])
    return Groups(costs, np.searchsorted(groups, np.arange(photos + 1)), sizes, before)


def main() -> None:
    """Write the matrices, and print what the local search finds in which time."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--goals', type=int, action='append', help=f'numbers of photos ({GOALS})')
    parser.add_argument('--seed', type=int, default=1, help='of the photos (default: 1)')
    parser.add_argument('--output', type=Path, default=FOLDER, help='folder')
    wanted = parser.parse_args()
    wanted.output.mkdir(parents=True, exist_ok=True)
    for photos in wanted.goals or GOALS:
        groups = groups_of(photos, wanted.seed)
        LocalSearch(groups, never).tour(None, 1, np.random.default_rng(0))
        found = []
        for bridges in BRIDGES:
            began = time.thread_time()
            rng = np.random.default_rng(wanted.seed)
            order = LocalSearch(groups, never).tour(None, bridges, rng)
            found.append((best_chain(groups, order)[0], time.thread_time() - began))
            length, spent = found[-1]
            print(f'{photos} photos, {bridges} bridges: {length:.0f} m, {spent:.2f} s', flush=True)
        np.savez_compressed(
            wanted.output / f'{photos}.npz',
            costs=groups.costs,
            owner=np.repeat(np.arange(photos + 1), groups.sizes),
            found=np.array(found),
        )


if __name__ == '__main__':
    main()
