"""Which constraints fight each other, and by how much: the reasons of answers that are not found."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from motion_planner_node.language.syntax import Call, Label, Number
from motion_planner_node.satisfaction.branch_and_prune import Remainder, branch_and_prune
from motion_planner_node.satisfaction.descent import descend
from motion_planner_node.world.model import Bounds

if TYPE_CHECKING:
    from motion_planner_node.satisfaction.program import Program

#: Descents that tell whether constraints can be met.
_DESCENTS = 64
#: Boxes looked at for the numbers of an explanation.
_BUDGET = 4_000
#: Boxes looked at before descents are made.
_FEW = 1_000


def contradiction(program: Program, bounds: Bounds) -> str | None:
    """A sentence when it is proven that no attitude within ``bounds`` meets the constraints.

    It names constraints none of which can be left out, how far they are from being met together,
    and by what they were proven to exclude each other.
    """
    if program.contradictions:
        return program.contradictions[0]
    proof = branch_and_prune(program, bounds)
    if not proof.is_empty:
        return None

    def is_contradictory(rows: Sequence[int]) -> bool:
        # Most proofs take few boxes, and descents that meet nothing take long.
        if branch_and_prune(program, bounds, rows, budget=_FEW).is_empty:
            return True
        return not _is_met(program, bounds, rows) and _excluded(program, bounds, rows).is_empty

    rows = minimal_conflict(range(len(program.rows)), is_contradictory)
    boxes = _excluded(program, bounds, rows).examined
    by = 'bounds' if boxes == 1 else f'interval branch and prune, {boxes} boxes'
    return f'{_sentence(program, bounds, rows)} (proven by {by})'


def unsolved(program: Program, bounds: Bounds) -> tuple[int, ...]:
    """A smallest set of constraints that no descent meets together; empty if all can be met."""
    if _is_met(program, bounds, range(len(program.rows))):
        return ()
    return minimal_conflict(
        range(len(program.rows)), lambda rows: not _is_met(program, bounds, rows)
    )


def minimal_conflict(
    rows: Sequence[int], is_conflict: Callable[[Sequence[int]], bool]
) -> tuple[int, ...]:
    """Constraints of ``rows`` that are in conflict, none of which can be left out.

    Deletion filtering: each is left out in turn, for good where the rest still is in conflict.
    """
    kept = list(rows)
    for index in rows:
        others = [row for row in kept if row != index]
        if others and is_conflict(others):
            kept = others
    return tuple(kept)


def separation(program: Program, rows: Sequence[int]) -> str:
    """'a and b are 35.0 apart' where ``rows`` bound the distances to two places, else ''."""
    places = set()
    for index in rows:
        constraint = program.rows[index].constraint
        call = constraint.left if isinstance(constraint.left, Call) else constraint.right
        if not isinstance(call, Call) or call.name != 'distance':
            return ''
        other = constraint.right if call is constraint.left else constraint.left
        if not isinstance(other, Number):
            return ''
        places |= {argument.name for argument in call.arguments if isinstance(argument, Label)}
    places -= {program.agent}
    if len(places) != 2:
        return ''
    first, second = sorted(places)
    (x, y), (u, v) = program.position(first), program.position(second)
    return f'{first} and {second} are {np.hypot(x - u, y - v):.1f} apart'


def _sentence(program: Program, bounds: Bounds, rows: Sequence[int]) -> str:
    texts = together(program, rows)
    apart = separation(program, rows)
    if apart:
        return f'{texts}, but {apart}: they exclude each other'
    *others, last = rows
    missed = _least_miss(program, bounds, last, others)
    if not others:
        short = f': missed by {missed:.6g} or more' if missed > 0.0 else ''
        return f'{texts} holds nowhere on the map{short}'
    short = (
        f': where {together(program, others)} holds, '
        f'{program.rows[last].text} is missed by {missed:.6g} or more'
    )
    return f'{texts} exclude each other everywhere on the map{short if missed > 0.0 else ""}'


def together(program: Program, rows: Sequence[int]) -> str:
    """The texts of ``rows``, as a part of a sentence."""
    return ' and '.join(program.rows[index].text for index in rows)


def _is_met(program: Program, bounds: Bounds, rows: Sequence[int]) -> bool:
    """Whether a descent within ``bounds`` meets ``rows``."""
    part = program.only(rows)
    low, high = (bounds.x_min, bounds.y_min, -np.pi), (bounds.x_max, bounds.y_max, np.pi)
    states = np.random.default_rng(0).uniform(low, high, (_DESCENTS, 3))
    descent = descend(part, states)
    x, y = descent.states[:, 0], descent.states[:, 1]
    inside = (x >= bounds.x_min) & (x <= bounds.x_max) & (y >= bounds.y_min) & (y <= bounds.y_max)
    return bool((descent.satisfied & inside).any())


def _excluded(program: Program, bounds: Bounds, rows: Sequence[int]) -> Remainder:
    return branch_and_prune(program, bounds, rows)


def _least_miss(program: Program, bounds: Bounds, row: int, others: Sequence[int]) -> float:
    """By how much ``row`` is missed wherever ``others`` may hold, at least."""
    left = branch_and_prune(program, bounds, others, budget=_BUDGET)
    if left.is_empty:
        return 0.0
    function = program.bounds(left.low, left.high)[row]
    missed = np.maximum(function.low, 0.0)
    if program.rows[row].is_equality:
        missed = np.maximum(missed, -function.high)
    return float(np.min(missed))
