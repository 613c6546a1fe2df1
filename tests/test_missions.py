"""The missions beside the rover's: planned by real nodes, judged by the independent checker."""

from __future__ import annotations

import json
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from shapely import Point

from experiments.paper.missions import FOLDER, MISSIONS, NEAREST, OPTIMISED, QUICK, measure
from experiments.paper.part import Part
from experiments.pictures.office_map import draw_office_floor
from tests.support.checker import Judge, hiding_outline, pose
from tests.support.processes import geohtn

SEED = 1
Actions = list[tuple[str, ...]]


@dataclass(frozen=True)
class Measured:
    """The reduced experiment and the folder that it wrote into."""

    part: Part
    folder: Path

    def plan_file(self, mission: str) -> Path:
        return self.folder / 'missions' / f'{mission}-{SEED}' / 'plan.json'

    def document(self, mission: str) -> dict[str, Any]:
        read: dict[str, Any] = json.loads(self.plan_file(mission).read_text(encoding='utf-8'))
        return read

    def actions(self, mission: str) -> Actions:
        return [tuple(step['action']) for step in self.document(mission)['steps']]

    def judge(self, mission: str) -> Judge:
        return Judge(self.plan_file(mission), FOLDER / mission / 'world.yaml')


@pytest.fixture(scope='module')
def measured(tmp_path_factory: pytest.TempPathFactory) -> Measured:
    folder = tmp_path_factory.mktemp('missions')
    return Measured(measure(QUICK, SEED, folder), folder)


def test_the_experiment_meets_its_targets(measured: Measured) -> None:
    assert [str(target) for target in measured.part.targets if not target.met] == []
    assert len(measured.part.figures['plans']) == len(MISSIONS)
    assert all(f'`{mission}`' in measured.part.text for mission in MISSIONS)
    assert all(path.read_bytes().startswith(b'\x89PNG') for path in measured.part.pictures)
    assert len((measured.folder / 'missions.csv').read_text().splitlines()) == 1 + len(MISSIONS)


def test_backtracks_among_tasks_and_among_destinations_are_told_apart(measured: Measured) -> None:
    for told in measured.part.figures['plans']:
        counts = measured.document(told['mission'])['statistics']
        for name in ('backtracks', 'geometric_backtracks'):
            assert told[name] == counts[name]


def test_orders_that_facts_restrict_are_short(measured: Measured) -> None:
    """Nearest first knows nothing of what follows, optimising little that the first plan did not know."""
    for mission, others in measured.part.figures['lengths'].items():
        assert measured.document(mission)['length'] <= 1.2 * min(others[OPTIMISED])
    nearest = min(measured.part.figures['lengths']['samples'][NEAREST])
    assert measured.document('samples')['length'] < 0.95 * nearest


@pytest.mark.parametrize('mission', MISSIONS)
def test_the_same_seed_gives_the_same_plan(
    measured: Measured, nodes: str, tmp_path: Path, mission: str
) -> None:
    again = plan(nodes, FOLDER / mission, tmp_path)
    assert again['steps'] == measured.document(mission)['steps']


def plan(nodes: str, mission: Path, output: Path) -> dict[str, Any]:
    done = geohtn(
        'plan',
        mission,
        '--namespace',
        nodes,
        '--wait',
        '60',
        '--seed',
        str(SEED),
        '--output',
        output,
    )
    assert (output / 'plan.json').exists(), done.stderr
    read: dict[str, Any] = json.loads((output / 'plan.json').read_text(encoding='utf-8'))
    return read


def test_the_round_sees_everything_and_respects_the_alarm(measured: Measured) -> None:
    actions = measured.actions('office')
    assert actions[0][0] == '!leave_charger'
    assert actions[-1][0] == '!charge'
    seen = [action[2] for action in actions if action[0] in {'!read_gauge', '!check_extinguisher'}]
    problem = (FOLDER / 'office' / 'problem.lisp').read_text(encoding='utf-8')
    assert len(seen) == len(set(seen)) == problem.count('(gauge ') + problem.count('(extinguisher ')
    armed = True
    for name, _robot, thing, *_ in actions:
        armed = (armed or name == '!arm') and name != '!disarm'
        assert not (armed and thing in {'gauge_cooling', 'extinguisher_server'})
    assert armed


