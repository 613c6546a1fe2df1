"""Operators with geometric preconditions: the symbolic ones first, then one answer of the motion planner after the other."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from task_planner_node.oracle import Answer, Status
from task_planner_node.search.acting import act, unsatisfied
from task_planner_node.search.geometry import Geometry, Request
from task_planner_node.search.network import Cell, Path, replace
from task_planner_node.search.operators import CompiledOperator
from task_planner_node.search.partial_plan import (
    Limits,
    Motion,
    Moves,
    Position,
    Whereabouts,
)
from task_planner_node.search.relaxation import no_definition_fits
from task_planner_node.search.state import State
from task_planner_node.search.terms import Frame

if TYPE_CHECKING:
    from task_planner_node.search.engine import Search


class Motions:
    """Each destination and path that the motion planner finds is a choice of its own."""

    def __init__(self, search: Search, state: State, geometry: Geometry, limits: Limits) -> None:
        self._search = search
        self._optimise = limits.optimise
        self._state = state
        self._geometry = geometry

    def moves(
        self, position: Position, cell: Cell, path: Path, operator: CompiledOperator
    ) -> Moves:
        """Symbolic preconditions first, then the geometric ones, then the effects."""
        task = cell[0]
        frame = operator.bind(task)
        if frame is None:
            self._search.dead_ends.add(task, 'head', no_definition_fits(task, primitive=True))
            return
        satisfied = False
        for _ in operator.condition.solutions(self._state, frame):
            satisfied = True
            yield from self.answered(position, cell, path, operator, frame)
        if not satisfied:
            unsatisfied(self._search, self._state, task, operator, frame)

    def answered(
        self,
        position: Position,
        cell: Cell,
        path: Path,
        operator: CompiledOperator,
        frame: Frame,
    ) -> Moves:
        """The geometric preconditions and then the effects, for one solution of the symbolic preconditions.

        Where all that failed after one destination failed for what the facts are, it would fail after each of them,
        so no other is tried: backjumping (P. Prosser, "Hybrid algorithms for the constraint satisfaction problem",
        Computational Intelligence 9, 1993).
        """
        search, mark = self._search, self._state.mark()
        before = search.placed
        search.placed += 1
        for request, answer in self._answers(position[1], cell, operator, frame):
            if answer.status != Status.FOUND:
                yield ()
                continue
            following = self._act(position, cell, path, operator, frame, request, answer)
            if following is None:
                self._state.undo(mark)
                search.placed = before
                return
            placed = search.placed
            yield following
            if search.placed == placed:
                # Nor does it matter to those who came here from where.
                search.placed = before
                return

    def _answers(
        self, where: Whereabouts, cell: Cell, operator: CompiledOperator, frame: Frame
    ) -> Iterator[tuple[Request, Answer]]:
        """The geometric alternatives; an answer that is not FOUND tells that something was learnt."""
        geometry, dead_ends = self._geometry, self._search.dead_ends
        task = cell[0]
        text = operator.text(frame) if operator.text else ''
        behaviour = operator.behaviour(frame) if operator.behaviour else ''
        preferred = where.tour.end(text) if where.tour is not None else None
        request = Request(task, text, behaviour, where.start, where.lineage, preferred)
        nogood = geometry.nogood(request)
        if nogood is not None:
            dead_ends.add(task, 'geometric', nogood.reason, nogood.objects)
            return
        version = geometry.version
        exhausted = True
        for count, answer in enumerate(geometry.alternatives(request)):
            exhausted = answer.assigned
            if answer.status == Status.FOUND:
                yield request, answer
                continue
            exhausted = answer.status != Status.UNKNOWN
            if count == 0:
                dead_ends.add(task, str(answer.code), answer.message, answer.objects)
            if version != geometry.version:
                yield request, answer
        if not exhausted:
            self._search.give_up()

    def _act(
        self,
        position: Position,
        cell: Cell,
        path: Path,
        operator: CompiledOperator,
        frame: Frame,
        request: Request,
        answer: Answer,
    ) -> Position | None:
        network, where, cost, rest_cost, actions, _, _ = position
        acted = act(self._search, self._state, cell, operator, frame)
        if acted is None:
            return None
        price, expansion = acted
        expansion.motion = Motion(price, request.text, where.start, answer)
        lineage = answer.end if answer.assigned else where.lineage
        met = where.met | {request.text} if self._optimise else where.met
        tour = where.tour.after(request.text, answer) if where.tour is not None else None
        return (
            replace(network, path, cell[1], to_front=True) if path else cell[1],
            Whereabouts(answer.end, lineage, where.length + answer.length, met, tour),
            cost + price + answer.length,
            rest_cost - operator.least_cost,
            actions if operator.internal else actions + 1,
            False,
            None,
        )
