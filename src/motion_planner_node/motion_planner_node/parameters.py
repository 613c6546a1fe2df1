"""Every parameter of the motion planner, declared once: type, unit, range and description."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from math import isfinite
from typing import Any

from motion_planner_node.paths import DEFAULT_PLANNER, PLANNERS

#: How destinations can be computed.
DEFAULT_MODE, PAPER_MODE = MODES = ('default', 'paper')


class ParameterError(ValueError):
    """A parameter has a value that it cannot have; the message is a sentence for people."""


@dataclass(frozen=True, slots=True)
class Specification:
    """One row of the table: ``low`` and ``high`` are inclusive and absent for texts.

    A text with ``choices`` is one of them.
    """

    name: str
    default: str | int | float
    unit: str
    description: str
    low: float | None = None
    high: float | None = None
    read_only: bool = False
    choices: tuple[str, ...] = ()

    @property
    def kind(self) -> str:
        """What a person calls the type."""
        return {str: 'text', int: 'integer', float: 'number'}[type(self.default)]

    def accept(self, value: object) -> str | int | float:
        """Return ``value`` as the type of the parameter; a whole number will do for a number.

        :raises ParameterError: with a sentence, when the type or the range is wrong
        """
        if isinstance(self.default, str):
            if isinstance(value, str) and (not self.choices or value in self.choices):
                return value
        elif not isinstance(value, bool) and isinstance(value, int | float) and isfinite(value):
            if isinstance(self.default, float):
                value = float(value)
            if isinstance(value, type(self.default)) and self._in_range(value):
                return value
        raise ParameterError(f'parameter {self.name} must be {self.expected}, not {value!r}')

    @property
    def expected(self) -> str:
        """The values that are accepted, in words."""
        if self.choices:
            return f'one of {", ".join(self.choices)}'
        if self.low is None or self.high is None:
            return 'a text'
        article = 'an' if self.kind == 'integer' else 'a'
        unit = f' {self.unit}' if self.unit else ''
        return f'{article} {self.kind} from {self.low:g} to {self.high:g}{unit}'

    def _in_range(self, value: float) -> bool:
        return self.low is not None and self.high is not None and self.low <= value <= self.high


def _parameter(
    default: Any,
    description: str,
    *,
    unit: str = '',
    low: float | None = None,
    high: float | None = None,
    read_only: bool = False,
    choices: tuple[str, ...] = (),
) -> Any:
    return field(
        default=default,
        metadata={
            'unit': unit,
            'description': description,
            'low': low,
            'high': high,
            'read_only': read_only,
            'choices': choices,
        },
    )


@dataclass(frozen=True, slots=True)
class Parameters:
    """A consistent set of values: what the motion planner works with."""

    world: str = _parameter(
        '',
        'file with the world to start with, as in docs/world.md; empty to wait for set_world',
        read_only=True,
    )
    map_topic: str = _parameter(
        '',
        'topic of a latched nav_msgs/OccupancyGrid to add to each world; empty for none',
        read_only=True,
    )
    time_budget: float = _parameter(
        10.0,
        'wall clock for one request that names no budget of its own',
        unit='s',
        low=0.001,
        high=3600.0,
    )
    mode: str = _parameter(
        DEFAULT_MODE,
        'how destinations are computed: compiled descents that keep out of obstacles, or the '
        "paper's Algorithm 1 to the letter (docs/solver.md)",
        choices=MODES,
    )
    paper_tries: int = _parameter(
        64, 'maxTries of Algorithm 1: descents of a request in mode paper', low=1, high=100000
    )
    paper_steps: int = _parameter(
        100, 'maxK of Algorithm 1: steps of one descent in mode paper', low=1, high=100000
    )
    destinations: int = _parameter(
        24, 'destination attitudes looked for in one round of restarts', low=1, high=4096
    )
    rounds: int = _parameter(
        4, 'rounds of restarts before a request is given up as UNKNOWN', low=1, high=1000
    )
    failures_per_answer: int = _parameter(
        128,
        'destinations without a path before a request is given up as UNKNOWN',
        low=1,
        high=100000,
    )
    planner: str = _parameter(
        DEFAULT_PLANNER,
        'how paths are planned (docs/motion-planning.md)',
        choices=tuple(PLANNERS),
    )
    path_attitudes: int = _parameter(
        20000,
        'attitudes that the default planner looks at in one search; four times as many when it '
        'looks more closely',
        low=100,
        high=1000000,
    )
    path_iterations: int = _parameter(
        2000, 'iterations of a sampling planner in one search', low=10, high=10000000
    )
    path_refinements: int = _parameter(
        1,
        'times that a better destination is looked for along a path that was found',
        low=0,
        high=100,
    )
    alternative_distance: float = _parameter(
        10.0,
        'two destinations this far apart are different alternatives',
        unit='m',
        low=0.001,
        high=100000.0,
    )
    alternative_heading: float = _parameter(
        0.75,
        'two destinations whose headings differ by this much are different alternatives',
        unit='rad',
        low=0.001,
        high=3.14,
    )
    cache_size: int = _parameter(
        256,
        'requests and candidates whose work is kept to answer the next one sooner',
        low=1,
        high=100000,
    )


def specifications() -> tuple[Specification, ...]:
    """The table, in the order of the declaration."""
    rows: list[tuple[str, Any, Mapping[str, Any]]] = [
        (row.name, row.default, row.metadata) for row in fields(Parameters)
    ]
    return tuple(Specification(name, default, **metadata) for name, default, metadata in rows)


def read_parameters(values: Mapping[str, object]) -> Parameters:
    """Check ``values`` by name and return them as a set; what is not named has its default.

    :raises ParameterError: for an unknown name, a wrong type or a value out of range
    """
    table = {row.name: row for row in specifications()}
    for name in values:
        if name not in table:
            raise ParameterError(f'there is no parameter {name}; there are {", ".join(table)}')
    accepted: dict[str, Any] = {name: table[name].accept(value) for name, value in values.items()}
    return Parameters(**accepted)


def markdown() -> str:
    """The table as docs/parameters.md holds it."""
    lines = [
        '| parameter | type | default | range | meaning |',
        '|---|---|---|---|---|',
    ]
    for row in specifications():
        default = f'{row.default:g}' if isinstance(row.default, float) else repr(row.default)
        span = ', '.join(row.choices) if row.low is None else f'{row.low:g} to {row.high:g}'
        unit = f' [{row.unit}]' if row.unit else ''
        fixed = '; fixed once the node runs' if row.read_only else ''
        lines.append(
            f'| `{row.name}` | {row.kind}{unit} | {default} | {span} | {row.description}{fixed} |'
        )
    return '\n'.join(lines) + '\n'
