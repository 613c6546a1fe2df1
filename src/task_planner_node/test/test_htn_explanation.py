"""Why there is no plan, in words, and how a plan came about, as text, JSON, for Graphviz and as a picture."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from typing import Any
from xml.etree import ElementTree

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from task_planner_node.explanation import FORMATS, written
from task_planner_node.explanation.causes import causes_of
from task_planner_node.outcomes import Outcome, Result
from task_planner_node.search.dead_ends import DeadEnd, DeadEnds, Reason, not_satisfied
from task_planner_node.search.tree import Tree, TreeNode

Plan = Callable[..., Result]

PIGEONS = """(defdomain pigeons (
 (:operator (!settle ?p ?h) ((free ?h)) ((free ?h)) ((in ?p ?h)))
 (:method (place ?p) ((hole ?h)) ((!settle ?p ?h)))))"""
HOLES = '(hole h0) (free h0) (hole h1) (free h1) (hole h2) (free h2)'
TOO_MANY = f'(defproblem p pigeons ({HOLES}) ((place p0) (place p1) (place p2) (place p3)))'

ROVER = """(defdomain rover (
 (:operator (!drive ?r ?a ?b) ((at ?r ?a)) ((at ?r ?a)) ((at ?r ?b)))
 (:operator (!photo ?r ?o) ((at ?r ?p) (sees ?p ?o)) () ((photo ?o)))
 (:method (photo-of ?o)
   with-a-camera ((HAS ?r ?c) (at ?r ?a) (sees ?p ?o)) ((!drive ?r ?a ?p) (!photo ?r ?o))
   by-hand ((person ?r) (free ?r)) ((!photo ?r ?o)))))"""
FACTS = '(has-camera rover0 cam) (at rover0 base) (sees hill rock) (person ann)'


# --- no plan


def test_dead_ends_of_one_cause_are_one_line(plan: Plan) -> None:
    result = plan(PIGEONS, TOO_MANY)
    assert result.outcome == Outcome.NO_PLAN
    title, cause, longest, after = result.explanation.splitlines()
    assert title == 'no plan exists; the longest partial plan had 3 actions'
    found = re.fullmatch(
        r'\(!settle p3 h0\) and 8 like it: precondition not met: \(free h0\) \((\d+) times\)', cause
    )
    # Each of the 6 ways to settle three pigeons leaves 3 occupied holes for the fourth, and so on downwards.
    assert found is not None
    assert int(found.group(1)) == 6 * 3 + 6 * 2 + 3 * 1
    assert longest == 'the longest partial plan: (!settle p0 h0) (!settle p1 h1) (!settle p2 h2)'
    assert after == 'after that (!settle p3 h0): precondition not met: (free h0)'
    assert len(result.details.splitlines()) == 5 + 9


def test_each_branch_is_told_with_its_first_literal_that_fails(plan: Plan) -> None:
    domain = ROVER.replace('HAS', 'has-camera')
    problem = f'(defproblem p rover ({FACTS} (free bob)) ((photo-of rock) (photo-of moon)))'
    result = plan(domain, problem)
    assert result.outcome == Outcome.NO_PLAN
    failed = '(photo-of moon): precondition not met: (sees ?p moon) in with-a-camera, (free ann) in by-hand'
    proof = 'nothing can make (sees ?p moon) in with-a-camera or (free ann) in by-hand true'
    assert f'(photo-of moon): {proof}; unknown object moon' in result.explanation
    assert f'after that {failed}' in result.explanation
    assert result.details.splitlines()[-1] == failed


def test_a_misspelt_predicate_is_named_with_what_was_probably_meant(plan: Plan) -> None:
    problem = f'(defproblem p rover ({FACTS} (free bob)) ((photo-of rock)))'
    result = plan(ROVER.replace('HAS', 'has-camra'), problem)
    assert result.outcome == Outcome.NO_PLAN
    expected = 'no fact or effect ever makes (has-camra ?r ?c) true; did you mean has-camera?'
    assert expected in result.explanation


def test_a_violated_constraint_is_told_with_its_value(
    plan: Plan, rover_mission: tuple[str, str], rover_motion_planner: Any
) -> None:
    oracle = rover_motion_planner(walled=frozenset({'location3'}))
    result = plan(*rover_mission, oracle)
    assert result.outcome == Outcome.NO_PLAN
    assert 'location3 is walled in' in result.explanation


def test_the_end_of_a_long_partial_plan_is_told(plan: Plan) -> None:
    steps = ' '.join(f'(!a {number})' for number in range(50))
    domain = '(defdomain d ((:operator (!a ?x) () () ((done ?x))) (:operator (!b) ((no)) () ())))'
    result = plan(domain, f'(defproblem p d () ({steps} (:unordered (!b) (!b))))')
    lines = result.explanation.splitlines()
    assert 'had 50 actions' in lines[0]
    assert '(!b): no fact or effect ever makes (no) true' in lines[1]
    assert lines[2].endswith('... (!a 45) (!a 46) (!a 47) (!a 48) (!a 49)')


@settings(deadline=None)
@given(st.lists(st.tuples(st.sampled_from('abc'), st.integers(0, 30), st.integers(1, 9))))
def test_no_dead_end_is_lost_or_counted_twice(found: list[tuple[str, int, int]]) -> None:
    dead_ends = [
        DeadEnd((name, f'o{number}'), f'distance to o{number} is {number}.5', count=count)
        for name, number, count in found
    ]
    causes = causes_of(dead_ends, 8)
    assert sum(cause.alike for cause in causes) == len(dead_ends)
    assert sum(cause.count for cause in causes) == sum(count for _, _, count in found)
    if len(dead_ends) > 8:
        assert len(causes) == len({name for name, _, _ in found})


def test_many_causes_are_put_together_more_coarsely() -> None:
    dead_ends = [
        DeadEnd(('go', 'x'), f'precondition not met: (at x p{n}q)', count=1) for n in range(10)
    ]
    assert len(causes_of(dead_ends, 10)) == 10
    (cause,) = causes_of(dead_ends, 8)
    assert str(cause) == '(go x) and 9 like it: precondition not met: (at x p0q)'


def test_what_came_last_is_known_and_reasons_are_asked_for_once() -> None:
    asked = []

    def reason() -> Reason:
        asked.append(1)
        return not_satisfied([('one', '(p)'), ('two', '(p)'), ('three', '(q a)'), ('four', '')])

    dead_ends = DeadEnds()
    for task in (('a',), ('b',), ('a',)):
        dead_ends.add(task, 'method', reason)
    assert len(asked) == 2
    assert dead_ends.latest is dead_ends.most_frequent()[0] is dead_ends.groups[('a',), 'method']
    assert dead_ends.latest.reason == 'precondition not met: (p) in one and two, (q a) in three'
    assert dead_ends.latest.unmet == ('(p)', '(q a)')


# --- the tree of a plan


@pytest.fixture
def tree(plan: Plan) -> Tree:
    """The picture of the rock: one task, decomposed into two actions."""
    domain = ROVER.replace('HAS', 'has-camera')
    return plan(domain, f'(defproblem p rover ({FACTS}) ((photo-of rock)))').plans[0].tree


def test_the_tree_as_text(tree: Tree) -> None:
    assert written(tree, 'tree') == (
        '(photo-of rock)  <- with-a-camera\n  1. (!drive rover0 base hill)\n  2. (!photo rover0 rock)\n'
    )


def test_the_tree_as_json(tree: Tree) -> None:
    top, *actions = json.loads(written(tree, 'json'))['nodes']
    assert top == {
        'id': 0,
        'parent': None,
        'task': ['photo-of', 'rock'],
        'step': None,
        'method': '',
        'branch': 'with-a-camera',
        'method_number': 1,
        'branch_number': 1,
    }
    assert actions[0] == {
        'id': 1,
        'parent': 0,
        'task': ['!drive', 'rover0', 'base', 'hill'],
        'step': 0,
    }
    assert [node['step'] for node in actions] == [0, 1]


def test_the_tree_for_graphviz(tree: Tree) -> None:
    lines = written(tree, 'dot').splitlines()
    assert (lines[0], lines[-1]) == ('digraph plan {', '}')
    assert '  n0 [shape=ellipse, label="(photo-of rock)"];' in lines
    assert '  n2 [shape=box, label="2. (!photo rover0 rock)"];' in lines
    assert [line for line in lines if '->' in line] == ['  n0 -> n1;', '  n0 -> n2;']


names = st.text(
    st.characters(codec='utf-8', exclude_categories=['Cs', 'Cc']), min_size=1, max_size=8
)


@st.composite
def trees(draw: st.DrawFn) -> Tree:
    def node(depth: int) -> TreeNode:
        task = (draw(names), *draw(st.lists(names | st.integers(), max_size=2)))
        if depth == 0 or draw(st.booleans()):
            return TreeNode(task, primitive=True, step=draw(st.none() | st.integers(0, 9)))
        children = tuple(node(depth - 1) for _ in range(draw(st.integers(0, 3))))
        return TreeNode(task, primitive=False, children=children, branch=draw(names))

    return Tree(tuple(node(3) for _ in range(draw(st.integers(0, 2)))))


@settings(max_examples=50, deadline=None)
@given(trees())
def test_every_tree_is_written_whole_whatever_the_names(tree: Tree) -> None:
    nodes = [node for node, _ in tree.nodes()]
    found = json.loads(written(tree, 'json'))['nodes']
    assert [each['id'] for each in found] == list(range(len(nodes)))
    for node, each in zip(nodes, found, strict=True):
        below = [nodes[other['id']] for other in found if other['parent'] == each['id']]
        assert below == list(node.children)
    picture = ElementTree.fromstring(written(tree, 'svg'))
    assert len(picture.findall('{*}text')) == len(nodes)
    assert len(picture.findall('{*}path')) == len(nodes) - len(tree.roots)
    boxes, ellipses = (
        written(tree, 'dot').count(f'[shape={shape},') for shape in ('box', 'ellipse')
    )
    assert boxes + ellipses >= len(nodes)
    assert written(tree, 'tree').count('\n') >= len(nodes)
    decomposed = [node for node in nodes if not node.primitive]
    assert written(tree, 'ipc').count(' -> ') == len(decomposed)


def test_deep_and_large_trees_are_written_too(plan: Plan) -> None:
    domain = """(defdomain walk (
     (:operator (!step ?n) () () ())
     (:method (walk ?n) ((call > ?n 0)) ((!step ?n) (walk (call - ?n 1))) () ())))"""
    tree = plan(domain, '(defproblem far walk () ((walk 12000)))').plans[0].tree
    count = sum(1 for _ in tree.nodes())
    assert count == 2 * 12000 + 1
    assert len(json.loads(written(tree, 'json'))['nodes']) == count
    assert written(tree, 'tree').endswith(f'\n... and {count - 20_000} more\n')
    assert f'... and {count - 5_000} more' in written(tree, 'svg')
    assert max(map(len, written(tree, 'tree').splitlines())) < 200


def test_an_unknown_format_is_refused_with_those_there_are() -> None:
    with pytest.raises(
        ValueError, match=f'png is no format of a tree: expected {", ".join(FORMATS)}'
    ):
        written(Tree(), 'png')
