"""The experiment on the task planner in a reduced form: what it counts and whether plans are any, not how long it takes."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

import pytest

from experiments.htn import gtpyhop_domains, hddl_texts, ours, problems, shop_texts, tracing
from experiments.htn.comparison import WALK, Speed
from experiments.htn.problems import TABLE, Blocks
from experiments.htn.run import plan_targets, speed_targets
from experiments.htn.shop_texts import Problem
from task_planner_node.outcomes import Outcome

PROBLEMS: dict[str, Problem] = {
    **{f'blocks {seed}': problems.blocks(12, seed) for seed in range(4)},
    **{f'logistics {seed}': problems.logistics(6, seed, cities=3) for seed in range(3)},
    **{f'rovers {seed}': problems.rovers(9, seed, vehicles=3) for seed in range(3)},
    **{f'satellites {seed}': problems.satellites(8, seed, vehicles=2) for seed in range(3)},
}
Plan = Sequence[tuple[str, ...]]


class Table:
    """Blocks that a person could move."""

    def __init__(self, problem: Blocks) -> None:
        self.below = dict(problem.start)
        self.held = ''

    def free(self, block: str) -> bool:
        return self.held != block and block not in self.below.values()

    def move(self, action: str, block: str, other: str) -> None:
        if action in ('pick-up', 'unstack'):
            assert self.below.pop(block) == other
            assert self.free(block)
            assert not self.held
            self.held = block
        else:
            assert self.held == block
            assert other == TABLE or self.free(other)
            self.below[block] = other
            self.held = ''


class Recorder:
    """Stands for GTPyhop, and keeps the actions that are declared."""

    def __init__(self) -> None:
        self.actions: dict[str, Any] = {}

    def declare_actions(self, *actions: Any) -> None:
        self.actions.update({action.__name__: action for action in actions})

    def declare_task_methods(self, *_: Any) -> None:
        """Not needed."""


def execute(problem: Problem, plan: Plan) -> bool:
    """Carry a plan out, whatever the planner thinks; whether the goal is reached."""
    words = [(action[0].lstrip('!'), *action[1:]) for action in plan]
    if isinstance(problem, Blocks):
        table = Table(problem)
        for action, block, *rest in words:
            table.move(action, block, *(rest or [TABLE]))
        return table.below == problem.goal
    recorder, state = Recorder(), SimpleNamespace()
    declare = getattr(gtpyhop_domains, type(problem).__name__.lower())
    reached = declare(recorder, problem, state)
    for action, *arguments in words:
        name = action if action in recorder.actions else action.replace('_', '-')
        assert recorder.actions[name](state, *arguments), (action, *arguments)
    return bool(reached(state))


@pytest.mark.parametrize('name', PROBLEMS)
def test_plans_of_random_problems_reach_the_goal(name: str) -> None:
    problem = PROBLEMS[name]
    run = ours.plan(shop_texts.domain_text(problem), shop_texts.problem_text(problem))
    assert run.result.outcome == Outcome.SOLVED, run.result.explanation
    assert execute(problem, [step.action for step in run.result.steps])
    assert run.decompositions > len(run.result.steps)


@pytest.mark.parametrize('name', PROBLEMS)
def test_the_same_problem_in_hddl_has_a_plan(name: str) -> None:
    problem = PROBLEMS[name]
    domain = hddl_texts.domain_file(problem).read_text(encoding='utf-8')
    run = ours.plan(domain, hddl_texts.problem_text(problem))
    assert run.result.outcome == Outcome.SOLVED, run.result.explanation


def test_problems_are_the_same_for_the_same_seed_only() -> None:
    for make in (problems.blocks, problems.logistics, problems.rovers, problems.satellites):
        texts = [shop_texts.problem_text(make(10, seed)) for seed in (1, 1, 2)]
        assert texts[0] == texts[1] != texts[2]


def test_a_broken_plan_is_noticed() -> None:
    problem = PROBLEMS['logistics 0']
    run = ours.plan(shop_texts.domain_text(problem), shop_texts.problem_text(problem))
    plan = [step.action for step in run.result.steps]
    assert not execute(problem, plan[:-1])
    with pytest.raises(AssertionError):
        execute(problem, plan[1:])


def test_a_long_walk_has_all_its_steps() -> None:
    run = ours.plan(WALK, '(defproblem far walk () ((walk 2000)))')
    assert [step.action[1] for step in run.result.steps[::999]] == ['2000', '1001', '2']


def test_pigeons_without_a_hole_are_dead_ends_all_noted() -> None:
    run = ours.plan(tracing.PIGEONS, tracing.pigeons(5))
    assert run.result.outcome == Outcome.NO_PLAN
    assert run.decompositions > 4 * 3 * 2
    assert 'settle' in run.result.explanation


def test_targets_look_at_the_worst_problem() -> None:
    fast = Speed('blocks 300', 10, 1000, 0.1, 0.01, 'greedy', 10, 10, 0.1, '', '')
    slow = Speed('rovers 20', 12, 100, 0.1, 0.01, 'greedy', 10, 10, 0.1, 'no plan', '')
    rate, faster = speed_targets([fast, slow])
    assert [rate.value, faster.value] == pytest.approx([10_000, 10])
    assert [rate.met, faster.met] == [False, True]
    faults, blocks, others = plan_targets([fast, slow], [(9, 10), (10, 10)])
    assert [faults.value, blocks.value, others.value] == [1, 0.95, 1.2]
    assert [faults.met, blocks.met, others.met] == [False, True, False]
