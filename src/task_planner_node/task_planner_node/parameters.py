"""The parameters of the task planner: one table, and a frozen snapshot of checked values."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, get_args

Number = int | float
Guidance = Literal['tour', 'nearest_first']
GUIDANCES: tuple[Guidance, ...] = get_args(Guidance)


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter: a whole number when ``default`` is one, else a real number."""

    name: str
    default: Number
    unit: str
    lowest: Number
    highest: Number
    description: str


@dataclass(frozen=True, slots=True)
class Choice:
    """A parameter that is one of the words ``choices``."""

    name: str
    default: str
    choices: tuple[str, ...]
    description: str
    unit: str = ''


PARAMETERS = (
    Parameter('time_budget', 60.0, 's', 0.1, 86400.0, 'wall clock of a mission that names none'),
    Parameter(
        'max_alternatives', 4, '', 1, 1000, 'destinations tried per geometric request, unless named'
    ),
    Parameter(
        'max_depth', 1_000_000, '', 100, 20_000_000, 'decompositions and actions of one plan'
    ),
    Parameter(
        'memory_limit', 4096, 'MiB', 64, 1_000_000, 'memory that a search may take for itself'
    ),
    Parameter(
        'request_time_budget', 5.0, 's', 0.1, 3600.0, 'wall clock granted to one geometric request'
    ),
    Parameter(
        'service_timeout', 4.0, 's', 0.1, 600.0, 'wait for the services of the motion planner'
    ),
    Choice('guidance', 'tour', GUIDANCES, 'order of tasks that advice is asked for, unless named'),
)


@dataclass(frozen=True, slots=True)
class Parameters:
    """Checked values of PARAMETERS, by the same names."""

    time_budget: float = 60.0
    max_alternatives: int = 4
    max_depth: int = 1_000_000
    memory_limit: int = 4096
    request_time_budget: float = 5.0
    service_timeout: float = 4.0
    guidance: Guidance = 'tour'


def read_parameters(values: Mapping[str, object]) -> Parameters:
    """Check ``values``; those that are not given keep their defaults.

    Raises ValueError with a sentence that names the parameter, its unit and its range.
    """
    checked = {
        p.name: _check(p, values.get(p.name, p.default))
        for p in PARAMETERS
        if isinstance(p, Parameter)
    }
    guidance = values.get('guidance', 'tour')
    return Parameters(
        float(checked['time_budget']),
        int(checked['max_alternatives']),
        int(checked['max_depth']),
        int(checked['memory_limit']),
        float(checked['request_time_budget']),
        float(checked['service_timeout']),
        read_guidance(guidance, f'parameter guidance has to be one of {", ".join(GUIDANCES)}'),
    )


def read_guidance(
    wanted: object, rule: str = f'options.guidance has to be empty or one of {", ".join(GUIDANCES)}'
) -> Guidance:
    """The order of tasks that advice is asked for; raises ValueError with the ``rule`` for any other word."""
    for guidance in GUIDANCES:
        if wanted == guidance:
            return guidance
    raise ValueError(f'{rule}, not {wanted!r}')


def read_time_budget(wanted: float) -> float:
    """The wall clock [s] that a mission asks for, 0 when it leaves that to the node.

    Raises ValueError with a sentence for what is no amount of time.
    """
    if math.isfinite(wanted) and wanted >= 0:
        return wanted
    raise ValueError(
        f'options.time_budget has to be a finite number of seconds, not negative, and 0 for the '
        f"node's default: not {wanted:g}"
    )


def _check(parameter: Parameter, value: object) -> Number:
    whole = isinstance(parameter.default, int)
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if (
        isinstance(value, (int, float))
        and number
        and math.isfinite(value)
        and (not whole or value == int(value))
        and parameter.lowest <= value <= parameter.highest
    ):
        return value
    kind = 'a whole number' if whole else 'a number'
    unit = f' {parameter.unit}' if parameter.unit else ''
    raise ValueError(
        f'parameter {parameter.name} has to be {kind} from {parameter.lowest:g} to '
        f'{parameter.highest:g}{unit}, not {value!r}: {parameter.description}'
    )