def test_the_guards_cover_each_other(measured: Measured) -> None:
    actions = measured.actions('guards')
    checks = [index for index, action in enumerate(actions) if action[0] == '!check_gate']
    assert len({actions[index][2] for index in checks}) == len(checks) == 5
    for index in checks:
        assert actions[index - 1][:3] == ('!cover', 'car', actions[index][2])
    names = [action[:3] for action in actions]
    vault = names.index(('!check_gate', 'walker', 'vault'))
    assert names.index(('!fetch_key', 'walker', 'key_box')) < vault
    assert names.index(('!return_key', 'walker', 'key_box')) > vault
    assert actions[-1][0] == '!stand_beside'
    models = {robot['model'] for robot in measured.document('guards')['robots']}
    assert models == {'car', 'omnidirectional'}


def test_cameras_store_and_memory_of_the_sampling_rover(measured: Measured) -> None:
    calibrated: set[str] = set()
    store: dict[str, str] = {}
    delivered: set[str] = set()
    received: set[tuple[str, ...]] = set()
    memory: list[tuple[str, ...]] = []
    for name, _rover, *rest in measured.actions('samples'):
        if name == '!calibrate':
            calibrated.add(rest[0])
        elif name == '!take_image':
            calibrated.remove(rest[2])
            assert not memory, 'an image was taken before the last one was sent'
            memory.append(tuple(rest[:2]))
        elif name == '!send':
            received.add(memory.pop())
            assert tuple(rest[:2]) in received
        elif name == '!collect':
            assert rest[1] not in store, 'two samples in one compartment'
            store[rest[1]] = rest[0]
        elif name == '!deliver':
            assert store.pop(rest[0]) == rest[1]
            delivered.add(rest[1])
    assert delivered == {'basalt', 'clay', 'sulfate', 'dust'}
    assert received == {('cliff', 'colour'), ('crater', 'colour'), ('dune', 'infrared')}
    assert not store
    assert not memory


def test_the_checker_would_find_something(measured: Measured) -> None:
    """What the rover's mission has none of: a view that is hidden, a robot in the way."""
    for mission, action, fault in (
        ('office', '!read_gauge', 'visible'),
        ('samples', '!send', 'visible'),
        ('guards', '!check_gate', 'from car'),
    ):
        judge = measured.judge(mission)
        assert judge.complaints() == []
        step = next(step for step in judge.plan['steps'] if step['action'][0] == action)
        if mission == 'guards':
            # The car is put where the walker goes.
            before = judge.plan['steps'][: judge.plan['steps'].index(step)]
            [*_, cover] = [one for one in before if one['agent'] == 'car']
            cover['end'] = step['end']
            assert any(fault in complaint for complaint in judge.complaints())
            continue
        target = judge.objects[step['action'][-1 if action == '!send' else 2]]
        x, y, _ = pose(step['end'])
        middle = Point((x + target['x']) / 2, (y + target['y']) / 2).buffer(0.05)
        judge.asked.world['obstacles'].append(hiding_outline(middle))
        assert any(fault in complaint for complaint in judge.complaints())


@pytest.mark.parametrize(
    ('mission', 'file', 'old', 'new', 'words'),
    [
        (
            'office',
            'world.yaml',
            '  - name: plant',
            '  - {name: crate, polygon: [[18.5, 5], [20, 5], [20, 5.6], [18.5, 5.6]]}\n  - name: plant',
            ['gauge_cooling is walled in', 'crate'],
        ),
        ('samples', 'problem.lisp', '(on_board infrared_camera rover)', '', ['infrared']),
        ('guards', 'world.yaml', 'vault: {', 'valut: {', ['vault', 'valut']),
    ],
)
def test_what_is_broken_is_told(
    nodes: str, tmp_path: Path, mission: str, file: str, old: str, new: str, words: list[str]
) -> None:
    folder = tmp_path / mission
    shutil.copytree(FOLDER / mission, folder)
    text = (folder / file).read_text(encoding='utf-8')
    assert old in text
    (folder / file).write_text(text.replace(old, new), encoding='utf-8')
    done = geohtn(
        'plan', folder, '--namespace', nodes, '--wait', '60', '--output', tmp_path / 'out'
    )
    assert done.returncode == 2, done.stderr
    assert all(word in done.stdout + done.stderr for word in words)


def test_the_shipped_map_is_the_one_that_the_script_draws(tmp_path: Path) -> None:
    draw_office_floor().write(tmp_path, 'office')
    for name in ('office.png', 'office.yaml'):
        assert (tmp_path / name).read_bytes() == (FOLDER / 'office' / name).read_bytes()


def test_all_missions_are_installed() -> None:
    listed = geohtn('missions').stdout
    assert all(mission in listed for mission in (*MISSIONS, 'rover'))
