"""Ground preconditions compiled for the world and the start of one request."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from copy import copy
from functools import cached_property
from math import inf
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions import COMPONENTS, Array, Dual, Interval, surroundings_of
from motion_planner_node.language.check import compared
from motion_planner_node.language.printer import to_text
from motion_planner_node.language.syntax import (
    Condition,
    Constraint,
    Preconditions,
)
from motion_planner_node.language.tape import Tape
from motion_planner_node.requests import Residual
from motion_planner_node.robots.motion import Attitude, GeometricState
from motion_planner_node.satisfaction.bounding import bounds_at, possible_at
from motion_planner_node.satisfaction.cells import possible_cells, possible_positions
from motion_planner_node.satisfaction.commands import applied, components_of
from motion_planner_node.satisfaction.conflicts import contradiction
from motion_planner_node.satisfaction.evaluation import violations_at
from motion_planner_node.satisfaction.recording import Table, record
from motion_planner_node.satisfaction.row import Row
from motion_planner_node.stopping import ShouldStop, go_on, never
from motion_planner_node.world.model import Bounds, World

#: Violation up to which a constraint counts as met by a destination, in the constraint's unit, for
#: coordinates of ordinary size. Strict comparators have none.
TOLERANCE = 1e-9

#: Violation up to which a constraint counts as met where a motion ends, by rounding on the way.
ENOUGH = 1e-6

#: Violation that restarts allow for: as large as any tolerance, so that they suit all starts.
_LOOSE = 1e-6
#: Boxes of positions that restarts are spread over.
_MOST_PLACES = 256

_BELOW_ZERO = -5e-324
_EPSILON = float(np.finfo(np.float64).eps)


class Program:
    """What is to be satisfied by one agent, ready for batches of attitudes.

    Attributes:
        agent: label of the agent that moves
        agents, objects: labels that the text states
        assigns: whether there are commands
        start: the state after the commands, from which the constraints are to be met
        constraints: the constraints as texts
        contradictions: why they cannot hold together, as far as that shows without the world
        rows: the constraints as compiled, in the same order
        tolerance: violation that a destination may have [unit of the constraint]
    """

    def __init__(
        self,
        preconditions: Preconditions,
        world: World,
        start: GeometricState,
        agent: str,
        contradictions: tuple[str, ...],
    ) -> None:
        self.agent = agent
        self.agents = preconditions.agents
        self.objects = preconditions.objects
        self.assigns = preconditions.assigns
        self.contradictions = contradictions
        self._should_stop: ShouldStop = never
        self._preconditions = preconditions
        self._world = world
        self._fields = {label: world.objects[label].fields for label in self.objects}
        self.start, self.tolerance = self._begun(start)
        places = self._fields | components_of(self.start, self.agents)
        self._tape = Tape(agent, places, surroundings_of(world))
        self.rows = tuple(self._row(item) for item in preconditions.constraints)
        self.constraints = tuple(row.text for row in self.rows)

    def _begun(self, start: GeometricState) -> tuple[dict[str, Attitude], float]:
        """The state after the commands, and the tolerance with which that can be computed."""
        state = self.apply_commands(start)
        places = self._fields | components_of(state, self.agents)
        largest = max(
            (abs(value) for fields in places.values() for value in fields.values()), default=0.0
        )
        return dict(state), TOLERANCE + 16.0 * _EPSILON * largest

    def starting_at(self, start: GeometricState) -> Program | None:
        """The same program from another attitude of the agent that moves.

        None where that is another program: there are commands, or other agents stand elsewhere.
        """
        others = (label for label in self.agents if label != self.agent)
        is_same = all(start.get(label) == self.start[label] for label in others)
        if self.assigns or self.agent not in start or not is_same:
            return None
        return self._starting_with(*self._begun(start))

    def _starting_with(self, start: Mapping[str, Attitude], tolerance: float) -> Program:
        _ = self.table, self._places  # which both programs share
        result = copy(self)
        result.start, result.tolerance = dict(start), tolerance
        for name in ('conditions', '_limits', '_allowed'):
            vars(result).pop(name, None)
        return result

    @contextmanager
    def broken_off_by(self, should_stop: ShouldStop) -> Iterator[None]:
        """Inside the block whatever is computed with the program raises Stopped when it is to stop."""
        before, self._should_stop = self._should_stop, should_stop
        try:
            yield
        finally:
            self._should_stop = before

    def apply_commands(self, state: GeometricState) -> GeometricState:
        """The state after the commands, as `commands.applied` has it."""
        commands = self._preconditions.commands
        return applied(commands, self._fields, surroundings_of(self._world), state)

    def functions(
        self, states: Array, *, derivatives: Literal['none', 'truncated', 'full'] = 'none'
    ) -> list[Dual]:
        """The functions f_i of ``states`` (n, 3): left minus right side, sign reversed for >=.

        A constraint holds where its function is at most 0 (below 0 if strict, 0 if an equality).
        Angles are the difference of the sides wrapped to [-pi, pi]. Undefined ones are NaN.
        """
        with np.errstate(all='ignore'):
            sides = self.sides(states, derivatives=derivatives)
            return [row.function(*pair) for row, pair in zip(self.rows, sides, strict=True)]

    def sides(
        self, states: Array, *, derivatives: Literal['none', 'truncated', 'full'] = 'none'
    ) -> list[tuple[Dual, Dual]]:
        """The left and right sides of the constraints at ``states`` (n, 3)."""
        go_on(self._should_stop)
        columns = np.ascontiguousarray(states.T)
        if derivatives == 'none':
            state = [Dual(column) for column in columns]
        else:
            unit = np.eye(3)
            ones = np.ones((1, len(states)))
            state = [Dual(column, unit[:, i : i + 1] * ones) for i, column in enumerate(columns)]
        with np.errstate(all='ignore'):
            values = self._tape.run(state, Dual.constant, truncated=derivatives == 'truncated')
        return [(values[row.left], values[row.right]) for row in self.rows]

    @cached_property
    def table(self) -> Table | None:
        """The functions f_i as primitive operations, or None when one of them is not primitive."""
        return record(self._tape, self.rows)

    @cached_property
    def conditions(self) -> Array:
        """Of each constraint whether it is an equality, periodic, strict, and where to stop: (m, 4).

        A descent can stop when equalities hold within half the tolerance, and inequalities within
        three quarters of their margin.
        """
        rows = [
            (row.is_equality, row.periodic, row.is_strict, 0.5 if row.is_equality else 1.5)
            for row in self.rows
        ]
        return np.array(rows, dtype=np.float64).reshape(-1, 4) * [1.0, 1.0, 1.0, self.tolerance]

    def differences(self, states: Array, told: Array, *, is_truncated: bool) -> None:
        """Fill ``told`` (n, m or more, 4) with the functions f_i of ``states`` and their slopes."""
        derivatives: Literal['truncated', 'full'] = 'truncated' if is_truncated else 'full'
        for index, function in enumerate(self.functions(states, derivatives=derivatives)):
            told[:, index, 0] = function.value
            if function.gradient is not None:
                told[:, index, 1:] = function.gradient.T

    @cached_property
    def uses_heading(self) -> bool:
        """Whether some function seems to depend on the heading, as seen at a few attitudes."""
        states = np.random.default_rng(0).uniform(-3.0, 3.0, (8, 3))
        slopes = [function.gradient for function in self.functions(states, derivatives='full')]
        return any(slope is not None and bool(np.any(slope[2] != 0.0)) for slope in slopes)

    @cached_property
    def _limits(self) -> Array:
        rows = [
            (
                -self.tolerance if row.is_equality else -inf,
                _BELOW_ZERO if row.is_strict else self.tolerance,
                row.periodic,
            )
            for row in self.rows
        ]
        return np.array(rows, dtype=np.float64).reshape(-1, 3)

    def limits(self, rows: Sequence[int] | None = None) -> Array:
        """What the functions f_i may be where the constraints number ``rows`` are met, by default all.

        (m, 3): the least and the greatest number, and 1 for angles modulo 2 pi.
        """
        if rows is None:
            return self._limits
        result = self._limits.copy()
        result[[index for index in range(len(result)) if index not in rows], :2] = -inf, inf
        return result

    def bounds(self, low: Array, high: Array) -> list[Interval]:
        """Bounds of the functions f_i over boxes (n, 3) of attitudes, headings within [-pi, pi]."""
        go_on(self._should_stop)
        if self.table is not None:
            ends = bounds_at(self.table, self._limits, low, high)
            return [Interval(*pair) for pair in zip(*ends, strict=True)]
        with np.errstate(all='ignore'):
            state = [Interval(low[:, axis], high[:, axis]) for axis in range(len(COMPONENTS))]
            values = self._tape.run(state, Interval.constant)
            return [row.bounds(values[row.left], values[row.right]) for row in self.rows]

    def possible(self, low: Array, high: Array, limits: Array) -> NDArray[np.bool_]:
        """Which boxes (n, 3) of attitudes may hold one whose functions f_i are within ``limits``."""
        if self.table is not None:
            go_on(self._should_stop)
            return possible_at(self.table, limits, low, high)
        result = np.ones(len(low), dtype=np.bool_)
        for function, (least, greatest, _) in zip(self.bounds(low, high), limits, strict=True):
            result &= (function.low <= greatest) & (function.high >= least)
        return result

    def position_cells(
        self, x_lo: Array, x_hi: Array, y_lo: Array, y_hi: Array
    ) -> NDArray[np.bool_]:
        """Which boxes of positions (n,) may hold a destination: False where provably none does."""
        return possible_positions(self, x_lo, y_lo, x_hi, y_hi)

    @cached_property
    def _places(self) -> dict[Bounds, Array]:
        return {}

    def places(self, bounds: Bounds) -> Array:
        """Equal boxes (n, 4) in ``bounds`` that hold nearly all destinations, the same for all starts.

        Where nothing may hold one, the boxes cover all of it. See `possible_cells`.
        """
        if bounds not in self._places:
            loose = self._starting_with(self.start, _LOOSE)
            cells = possible_cells(loose, bounds, most=_MOST_PLACES)
            self._places[bounds] = cells if len(cells) else possible_cells(loose, bounds, [])
        return self._places[bounds]

    def contradiction(self, bounds: Bounds) -> str | None:
        """A sentence when provably no attitude within ``bounds`` satisfies the program."""
        return contradiction(self, bounds)

    def only(self, rows: Sequence[int]) -> Program:
        """The program with only the constraints number ``rows``."""
        part = copy(self)
        for name in ('table', 'conditions', 'uses_heading', '_limits', '_allowed', '_places'):
            vars(part).pop(name, None)
        part.rows = tuple(self.rows[index] for index in rows)
        part.constraints = tuple(row.text for row in part.rows)
        return part

    def position(self, label: str) -> tuple[float, float]:
        """Where [m] an object, or an agent that does not move, is."""
        if label in self._fields:
            return self._fields[label]['x'], self._fields[label]['y']
        return self.start[label].x, self.start[label].y

    def violations(self, states: Array) -> Array:
        """By how much ``states`` (n, 3) miss each of the m constraints: (n, m), 0 where it holds.

        An undefined angle is off by pi, any other undefined number by infinity.
        """
        if self.table is not None:
            return violations_at(self.table, self.conditions, np.ascontiguousarray(states))
        result = np.empty((len(states), len(self.rows)))
        functions = self.functions(states)
        for index, (row, function) in enumerate(zip(self.rows, functions, strict=True)):
            result[:, index] = row.missed(function.value)
        return result

    def satisfied(self, states: Array) -> NDArray[np.bool_]:
        """Which of ``states`` (n, 3) meet all constraints, within ``tolerance`` unless strict."""
        return self.meets(self.violations(states))

    def meets(self, violations: Array) -> NDArray[np.bool_]:
        """Which of the rows of ``violations`` (n, m) mean that all constraints are met."""
        return np.asarray((violations <= self._allowed).all(axis=1))

    @cached_property
    def _allowed(self) -> Array:
        return np.array([0.0 if row.is_strict else self.tolerance for row in self.rows])

    def _missed_at(self, attitude: Attitude) -> list[float]:
        (missed,) = self.violations(np.array([[attitude.x, attitude.y, attitude.heading]]))
        return [float(by) for by in missed.tolist()]

    def residuals(self, attitude: Attitude, tolerance: float = ENOUGH) -> tuple[Residual, ...]:
        """How well ``attitude`` meets each constraint; strict ones allow no ``tolerance``."""
        return tuple(
            Residual(row.text, by, by <= (0.0 if row.is_strict else tolerance))
            for row, by in zip(self.rows, self._missed_at(attitude), strict=True)
        )

    def holds_at(self, attitude: Attitude) -> bool:
        """Whether ``attitude`` meets all constraints, strict ones exactly and others nearly."""
        pairs = zip(self.rows, self._missed_at(attitude), strict=True)
        return all(by <= (0.0 if row.is_strict else ENOUGH) for row, by in pairs)

    def unmet(self, attitude: Attitude) -> tuple[str, ...]:
        """A sentence for each constraint that ``attitude`` misses, with the value that it has."""
        state = np.array([[attitude.x, attitude.y, attitude.heading]])
        return tuple(
            f'{row.text} not met: {row.shown(left)}'
            for row, (left, _), residual in zip(
                self.rows, self.sides(state), self.residuals(attitude), strict=True
            )
            if not residual.satisfied
        )

    @property
    def depends_on_attitude(self) -> bool:
        """Whether any constraint speaks of the attitude of the agent that moves."""
        return any(
            self._tape.constant(slot) is None for row in self.rows for slot in (row.left, row.right)
        )

    def _row(self, item: Constraint | Condition) -> Row:
        constraint, periodic = compared(item, self.agents)
        return Row(
            text=to_text(item),
            constraint=constraint,
            comparator=constraint.comparator,
            left=self._tape.slot(constraint.left),
            right=self._tape.slot(constraint.right),
            periodic=periodic,
        )
