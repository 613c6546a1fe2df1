"""The parameters of the interface node, each declared once, and a checked snapshot of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any


@dataclass(frozen=True, slots=True)
class ParameterSpec:
    """One parameter: a text, or a number within ``minimum`` and ``maximum``."""

    name: str
    default: float | str
    description: str
    unit: str = ''
    minimum: float = 0.0
    maximum: float = 0.0

    @property
    def range_text(self) -> str:
        """The range for people; empty for a text."""
        if isinstance(self.default, str):
            return ''
        return f'{self.minimum:g} to {self.maximum:g} {self.unit}'.strip()

    def complaint(self, value: Any) -> str:
        """What is wrong with the value, in a sentence; empty when it can be used."""
        if isinstance(self.default, str):
            return '' if isinstance(value, str) else f'{self.name} must be a text, not {value!r}'
        is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
        if is_number and self.minimum <= value <= self.maximum:
            return ''
        return f'{self.name} must be a number from {self.range_text}, not {value!r}'


def _parameter(
    default: Any, description: str, *, unit: str = '', minimum: float = 0.0, maximum: float = 0.0
) -> Any:
    return field(
        default=default,
        metadata={
            'default': default,
            'description': description,
            'unit': unit,
            'minimum': minimum,
            'maximum': maximum,
        },
    )


@dataclass(frozen=True, slots=True)
class Parameters:
    """A consistent set of values: what one mission is planned with."""

    output_directory: str = _parameter(
        '', 'where the files of a mission go that names no directory itself; empty for no files'
    )
    path_spacing: float = _parameter(
        1.0,
        'distance between two poses of the published path',
        unit='m',
        minimum=0.01,
        maximum=1000.0,
    )
    map_resolution: float = _parameter(
        1.0,
        'side of a cell of the published map; grows where the map would take 4 million cells',
        unit='m',
        minimum=0.01,
        maximum=1000.0,
    )
    peer_timeout: float = _parameter(
        3.0,
        'how long to wait for the motion planner and the task planner to answer at all',
        unit='s',
        minimum=0.1,
        maximum=60.0,
    )
    service_timeout: float = _parameter(
        30.0,
        'how long the motion planner may take to check and load a world',
        unit='s',
        minimum=0.1,
        maximum=600.0,
    )
    cancel_timeout: float = _parameter(
        0.8,
        'how long to wait for the task planner to stop when a mission is cancelled',
        unit='s',
        maximum=10.0,
    )
    recording_timeout: float = _parameter(
        2.0,
        'how long to wait for the last planning events before a recording is closed',
        unit='s',
        maximum=10.0,
    )


#: The table, in the order of the declaration.
PARAMETERS = tuple(ParameterSpec(row.name, **row.metadata) for row in fields(Parameters))


def checked(values: Mapping[str, object]) -> Parameters:
    """A snapshot of the values, those not given at their defaults.

    Raises ValueError with a sentence for each wrong value; names of other parameters are ignored.
    """
    given: dict[ParameterSpec, Any] = {
        spec: values.get(spec.name, spec.default) for spec in PARAMETERS
    }
    wrong = [complaint for spec, value in given.items() if (complaint := spec.complaint(value))]
    if wrong:
        raise ValueError('; '.join(wrong))
    good: dict[str, Any] = {
        spec.name: value if isinstance(value, str) else float(value)
        for spec, value in given.items()
    }
    return Parameters(**good)


def table() -> str:
    """The parameters for a person at a terminal: name, default, range and meaning."""
    rows = []
    for spec in PARAMETERS:
        span = f' ({spec.range_text})' if spec.range_text else ''
        rows.append(f'  {spec.name}, default {spec.default!r}{span}\n      {spec.description}\n')
    return ''.join(rows)


def markdown() -> str:
    """The parameters as docs/parameters.md has them."""
    lines = ['| parameter | type | default | range | meaning |', '|---|---|---|---|---|']
    for spec in PARAMETERS:
        kind = 'text' if isinstance(spec.default, str) else 'number'
        unit = f' [{spec.unit}]' if spec.unit else ''
        span = '' if kind == 'text' else f'{spec.minimum:g} to {spec.maximum:g}'
        default = spec.default if isinstance(spec.default, float) else repr(spec.default)
        lines.append(f'| `{spec.name}` | {kind}{unit} | {default} | {span} | {spec.description} |')
    return '\n'.join(lines) + '\n'
