from __future__ import annotations

from math import pi
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic, MotionPlannerError
from motion_planner_node.world import read_world
from motion_planner_node.world.model import Bounds, Circle, Polygon

ROVER = (
    Path(__file__).parents[2] / 'interface_node' / 'missions' / 'rover' / 'world.yaml'
).read_text()

WORLD = """\
bounds: [0, 0, 80, 60]
objects:
  tree: {x: 10, y: 20, height: 3.5}
  rock: {x: 70, y: 50}
obstacles:
  - {name: wall, polygon: [[30, 0], [32, 0], [32, 20], [30, 20]]}
  - {circle: {center: [50, 40], radius: 4}}
robots:
  rover: {model: car, wheelbase: 1, max_steering_angle: 0.5, radius: 1, speed: 2,
          start: {x: 5, y: 5, heading: 7}}
"""


def faults(text: str) -> tuple[Diagnostic, ...]:
    with pytest.raises(MotionPlannerError) as caught:
        read_world(text, 'world.yaml')
    assert caught.value.code is Code.NO_WORLD
    assert caught.value.diagnostics
    for diagnostic in caught.value.diagnostics:
        assert diagnostic.code is Code.NO_WORLD
        assert diagnostic.source == 'world.yaml'
    return caught.value.diagnostics


def test_a_world_is_read() -> None:
    world = read_world(WORLD, 'world.yaml')
    assert world.source == 'world.yaml'
    assert world.bounds == Bounds(0, 0, 80, 60)
    assert world.objects['tree'].fields == {'x': 10.0, 'y': 20.0, 'height': 3.5}
    assert world.obstacles == (
        Polygon('wall', ((30, 0), (32, 0), (32, 20), (30, 20))),
        Circle('obstacle2', (50, 40), 4),
    )
    rover = world.robots['rover']
    assert rover.turning_radius == pytest.approx(1.8305, abs=1e-4)
    assert rover.start is not None
    assert rover.start.heading == pytest.approx(7 - 2 * pi)


def test_the_world_of_the_mission_is_read() -> None:
    world = read_world(ROVER, 'rover/world.yaml')
    assert len(world.objects) == 9
    assert len(world.obstacles) >= 10
    assert world.robots['rover0'].start is None


def test_parts_may_be_missing_or_empty() -> None:
    for rest in ('', 'objects:\nobstacles:\nrobots:\n', 'objects: {}\nobstacles: []\n'):
        world = read_world('bounds: [0, 0, 1, 1]\n' + rest, '')
        assert (world.objects, world.obstacles, world.robots) == ({}, (), {})


def test_revision_is_of_the_content_alone() -> None:
    revision = read_world(WORLD, 'a').revision
    assert len(revision) == 16
    assert int(revision, 16) >= 0
    for same in (
        '# a remark\n' + WORLD,
        WORLD.replace('10,', '1.0e1,'),
        WORLD.replace('{x: 70, y: 50}', '{y: 50.0, x: 70}'),
        WORLD.replace('[0, 0, 80', '[-0.0, 0, 80'),
    ):
        assert read_world(same, 'b').revision == revision
    for other in (
        WORLD.replace('x: 70', 'x: 70.0000001'),
        WORLD.replace('rock', 'stone'),
        WORLD.replace('speed: 2', 'speed: 3'),
        WORLD.replace('radius: 4', 'radius: 5'),
    ):
        assert read_world(other, 'a').revision != revision


