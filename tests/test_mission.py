"""The paper's mission over three real processes, judged by an independent checker."""

from __future__ import annotations

import json
import re

from shapely import Point

from tests.support.checker import Judge
from tests.support.missions import ROVER, Run

PNG_MAGIC = b'\x89PNG\r\n\x1a\n'


def judge(run: Run) -> Judge:
    return Judge(run.output / 'plan.json', ROVER / 'world.yaml')


def test_the_mission_is_solved(rover_run: Run) -> None:
    assert rover_run.exit_code == 0, rover_run.stderr
    plan = json.loads((rover_run.output / 'plan.json').read_text(encoding='utf-8'))
    assert plan['outcome'] == 'SOLVED'
    actions = [step['action'] for step in plan['steps']]
    assert actions[0] == ['!init_rover_attitude', 'rover0', 'location0']
    photographed = sorted(action[2] for action in actions[1:])
    assert photographed == [f'location{k}' for k in range(1, 9)]
    assert {(action[0], action[1], action[3]) for action in actions[1:]} == {
        ('!take_photo', 'rover0', 'cam_0')
    }


def test_an_independent_checker_finds_nothing_wrong(rover_run: Run) -> None:
    assert judge(rover_run).complaints() == []


def test_the_checker_would_find_something(rover_run: Run) -> None:
    """Each fault that is put into the plan is seen by the checker."""

    def spoilt(change: str) -> Judge:
        judged = judge(rover_run)
        steps = judged.plan['steps']
        if change == 'turned':
            steps[-1]['end']['heading'] += 1e-4
        elif change == 'moved':
            steps[-1]['end']['x'] += 1e-4
        elif change == 'shortened':
            steps[3]['segments'][0][1] -= 1e-4
        elif change == 'swerving':
            steps[3]['segments'][0][0] *= 1.5
        elif change == 'blocked':
            middle = steps[3]['start']
            judged.obstacles['new'] = Point(middle['x'], middle['y']).buffer(1.0)
        return judged

    for change in ('turned', 'moved', 'shortened', 'swerving', 'blocked'):
        assert spoilt(change).complaints(), change


def test_the_same_seed_gives_the_same_plan(rover_run: Run, second_rover_run: Run) -> None:
    first, second = (
        json.loads((run.output / 'plan.json').read_text(encoding='utf-8'))
        for run in (rover_run, second_rover_run)
    )
    assert first['steps'] == second['steps']
    counts = ('requests', 'answers', 'advices', 'backtracks')
    assert [first['statistics'][key] for key in counts] == [
        second['statistics'][key] for key in counts
    ]


def test_the_printed_plan_is_the_papers(rover_run: Run) -> None:
    printed = re.findall(r'\(!\w+(?: \w+)*\)', rover_run.stdout)
    plan = json.loads((rover_run.output / 'plan.json').read_text(encoding='utf-8'))
    assert 'SOLUTION PLAN' in rover_run.stdout
    assert printed == [f'({" ".join(step["action"])})' for step in plan['steps']]


def test_what_is_left_behind(rover_run: Run) -> None:
    assert (rover_run.output / 'mission.png').read_bytes().startswith(PNG_MAGIC)
    assert (rover_run.output / 'mission.mcap').read_bytes().startswith(b'\x89MCAP0\r\n')
    statistics = json.loads((rover_run.output / 'plan.json').read_text())['statistics']
    assert statistics['requests'] == statistics['answers'] >= 9
    assert statistics['advices'] >= 1
