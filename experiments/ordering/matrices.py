"""Matrices of tours through photos: the expected costs between all attitudes, before a leg is planned."""

from __future__ import annotations

import tempfile
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
from motion_planner_node.tours.chains import Groups
from motion_planner_node.tours.goals import Goal, attitudes
from motion_planner_node.tours.legs import Legs
from motion_planner_node.tours.precedences import from_start, next_to
from motion_planner_node.tours.samples import Samples
from motion_planner_node.tours.search import MOST_ATTITUDES, Work
from motion_planner_node.world import Scene
from motion_planner_node.world.reader import read_world


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
    before = from_start(np.zeros((photos, photos), np.bool_))
    samples = Samples(ground, Legs(ground, seed, never), row, rows, most, next_to(before), never)
    # Only what is there, without the room for more.
    groups = np.repeat(np.arange(photos + 1), samples.count)
    sizes = samples.count
    kept = np.concatenate([f + np.arange(c) for f, c in zip(samples.first, sizes, strict=True)])
    costs = np.ascontiguousarray(samples.costs[np.ix_(kept, kept)])
    return Groups(costs, np.searchsorted(groups, np.arange(photos + 1)), sizes, before)
