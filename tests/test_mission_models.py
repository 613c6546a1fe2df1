"""The paper's mission with other robots, over three real processes, judged by the checker."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from tests.support.checker import Judge
from tests.support.missions import ROVER, run_mission

STEERING = """\
    model: car
    wheelbase: 8.0
    max_steering_angle: 0.5
    radius: 5.0
"""
VARIANTS = {
    'differential': """\
    model: differential
    turning_speed: 0.5
    footprint: [[-5, -4], [5, -4], [8, 0], [5, 4], [-5, 4]]
    safety_margin: 0.5
""",
    'reverse_car': """\
    model: reverse_car
    wheelbase: 8.0
    max_steering_angle: 0.5
    footprint: [[-2, -3], [10, -3], [10, 3], [-2, 3]]
    safety_margin: 0.5
""",
}


@pytest.mark.parametrize('model', VARIANTS)
def test_the_mission_of_another_robot_is_driven_without_a_fault(tmp_path: Path, model: str) -> None:
    mission = tmp_path / 'mission'
    shutil.copytree(ROVER, mission)
    world = mission / 'world.yaml'
    text = world.read_text(encoding='utf-8')
    robots = '\n'.join(line.split('#')[0].rstrip() for line in text.splitlines()) + '\n'
    assert STEERING in robots
    world.write_text(robots.replace(STEERING, VARIANTS[model]), encoding='utf-8')
    run = run_mission(mission, tmp_path / 'out')
    assert run.exit_code == 0, run.stderr
    plan = json.loads((run.output / 'plan.json').read_text(encoding='utf-8'))
    assert plan['robot']['model'] == model
    assert Judge(run.output / 'plan.json', world).complaints() == []
    segments = [segment for step in plan['steps'] for segment in step['segments']]
    if model == 'differential':
        assert any(len(segment) == 4 for segment in segments)
    assert all(step['clearance'] >= 0.5 - 1e-6 for step in plan['steps'] if step['segments'])
    assert plan['duration'] > plan['length'] / plan['robot']['speed'] - 1e-6
