"""The relaxation: what it looks at grows with the mission no faster than the mission itself."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from task_planner_node.outcomes import Outcome, Result
from task_planner_node.search.relaxation import _Relaxation

DOMAIN = """(defdomain chain (
(:operator (!visit ?x) ((place ?x)) () ((visited ?x)))
(:method (visit nil) () ())
(:method (visit (?x . ?others)) () ((!visit ?x)(visit ?others)))))"""


@pytest.mark.parametrize('count', [10, 80])
def test_a_task_below_many_others_is_looked_at_as_often_as_one_on_top(
    plan: Callable[..., Result], monkeypatch: pytest.MonkeyPatch, count: int
) -> None:
    looks = 0
    apply = _Relaxation._apply

    def counted(self: _Relaxation, *arguments: Any) -> bool:
        nonlocal looks
        looks += 1
        return apply(self, *arguments)

    monkeypatch.setattr(_Relaxation, '_apply', counted)
    places = [f'p{number}' for number in range(count)]
    facts = ' '.join(f'(place {place})' for place in places)
    problem = f'(defproblem walk chain ({facts}) ((visit ({" ".join(places)} nowhere))))'
    result = plan(DOMAIN, problem)
    assert result.outcome == Outcome.NO_PLAN
    assert count <= looks <= 3 * count
