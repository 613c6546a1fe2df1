"""Ground preconditions compiled for the world and the start of one request."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from copy import copy
from functools import cached_property
from math import isfinite, isnan
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic, MotionPlannerError
from motion_planner_node.functions import COMPONENTS, Array, Dual, Interval, surroundings_of
from motion_planner_node.language.check import compared
from motion_planner_node.language.printer import to_text
from motion_planner_node.language.syntax import (
    Command,
    Condition,
    Constraint,
    Preconditions,
    Property,
)
from motion_planner_node.language.tape import Tape
from motion_planner_node.requests import Residual
from motion_planner_node.robots.arcs import wrap_angle
from motion_planner_node.robots.motion import Attitude, GeometricState
from motion_planner_node.satisfaction.bounding import bounds_at
from motion_planner_node.satisfaction.cells import Cells, possible_cells, possible_positions
from motion_planner_node.satisfaction.conflicts import contradiction
from motion_planner_node.satisfaction.evaluation import violations_at
from motion_planner_node.satisfaction.recording import Table, record
from motion_planner_node.satisfaction.row import Row
from motion_planner_node.stopping import ShouldStop, go_on, never
from motion_planner_node.world.model import Bounds, World

#: Violation up to which a constraint counts as met by a destination, in the constraint's unit, for
#: coordinates of ordinary size. Strict comparators have none.
TOLERANCE = 1e-9

#: Violation that restarts allow for: as large as any tolerance, so that they suit all starts.
_LOOSE = 1e-6
#: Boxes of positions that restarts are spread over.
_MOST_PLACES = 256

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
        places = self._fields | _components(self.start, self.agents)
        self._tape = Tape(agent, places, surroundings_of(world))
        self.rows = tuple(self._row(item) for item in preconditions.constraints)
        self.constraints = tuple(row.text for row in self.rows)

    def _begun(self, start: GeometricState) -> tuple[dict[str, Attitude], float]:
        """The state after the commands, and the tolerance with which that can be computed."""
        state = self.apply_commands(start)
        places = self._fields | _components(state, self.agents)
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
        _ = self.table, self._places  # which both programs share
        result = copy(self)
        vars(result).pop('conditions', None)
        result.start, result.tolerance = self._begun(start)
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
        """The state after the commands, in their order; what they do not set stays as it is.

        Raises MotionPlannerError: NO_START when an agent is set in part and was nowhere before, or
        a component is read that is not set; INVALID_PRECONDITIONS when a value is not finite.
        """
        components = _components(state, tuple(state))
        for command in self._preconditions.commands:
            target, expression = command.arguments
            assert isinstance(target, Property)
            tape = Tape('', self._fields | components, surroundings_of(self._world))
            value = tape.constant(tape.slot(expression))
            if value is None or not isfinite(value):
                raise _not_assignable(command, value)
            if target.name == 'heading':
                value = wrap_angle(value)
            components.setdefault(target.owner, {})[target.name] = value
        for label, known in components.items():
            missing = [name for name in COMPONENTS if name not in known]
            if missing:
                raise MotionPlannerError(
                    Code.NO_START,
                    f'the start has no attitude of {label} and no command sets its {missing[0]}',
                )
        return {label: Attitude(**known) for label, known in components.items()}

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

    def bounds(self, x: Interval, y: Interval, heading: Interval) -> list[Interval]:
        """Bounds of the functions f_i over boxes of attitudes, headings within [-pi, pi]."""
        go_on(self._should_stop)
        if self.table is not None:
            low, high = (
                np.column_stack([getattr(component, end) for component in (x, y, heading)])
                for end in ('low', 'high')
            )
            periodic = np.array([row.periodic for row in self.rows], np.float64)
            return [
                Interval(*ends)
                for ends in zip(*bounds_at(self.table, periodic, low, high), strict=True)
            ]
        with np.errstate(all='ignore'):
            values = self._tape.run((x, y, heading), Interval.constant)
            return [row.bounds(values[row.left], values[row.right]) for row in self.rows]

    def position_cells(
        self, x_lo: Array, x_hi: Array, y_lo: Array, y_hi: Array
    ) -> NDArray[np.bool_]:
        """Which boxes of positions (n,) may hold a destination: False where provably none does."""
        return possible_positions(self, Cells(x_lo, x_hi, y_lo, y_hi))

    @cached_property
    def _places(self) -> dict[Bounds, Cells]:
        return {}

    def places(self, bounds: Bounds) -> Cells:
        """Equal boxes within ``bounds`` that hold nearly all destinations, the same for all starts.

        Where nothing may hold one, the boxes cover all of it.
        """
        if bounds not in self._places:
            _ = self.table  # which the copy shares
            loose = copy(self)
            loose.tolerance = _LOOSE
            cells = possible_cells(loose, bounds, most=_MOST_PLACES)
            self._places[bounds] = cells if len(cells) else possible_cells(loose, bounds, [])
        return self._places[bounds]

    def contradiction(self, bounds: Bounds) -> str | None:
        """A sentence when provably no attitude within ``bounds`` satisfies the program."""
        return contradiction(self, bounds)

    def only(self, rows: Sequence[int]) -> Program:
        """The program with only the constraints number ``rows``."""
        part = copy(self)
        for name in ('table', 'conditions', 'uses_heading', '_places'):
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
        allowed = np.array([0.0 if row.is_strict else self.tolerance for row in self.rows])
        return np.asarray((violations <= allowed).all(axis=1))

    def residuals(self, attitude: Attitude, tolerance: float = 1e-6) -> tuple[Residual, ...]:
        """How well ``attitude`` meets each constraint; strict ones allow no ``tolerance``."""
        state = np.array([[attitude.x, attitude.y, attitude.heading]])
        (missed,) = self.violations(state)
        return tuple(
            Residual(row.text, float(by), bool(by <= (0.0 if row.is_strict else tolerance)))
            for row, by in zip(self.rows, missed, strict=True)
        )

    def unmet(self, attitude: Attitude) -> tuple[str, ...]:
        """A sentence for each constraint that ``attitude`` misses, with the value that it has."""
        residuals = self.residuals(attitude)
        if all(residual.satisfied for residual in residuals):
            return ()
        state = np.array([[attitude.x, attitude.y, attitude.heading]])
        return tuple(
            f'{row.text} not met: {row.shown(left)}'
            for row, (left, _), residual in zip(
                self.rows, self.sides(state), residuals, strict=True
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


def _components(state: GeometricState, labels: tuple[str, ...]) -> dict[str, dict[str, float]]:
    return {
        label: {name: getattr(state[label], name) for name in COMPONENTS}
        for label in labels
        if label in state
    }


def _not_assignable(command: Command, value: float | None) -> MotionPlannerError:
    text = to_text(command)
    if value is None or isnan(value):
        return MotionPlannerError(Code.NO_START, f'{text} reads what nothing has set before')
    return MotionPlannerError.from_diagnostics(
        [Diagnostic(f'{text} would set {value}', command.line, command.column, text)]
    )
