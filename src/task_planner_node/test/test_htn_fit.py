"""Which methods fit a task is the same however often, and after whichever tasks, it is asked."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from task_planner_node.language.domain import read_domain
from task_planner_node.language.source import Source
from task_planner_node.search import domain as compiled
from task_planner_node.search.domain import CompiledDomain, Fit

TEXT = """(defdomain d (
  (:operator (!go ?x) () () ())
  (:method (always ?x) () ((!go ?x)))
  (:method (twice a ?x) () ((!go ?x)))
  (:method (twice ?x b) () ((!go ?x)))
  (:method (if-known ?x) ((known ?x)) ((!go ?x)))
  (:method (either ?x) ((known ?x)) ((!go ?x)) () ((!go b)))))"""
FITS = {
    ('always', 'a'): Fit.CERTAIN,
    ('always', 'a', 'b'): Fit.NONE,
    ('twice', 'a', 'b'): Fit.OPEN,
    ('twice', 'a', 'c'): Fit.CERTAIN,
    ('twice', 'c', 'b'): Fit.CERTAIN,
    ('twice', 'c', 'c'): Fit.NONE,
    ('if-known', 'a'): Fit.OPEN,
    ('either', 'a'): Fit.OPEN,
    ('unheard-of',): Fit.NONE,
}


def domain() -> CompiledDomain:
    return CompiledDomain(read_domain(Source('d.lisp', TEXT)))


@given(st.lists(st.sampled_from(list(FITS)), max_size=30))
def test_it_is_what_the_heads_and_conditions_say(tasks: list[Any]) -> None:
    whole = domain()
    assert [whole.fit(task) for task in tasks] == [FITS[task] for task in tasks]


def test_no_more_tasks_are_kept_than_there_is_room_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compiled, 'MOST_KNOWN', 3)
    whole = domain()
    for _ in range(2):
        for task, fit in FITS.items():
            assert whole.fit(task) is fit
            assert len(whole._fits) <= 3