@pytest.mark.parametrize(
    ('old', 'new', 'place', 'words'),
    [
        ('bounds: [0, 0, 80, 60]\n', '', (1, 1), 'lacks bounds'),
        ('[0, 0, 80, 60]', '[0, 0, 80]', (1, 9), '[x_min, y_min, x_max, y_max]'),
        ('[0, 0, 80, 60]', '[0, 0, 0, 60]', (1, 9), 'no area: 0 m by 60 m'),
        ('[0, 0, 80, 60]', '[80, 0, 0, 60]', (1, 9), 'no area: -80 m by 60 m'),
        ('[0, 0, 80, 60]', '', (1, 8), 'bounds are empty'),
        ('80', '.nan', (1, 16), 'has to be finite, not .nan'),
        ('80', '-.INF', (1, 16), 'has to be finite'),
        ('80', '1e999', (1, 16), 'beyond 1e+07'),
        ('80', '"80"', (1, 16), 'not the text "80"'),
        ('80', 'yes', (1, 16), 'not the truth value yes'),
        ('80', '080', (1, 16), 'has to be a number, not 080'),
        ('objects:', 'objekts:', (2, 1), 'did you mean objects?'),
        ('tree', 'pi', (3, 3), 'cannot be called pi'),
        ('tree', 'big tree', (3, 3), 'cannot be called "big tree"'),
        ('tree', 'tree-1', (3, 3), 'a hyphen only before a letter'),
        ('rock', 'tree', (4, 3), 'is there already, in line 3'),
        ('rock', 'rover', (9, 3), 'name of an object, too'),
        ('{x: 70, y: 50}', '{x: 70}', (4, 9), 'rock lacks y'),
        ('{x: 70, y: 50}', '[70, 50]', (4, 9), 'keys and values, not a list of 2'),
        ('{x: 70, y: 50}', '{x: 70, y: 61}', (4, 9), 'at (70, 61), outside the bounds'),
        ('height', 'he-ight', (3, 24), 'cannot have a field'),
        ('[[30, 0], [32, 0], [32, 20], [30, 20]]', '[[30, 0], [32, 0]]', (6, 27), '3 corners'),
        ('[32, 20], [30, 20]', '[31, 0], [31.5, 0]', (6, 27), 'encloses no area'),
        ('[32, 0], [32, 20]', '[32, 20], [32, 5]', (6, 27), 'crosses or touches itself'),
        ('[32, 0]', '[30, 0]', (6, 37), 'corner 2 repeats'),
        ('[32, 0]', '[32, zero]', (6, 42), 'corner 2: y has to be a number, not zero'),
        ('name: wall', 'nam: wall', (6, 6), 'did you mean name?'),
        ('name: wall', 'name: [wall]', (6, 12), 'a text of one line'),
        ('- {circle', '- {name: wall, circle', (7, 12), 'taken by the obstacle in line 6'),
        ('- {circle', '- {polygon: [], circle', (7, 5), 'either polygon or circle'),
        ('radius: 4', 'radius: -4', (7, 41), 'at least 0.001, not -4'),
        ('radius: 4', 'radios: 4', (7, 14), 'lacks radius'),
        ('model: car', 'model: boat', (9, 18), 'model boat is not known; there are car'),
        ('wheelbase: 1', 'wheelbase: 0', (9, 34), 'at least 0.001'),
        ('max_steering_angle: 0.5', 'max_steering_angle: 1.6', (9, 57), 'less than pi/2'),
        ('wheelbase: 1', 'wheelbase: 100000', (9, 10), 'turning radius'),
        ('radius: 1,', 'radius: -1,', (9, 70), 'at least 0, not -1'),
        ('speed: 2', 'speed: 0', (9, 80), 'at least 0.001'),
        (', speed: 2', '', (9, 10), 'rover, a robot of model car, lacks speed'),
        ('heading: 7', 'heading: .inf', (10, 40), 'has to be finite'),
        (', heading: 7', '', (10, 18), 'lacks heading'),
        ('x: 5, y: 5', 'x: 29.5, y: 5', (10, 18), '0.500 m from wall: less than its radius of 1 m'),
        ('x: 5, y: 5', 'x: 0.25, y: 5', (10, 18), "0.250 m from the map's edge"),
        ('[0, 0, 80, 60]', '&b [0, 0, 80, 60]', (1, 9), 'anchors and aliases'),
        ('[0, 0, 80, 60]', '*b', (1, 9), 'anchors and aliases'),
        ('80', '!!float 80', (1, 16), 'tags'),
        ('80', '\x07', (1, 16), 'U+0007'),
        ('80', '\udcff', (1, 16), 'U+DCFF'),
        ('[0, 0, 80, 60]', '[' * 100, (1, 25), 'nested more than 16'),
        ('[0, 0, 80, 60]', '[0, 0, 80, 60', (2, 8), 'not YAML'),
        ('robots:', '---\nrobots:', (8, 1), 'a second document'),
    ],
)
def test_a_fault_is_told_with_its_place(
    old: str, new: str, place: tuple[int, int], words: str
) -> None:
    assert old in WORLD
    found = faults(WORLD.replace(old, new, 1))
    assert (found[0].line, found[0].column) == place, [str(d) for d in found]
    assert words in found[0].message


