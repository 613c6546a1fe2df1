"""Random missions with conditions, effects and tasks of every form: all their plans, against an interpreter written differently."""

from __future__ import annotations

from collections.abc import Callable

from hypothesis import assume, example, given, reject, settings
from hypothesis import strategies as st

from task_planner_node.outcomes import Options, Outcome, Result
from tests.support.htn_interpreter import MOST_PLANS, Interpreter, TooLarge, Unbound, ground
from tests.support.random_missions import Draw, texts

Planned = Callable[..., Result]


@settings(max_examples=300, deadline=None)
@given(st.integers(0, 2**32))
@example(13582447)
@example(1138)
def test_the_search_finds_all_plans_and_no_others(plan: Planned, seed: int) -> None:
    mission = Draw(seed).mission()
    interpreter = Interpreter(mission)
    try:
        wanted = interpreter.plans(ground(mission.top, {}), (mission.facts, ()))
    except (TooLarge, Unbound):
        reject()
    options = Options(use_advice=False, plans=MOST_PLANS + 1, time_budget=600.0)
    result = plan(*texts(mission), None, options)
    assume(result.outcome != Outcome.INVALID)
    assert {tuple(s.action for s in found.steps) for found in result.plans} == wanted
    assert result.outcome == (Outcome.SOLVED if wanted else Outcome.NO_PLAN)
    first = plan(*texts(mission), None, Options(use_advice=False, time_budget=600.0))
    assert first.outcome == result.outcome
    assert first.plans[0].actions == result.plans[0].actions if wanted else not first.plans
