"""What commands make of where everybody stands."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite, isnan

from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic, MotionPlannerError
from motion_planner_node.functions import COMPONENTS, Surroundings
from motion_planner_node.language.printer import to_text
from motion_planner_node.language.syntax import Command, Property
from motion_planner_node.language.tape import Tape
from motion_planner_node.robots.arcs import wrap_angle
from motion_planner_node.robots.motion import Attitude, GeometricState

#: Numbers of objects or agents by label and name.
Fields = Mapping[str, Mapping[str, float]]


def applied(
    commands: Sequence[Command], fields: Fields, surroundings: Surroundings, state: GeometricState
) -> GeometricState:
    """The state after the commands, in their order; what they do not set stays as it is.

    ``fields`` are those of the objects.

    :raises MotionPlannerError: NO_START when an agent is set in part and was nowhere before, or
        a component is read that is not set; INVALID_PRECONDITIONS when a value is not finite
    """
    if not commands:
        return state
    components = components_of(state, tuple(state))
    for command in commands:
        target, expression = command.arguments
        assert isinstance(target, Property)
        tape = Tape('', {**fields, **components}, surroundings)
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


def components_of(state: GeometricState, labels: Sequence[str]) -> dict[str, dict[str, float]]:
    """The components of the attitudes of those ``labels`` that ``state`` has."""
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
