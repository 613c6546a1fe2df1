"""The table of parameters: what it accepts, and that the documentation says the same."""

from __future__ import annotations

from math import inf, nan
from pathlib import Path

import pytest

from motion_planner_node.parameters import (
    ParameterError,
    Parameters,
    markdown,
    read_parameters,
    specifications,
)

DOCUMENT = Path(__file__).resolve().parents[3] / 'docs' / 'parameters.md'


def test_nothing_named_gives_the_defaults() -> None:
    assert read_parameters({}) == Parameters()


def test_every_default_and_every_limit_is_accepted() -> None:
    for row in specifications():
        assert row.accept(row.default) == row.default
        if row.low is not None and row.high is not None:
            kind = type(row.default)
            assert row.accept(kind(row.low)) == kind(row.low)
            assert row.accept(kind(row.high)) == kind(row.high)


def test_a_whole_number_will_do_for_a_number() -> None:
    value = read_parameters({'time_budget': 50}).time_budget
    assert value == 50.0
    assert isinstance(value, float)


@pytest.mark.parametrize(
    ('name', 'value', 'expected'),
    [
        ('time_budget', 'soon', "must be a number from 0.001 to 3600 s, not 'soon'"),
        ('time_budget', nan, 'not nan'),
        ('time_budget', inf, 'not inf'),
        ('time_budget', 0.0, 'not 0.0'),
        ('rounds', 2.5, 'must be an integer from 1 to 1000, not 2.5'),
        ('rounds', True, 'not True'),
        ('rounds', 1001, 'not 1001'),
        ('world', 3, 'must be a text, not 3'),
        ('planner', 'teleport', 'must be one of default, direct, '),
        ('colour', 3, 'there is no parameter colour'),
    ],
)
def test_a_wrong_value_is_refused_with_a_sentence(name: str, value: object, expected: str) -> None:
    with pytest.raises(ParameterError, match=name) as refused:
        read_parameters({name: value})
    assert expected in str(refused.value)


def test_the_documentation_holds_the_table() -> None:
    assert markdown() in DOCUMENT.read_text(encoding='utf-8')