def test_all_faults_are_told_at_once_in_their_order() -> None:
    text = WORLD
    for old, new in (('70', 'x'), ('radius: 4', 'radius: 0'), ('car', 'cart'), ('80', 'nan')):
        text = text.replace(old, new, 1)
    assert [d.line for d in faults(text)] == [1, 4, 7, 9]
    many = 'bounds: [0, 0, 1, 1]\nobjects:\n' + ''.join(f'  o{i}: 1\n' for i in range(300))
    found = faults(many)
    assert len(found) == 101
    assert found[-1].message == 'and 200 more faults'


@pytest.mark.parametrize(
    'text',
    [
        '',
        '# only a remark\n',
        'a: &a [x, x]\nb: &b [*a, *a]\nc: [*b, *b]\n',
        '[' * 100_000,
        '{a: ' * 100_000,
        '- ' * 100_000,
        '? ' * 100_000,
        'x' * (1 << 21),
        '\x00' * 1000,
        'bounds: [0, 0, 1, 1]\nobstacles: [' + '7, ' * 10_001 + ']',
        '"' * 100_000,
    ],
    ids=lambda text: repr(text[:12]),
)
def test_a_hostile_text_is_refused(text: str) -> None:
    assert all(d.line >= 1 and d.column >= 1 for d in faults(text)[:1])


pieces = st.sampled_from(
    [*WORLD, *WORLD.split(), '&a', '*a', '!t', '- ', ': ', '[', '{', '"', '|', '%', '\t', '\x00']
)
texts = st.one_of(
    st.text(max_size=200),
    st.binary(max_size=200).map(lambda data: data.decode('utf-8', 'surrogateescape')),
    st.lists(pieces, max_size=40).map(' '.join),
    st.builds(
        lambda at, piece: WORLD[:at] + piece + WORLD[at + 1 :],
        st.integers(0, len(WORLD)),
        pieces,
    ),
)


@settings(max_examples=400, deadline=None)
@given(texts)
def test_any_text_is_a_world_or_an_error(text: str) -> None:
    try:
        assert read_world(text, 'fuzz.yaml').revision
    except MotionPlannerError as error:
        found = error
    else:
        return
    assert found.code is Code.NO_WORLD
    assert found.diagnostics[0].line >= 1
    assert found.diagnostics[0].column >= 1


REGIONS = """\
regions:
  - {name: dock, polygon: [[60, 0], [80, 0], [80, 15], [60, 15]]}
  - {name: pond, circle: {center: [20, 40], radius: 9}}
"""


def test_regions_are_read_and_belong_to_the_revision() -> None:
    world = read_world(WORLD + REGIONS, 'world.yaml')
    assert world.regions == {
        'dock': Polygon('dock', ((60, 0), (80, 0), (80, 15), (60, 15))),
        'pond': Circle('pond', (20, 40), 9),
    }
    without = read_world(WORLD, 'world.yaml')
    assert without.regions == {}
    assert world.revision != without.revision
    wider = read_world(WORLD + REGIONS.replace('radius: 9', 'radius: 10'), 'world.yaml')
    assert wider.revision != world.revision


@pytest.mark.parametrize(
    ('old', 'new', 'line', 'words'),
    [
        ('name: pond, ', '', 13, 'region 2 lacks name'),
        ('name: pond', 'name: dock', 13, 'dock is the name of another region, too'),
        ('name: pond', 'name: tree', 13, 'tree is the name of an object or a robot, too'),
        ('circle: {center: [20, 40], radius: 9}', '', 13, 'needs either polygon or circle'),
        ('radius: 9', 'radius: 0', 13, 'pond: radius has to be at least 0.001'),
        (', [80, 15], [60, 15]', '', 12, 'dock: a polygon needs 3 corners'),
        ('- {name: dock', '- {colour: red, name: dock', 12, 'colour'),
    ],
)
def test_faults_of_regions_are_told(old: str, new: str, line: int, words: str) -> None:
    assert old in REGIONS
    (fault,) = faults(WORLD + REGIONS.replace(old, new, 1))
    assert fault.line == line
    assert words in fault.message
