"""Parts of missions in SHOP's language, read from short texts."""

from __future__ import annotations

from typing import Any

from task_planner_node.language import (
    Source,
    read_domain,
    read_problem,
)
from task_planner_node.language.model import (
    And,
    Atom,
    Branch,
    Domain,
    Operator,
    Problem,
    show,
)


def domain(text: str) -> Domain:
    return read_domain(Source('d.lisp', text))


def operator(text: str) -> Operator:
    (found,) = domain(text).operators
    return found


def branch(text: str) -> Branch:
    (method,) = domain(f'(:method (m ?x) {text})').methods
    (found,) = method.branches
    return found


def condition(text: str) -> Any:
    """The only condition in a list of conditions."""
    found = branch(f'({text}) ()').condition
    assert isinstance(found, And)
    (only,) = found.conditions
    return only


def problem(text: str, **options: Any) -> Problem:
    return read_problem(Source('p.lisp', text), **options)


def fact(text: str) -> tuple[Any, ...]:
    (found,) = problem(f'(defproblem p d ({text}) ())').facts
    return (found.name, *found.args)


def written(found: object) -> str:
    assert isinstance(found, Atom)
    return show(found)
