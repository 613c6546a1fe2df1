"""The example domains: small ones against plans found by hand, larger ones re-executed by rules written here."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from task_planner_node.errors import Severity
from task_planner_node.language import load_source, problem_names
from task_planner_node.language.model import show
from task_planner_node.mission import MissionText, check_and_compile, read_mission
from task_planner_node.oracle import Oracle
from task_planner_node.outcomes import Options, Outcome
from task_planner_node.planner import Planner

DOMAINS = Path(__file__).parents[1] / 'domains'
TOYS = sorted((DOMAINS / 'toys').glob('*.lisp'))
EXPECTED = re.compile(r'^;; plan (\S+): (.*)$', re.MULTILINE)
CASES = [(toy, name, plan) for toy in TOYS for name, plan in EXPECTED.findall(toy.read_text())]
Actions = list[tuple[str, ...]]


@pytest.fixture(scope='module')
def solve(no_motion_planner: Oracle) -> Callable[[Path, Path, str], Actions | None]:
    """The actions of a plan, None when it is proven that there is none."""

    def run(domain: Path, problem: Path, name: str = '') -> Actions | None:
        planner = Planner(no_motion_planner, Options())
        chosen = f'{problem}#{name}' if name else str(problem)
        result = planner.plan(MissionText(str(domain)), MissionText(chosen))
        assert result.outcome in (Outcome.SOLVED, Outcome.NO_PLAN), result.explanation
        if result.outcome == Outcome.NO_PLAN:
            return None
        return [tuple(map(show, step.action)) for step in result.steps]

    return run


Solve = Callable[..., Actions | None]


@pytest.mark.parametrize(('toy', 'name', 'plan'), CASES, ids=[f'{t.stem}-{n}' for t, n, _ in CASES])
def test_a_toy_has_the_plan_that_was_found_by_hand(
    solve: Solve, toy: Path, name: str, plan: str
) -> None:
    actions = solve(toy, toy, name)
    if plan == 'none':
        assert actions is None
    else:
        assert actions is not None
        wanted = re.sub(r'\(!![^()]*(\([^()]*\)[^()]*)*\) ', '', plan)
        assert ' '.join(f'({" ".join(action)})' for action in actions) == wanted


@pytest.mark.parametrize('toy', TOYS, ids=lambda toy: toy.stem)
def test_every_problem_of_a_toy_has_a_plan_in_its_comment(toy: Path) -> None:
    names = problem_names(load_source('toy', str(toy)))
    assert [name for path, name, _ in CASES if path == toy] == names


@pytest.mark.parametrize(
    'folder', sorted(path.name for path in DOMAINS.iterdir() if path.name != 'toys')
)
def test_a_domain_is_read_without_a_warning(folder: str, no_motion_planner: Oracle) -> None:
    (domain,) = (DOMAINS / folder).glob('domain.*')
    (problem,) = (DOMAINS / folder).glob('problem.*')
    pair = read_mission(MissionText(str(domain)), MissionText(str(problem)))
    mission = check_and_compile(*pair, no_motion_planner)
    assert [r for r in mission.warnings if r.severity == Severity.WARNING] == []


def example(solve: Solve, folder: str, kind: str = 'lisp') -> Actions:
    actions = solve(DOMAINS / folder / f'domain.{kind}', DOMAINS / folder / f'problem.{kind}')
    assert actions is not None
    return actions


def test_blocks_end_as_wanted(solve: Solve) -> None:
    under = {'a': 'b', 'b': 'c', 'c': 'table', 'e': 'd', 'd': 'table'}
    held = ''
    for name, block, *below in example(solve, 'blocks'):
        if name in ('!pick-up', '!unstack'):
            assert not held
            assert block not in under.values()
            assert under.pop(block) == (below[0] if below else 'table')
            held = block
        else:
            assert held == block
            place = below[0] if below else 'table'
            assert place == 'table' or (place in under and place not in under.values())
            under[block], held = place, ''
    assert under == {'c': 'b', 'b': 'a', 'a': 'd', 'd': 'table', 'e': 'table'}


def test_packages_arrive(solve: Solve) -> None:
    city = {'post-1': 'lyon', 'air-1': 'lyon', 'post-2': 'nice', 'air-2': 'nice'}
    at = {'truck-1': 'air-1', 'truck-2': 'post-2', 'plane-1': 'air-2'}
    at |= {'letter': 'post-1', 'parcel': 'post-1', 'crate': 'air-2'}
    for name, what, *rest in example(solve, 'logistics'):
        if name == '!drive':
            assert city[rest[0]] == city[rest[1]]
        if name in ('!drive', '!fly'):
            assert at[what] == rest[0]
            at[what] = rest[1]
        elif name == '!load':
            assert at[what] == at[rest[0]] == rest[1]
            at[what] = rest[0]
        else:
            assert at[what] == rest[0]
            assert at[rest[0]] == rest[1]
            at[what] = rest[1]
    assert [at[each] for each in ('letter', 'parcel', 'crate')] == ['post-2', 'air-1', 'post-1']


def test_rovers_send_everything(solve: Solve) -> None:
    at = {'driller': 1, 'looker': 4}
    full = False
    results: dict[str, set[str]] = {'driller': set(), 'looker': set()}
    received = set()
    for name, rover, *rest in example(solve, 'rovers'):
        if name == '!navigate':
            assert rest[0] == f'p{at[rover]}'
            assert abs(int(rest[1][1:]) - at[rover]) == 1
            at[rover] = int(rest[1][1:])
        elif name == '!sample':
            assert not full
            assert rest[0] == f'p{at[rover]}'
            full = True
            results[rover].add(f'(soil-of {rest[0]})')
        elif name == '!empty-store':
            full = False
        elif name == '!take-image':
            assert at[rover] in (1, 3)
            results[rover].add('(image-of crater colour)')
        else:
            assert at[rover] == 2
            assert rest[0] in results[rover]
            received.add(rest[0])
    assert received == {'(soil-of p1)', '(soil-of p3)', '(image-of crater colour)'}


def test_satellites_take_every_image(solve: Solve) -> None:
    pointing, active, calibrated, images = 'sun', '', '', set()
    target = {'infrared': 'sun', 'lens': 'vega'}
    for name, *rest in example(solve, 'satellites'):
        if name == '!turn':
            assert rest[1] == pointing
            pointing = rest[2]
        elif name == '!switch-on':
            assert not active
            active, calibrated = rest[0], ''
        elif name == '!switch-off':
            assert active == rest[0]
            active = ''
        elif name == '!calibrate':
            assert active == rest[0]
            assert pointing == target[active]
            calibrated = active
        else:
            assert active == calibrated == rest[2]
            assert pointing == rest[1]
            images.add((rest[1], rest[3]))
    assert images == {('mars', 'thermal'), ('mars', 'visible'), ('vega', 'spectral')}


ROADS = {('depot', 'mill'), ('mill', 'farm'), ('mill', 'quay')}


def test_parcels_arrive_in_order(solve: Solve) -> None:
    lorry, load = 'depot', ''
    at = {'book': 'farm', 'lamp': 'quay'}
    delivered = []
    for name, *rest in example(solve, 'parcels', 'hddl'):
        if name == '!drive':
            assert rest[1] == lorry
            assert (rest[1], rest[2]) in ROADS or (rest[2], rest[1]) in ROADS
            lorry = rest[2]
        elif name == '!load':
            assert not load
            assert at[rest[1]] == lorry
            load = rest[1]
        elif name == '!unload':
            assert load == rest[1]
            at[load], load = lorry, ''
            delivered.append(rest[1])
    assert at == {'book': 'quay', 'lamp': 'depot'}
    assert delivered == ['book', 'lamp']


def before(actions: Sequence[tuple[str, ...]], first: str, later: str) -> bool:
    names = [' '.join(action) for action in actions]
    return names.index(first) < names.index(later)


def test_breakfast_keeps_its_partial_order(solve: Solve) -> None:
    actions = example(solve, 'kitchen', 'hddl')
    assert len(actions) == 7
    for first, later in (
        ('!heat kettle', '!brew mint'),
        ('!heat pan', '!fry egg'),
        ('!fetch egg', '!slice egg'),
        ('!slice egg', '!fry egg'),
        ('!heat kettle', '!lay_table'),
        ('!heat pan', '!lay_table'),
        ('!lay_table', '!brew mint'),
        ('!lay_table', '!fry egg'),
    ):
        assert before(actions, first, later)
