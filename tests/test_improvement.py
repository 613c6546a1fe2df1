"""Plans that become shorter while one waits, over real processes: told, written, drawn and judged."""

from __future__ import annotations

import json
import re
import shutil
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import matplotlib.image
import numpy as np
import pytest

from interface_node.picture.progress import LINE
from interface_node.recording.message_conversions import read_messages
from tests.support.checker import Judge
from tests.support.missions import ROVER, Run
from tests.support.processes import geohtn

#: Things that are near enough to each other to be seen in passing.
DOMAIN = """
(defdomain look (
(Operator (!look ?r ?t)
  ((thing ?t))
  ((agent ?r)(object ?t)(distance(?r, ?t) <= 30))
  ((seen ?t)))
(:method (look-at-all ?_ nil) () ())
(:method (look-at-all ?r (?t . ?others)) () (:unordered (!look ?r ?t) (look-at-all ?r ?others)))
))
"""
THINGS = (
    *((24, 33), (31, 102), (53, 181), (88, 74), (165, 64)),
    *((165, 19), (158, 184), (50, 120), (173, 110), (140, 105)),
)


def passing(folder: Path) -> Path:
    """A mission on whose way things are seen that a first plan goes to one by one."""
    folder.mkdir()
    names = [f'thing{number}' for number in range(len(THINGS))]
    facts = ' '.join(f'(thing {name})' for name in names)
    objects = ''.join(
        f'  {name}: {{x: {x}, y: {y}}}\n' for name, (x, y) in zip(names, THINGS, strict=True)
    )
    (folder / 'domain.lisp').write_text(DOMAIN, encoding='utf-8')
    problem = f'(defproblem all look ({facts}) ((look-at-all r ({" ".join(names)}))))'
    (folder / 'problem.lisp').write_text(problem, encoding='utf-8')
    robot = (
        '{model: car, wheelbase: 2, max_steering_angle: 0.5, radius: 1, speed: 2,'
        ' start: {x: 20, y: 20, heading: 0}}'
    )
    world = f'bounds: [0, 0, 200, 200]\nobjects:\n{objects}obstacles: []\nrobots:\n  r: {robot}\n'
    (folder / 'world.yaml').write_text(world, encoding='utf-8')
    return folder


def two_photos(folder: Path) -> Path:
    """The paper's mission with two photos: few enough to be searched to the end."""
    shutil.copytree(ROVER, folder)
    problem = folder / 'problem.lisp'
    text = problem.read_text(encoding='utf-8')
    text = re.sub(r'\(has_photo_of rover0 location[3-8]\)', '', text)
    problem.write_text(text, encoding='utf-8')
    return folder


MISSIONS = {'opportunities': (passing, ()), 'optimised': (two_photos, ('--optimise',))}


@dataclass(frozen=True)
class Improved:
    """What was left behind, and the plan that was written."""

    run: Run
    mission: Path

    @property
    def plan(self) -> dict[str, Any]:
        read: dict[str, Any] = json.loads((self.run.output / 'plan.json').read_text('utf-8'))
        return read


@pytest.fixture(scope='module', params=MISSIONS)
def improved(
    request: pytest.FixtureRequest, nodes: str, tmp_path_factory: pytest.TempPathFactory
) -> Improved:
    """Each mission, planned once."""
    write, options = MISSIONS[request.param]
    folder = tmp_path_factory.mktemp(request.param)
    mission, output = write(folder / 'mission'), folder / 'out'
    common = ('--namespace', nodes, '--wait', '60', '--seed', '1', '--output', output)
    done = geohtn('plan', mission, *common, *options)
    assert done.returncode == 0, done.stderr
    return Improved(Run(output, done.stdout, done.stderr, done.returncode), mission)


def test_the_better_plan_is_written(improved: Improved) -> None:
    plan = improved.plan
    lengths = [told['length'] for told in plan['improvements']]
    assert len(lengths) > 1
    assert all(after < before for before, after in pairwise(lengths))
    assert plan['length'] == pytest.approx(lengths[-1])
    assert plan['length'] == pytest.approx(sum(step['length'] for step in plan['steps']))
    assert plan['statistics']['improvements'] == len(lengths) - 1
    by_the_way = plan['statistics']['opportunities']
    assert (by_the_way > 0) == (improved.mission.parent.name.startswith('opportunities'))
    world = improved.mission / 'world.yaml'
    assert Judge(improved.run.output / 'plan.json', world).complaints() == []


def test_each_better_length_is_told(improved: Improved) -> None:
    lengths = [told['length'] for told in improved.plan['improvements']]
    recorded = [
        item.message
        for item in read_messages(improved.run.output / 'mission.mcap')
        if item.topic == '/mission/progress'
    ]
    assert [progress.best_length for progress in recorded] == lengths
    assert all(progress.improved for progress in recorded)
    told = re.findall(r'best ([\d.]+) m', improved.run.stderr)
    assert set(told) <= {f'{length:.1f}' for length in lengths}
    assert told == sorted(told, key=float, reverse=True)
    assert told[-1] == f'{lengths[-1]:.1f}'


def pixels_of_curve(picture: Path) -> int:
    """Pixels in the colour of the curve above the map, where nothing else has it."""
    pixels = np.asarray(matplotlib.image.imread(picture))[:, :, :3]
    colour = np.array([int(LINE[i : i + 2], 16) for i in (1, 3, 5)]) / 255.0
    above = pixels[: len(pixels) // 8]
    return int((np.abs(above - colour).max(axis=2) < 0.01).sum())


def test_the_curve_is_in_the_picture(improved: Improved, rover_run: Run) -> None:
    assert pixels_of_curve(improved.run.output / 'mission.png') > 50
    # Whose first plan is the best.
    assert pixels_of_curve(rover_run.output / 'mission.png') == 0
