"""Parameters: each declared once, wrong ones refused with a sentence, and all of them documented."""

from __future__ import annotations

from math import inf, nan
from pathlib import Path

import pytest

from interface_node.parameters import PARAMETERS, Parameters, checked, markdown, table


def test_the_defaults_are_good() -> None:
    assert checked({}) == Parameters()
    assert checked({spec.name: spec.default for spec in PARAMETERS}) == Parameters()


def test_values_are_taken_and_whole_numbers_become_floats() -> None:
    parameters = checked({'path_spacing': 2, 'output_directory': 'out', 'use_sim_time': True})
    assert parameters == Parameters(output_directory='out', path_spacing=2.0)
    assert isinstance(parameters.path_spacing, float)


@pytest.mark.parametrize('value', [-1, 0.0, 1e9, nan, inf, True, '1', None, [1.0]])
def test_a_wrong_number_is_refused_by_name(value: object) -> None:
    with pytest.raises(ValueError, match=r'map_resolution must be a number from 0\.01 to 1000 m'):
        checked({'map_resolution': value})


def test_all_wrong_values_are_told_at_once() -> None:
    with pytest.raises(ValueError, match=r'output_directory must be a text.*; path_spacing'):
        checked({'path_spacing': -1, 'output_directory': 3})


def test_every_parameter_is_documented() -> None:
    documented = Path(__file__).parents[3] / 'docs' / 'parameters.md'
    assert markdown() in documented.read_text(encoding='utf-8')
    assert all(spec.name in table() for spec in PARAMETERS)
