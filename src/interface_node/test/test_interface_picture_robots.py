"""Pictures of plans with several robots, of starts, and of many actions in one spot."""

from __future__ import annotations

from math import pi
from typing import Any

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgba

from interface_node.picture import draw
from interface_node.picture.marks import group_marks
from interface_node.picture.robots import COLORS, robot_colors, robots_in_sight, starts
from interface_node.picture.style import BETWEEN, END, START
from interface_node.plan import Attitude, Obstacle, Plan, Robot, Segment, Step, World

ROBOTS = tuple(
    Robot(label, 0.0, 0.0, 0.5, 1.0, 'differential') for label in ('scout', 'guard', 'idle')
)
GATE = (30.0, 20.0)
WORLD = World('w', 'r', (0.0, 0.0, 40.0, 30.0), {'gate': GATE}, robots=ROBOTS)
SIGHT = '((agent scout)(agent guard)(object gate)(visible(guard, scout))(visible(scout, gate)))'


def moved(agent: str, start: Attitude, end: Attitude, **fields: Any) -> Step:
    """A step whose drawn way is straight east; only where it starts and ends matters here."""
    return Step(
        ('!go', agent),
        agent=agent,
        end=end,
        motion_start=start,
        segments=(Segment(0.0, end.x - start.x),),
        length=end.x - start.x,
        **fields,
    )


def staying(agent: str, at: Attitude) -> Step:
    return Step(('!look', agent), agent=agent, end=at)


def plan_of(*steps: Step) -> Plan:
    return Plan('m', 'SOLVED', world=WORLD, steps=steps)


A, B = Attitude(5.0, 5.0, 0.0), Attitude(20.0, 5.0, 0.0)
C, D = Attitude(4.0, 20.0, 0.0), Attitude(25.0, 20.0, 0.0)


def test_two_robots_have_a_colour_each_and_one_has_none() -> None:
    both = plan_of(moved('scout', A, B), moved('guard', C, D), staying('scout', B))
    assert robot_colors(both) == {'scout': COLORS[0], 'guard': COLORS[1]}
    assert robot_colors(plan_of(moved('scout', A, B))) == {}
    (axes,) = draw(both).axes
    way = next(lines for lines in axes.collections if isinstance(lines, LineCollection))
    segments, colors = np.array(list(way.get_segments())), np.asarray(way.get_colors())
    south = segments[:, 0, 1] < 10.0
    assert {tuple(color) for color in colors[south]} == {to_rgba(COLORS[0])}
    assert {tuple(color) for color in colors[~south]} == {to_rgba(COLORS[1])}
    legend = axes.get_legend()
    assert legend is not None
    labels = [text.get_text() for text in legend.get_texts()]
    assert labels == ['obstacle', 'object', 'scout', 'guard', 'view']


def test_actions_in_one_spot_share_a_mark() -> None:
    near = Attitude(B.x + 0.1, B.y, pi / 2)
    plan = plan_of(
        moved('scout', A, B),
        staying('scout', near),
        staying('scout', B),
        moved('guard', C, near),
        staying('scout', B),
        staying('scout', Attitude(9.0, 9.0, 0.0)),
    )
    marks = group_marks(plan, robot_colors(plan), 0.5)
    assert [(mark.agent, mark.text) for mark in marks] == [
        ('scout', '1-3, 5'),
        ('guard', '4'),
        ('scout', '6'),
    ]
    assert marks[0].headings == [0.0, pi / 2]
    texts = {text.get_text() for text in draw(plan).axes[0].texts}
    assert {'1-3, 5', '4', '6', 'gate'} <= texts


def test_the_first_and_the_last_mark_of_a_single_robot() -> None:
    first = Step(('!put',), agent='scout', end=A, assigned=True)
    plan = plan_of(first, moved('scout', A, B), staying('scout', D), staying('scout', B))
    marks = group_marks(plan, {}, 0.5)
    assert [(mark.text, mark.color) for mark in marks] == [
        ('1', START),
        ('2, 4', END),
        ('3', BETWEEN),
    ]


def test_a_start_is_marked_unless_an_action_put_the_robot_there() -> None:
    put = Step(('!put',), agent='guard', end=C, assigned=True)
    assert starts(plan_of(moved('scout', A, B), put, moved('guard', C, D))) == [('scout', A)]
    assert starts(plan_of(staying('scout', A))) == []


def test_lines_lead_to_robots_that_have_to_be_in_sight() -> None:
    state = {'scout': A, 'guard': D, 'idle': C}
    looking = moved('scout', A, B, state=state, objects=('gate',), preconditions=SIGHT)
    assert list(robots_in_sight(looking)) == [D]
    apart = moved('scout', A, B, state=state, preconditions='((distance(scout, guard) >= 3))')
    assert list(robots_in_sight(apart)) == []
    (axes,) = draw(plan_of(looking)).axes
    lines = [list(c.get_segments()) for c in axes.collections if isinstance(c, LineCollection)]
    assert [tuple(end) for end in lines[-1][0]] == [(B.x, B.y), (D.x, D.y)]


def test_regions_are_named_beside_what_stands_in_them() -> None:
    bay = Obstacle('bay', ((4.0, 4.0), (6.0, 4.0), (6.0, 6.0), (4.0, 6.0)))
    world = World('w', 'r', WORLD.bounds, robots=ROBOTS, regions=(bay,))
    plan = Plan('m', 'SOLVED', world=world, steps=(staying('scout', A),))
    figure = draw(plan)
    (axes,) = figure.axes
    (name,) = (text for text in axes.texts if text.get_text() == 'bay')
    mark = axes.transData.transform((A.x, A.y))
    assert not name.get_window_extent().contains(*mark)
