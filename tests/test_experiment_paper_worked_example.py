"""The paper's worked example, its table of derived codes, and descents over the penalty, in a reduced form."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from experiments.paper import worked_example
from experiments.paper.derived_codes import checks
from experiments.paper.part import Part
from experiments.pictures import penalty
from experiments.pictures.penalty import iterates
from experiments.pictures.solver import EXAMPLE, RING


@pytest.fixture(scope='module')
def example(tmp_path_factory: pytest.TempPathFactory) -> tuple[Part, Path]:
    folder = tmp_path_factory.mktemp('example')
    return worked_example.measure(worked_example.QUICK, 1, folder), folder


def test_the_worked_example_is_the_papers_but_for_its_rounding(
    example: tuple[Part, Path],
) -> None:
    part, folder = example
    figures = part.figures['worked_example']
    assert figures['r1'] == pytest.approx([39.7101, 67.1499, 0.0], abs=1e-4)
    assert figures['distance'] == pytest.approx(20.0)
    assert figures['step_length'] == 1.0
    assert figures['default_distance'] <= 20.0
    assert figures['least_penalty_with_printed_signs'] == pytest.approx(25.0)
    assert all(target.met for target in part.targets)
    assert '39.7101' in part.text
    for name in ('penalty.svg', 'penalty.png', 'table_2.csv'):
        assert (folder / name).stat().st_size > 0


def test_all_descents_that_are_drawn_are_counted_and_end_within_the_constraints(
    example: tuple[Part, Path],
) -> None:
    told = example[0].figures['descents']
    count = worked_example.QUICK.descents
    for mode in penalty.MODES:
        ends = [
            penalty.violation(penalty.descents(mode, penalty.starts(count, 1, heading)))
            for heading in (None, 0.0)
        ]
        assert len(told['steps'][mode]) == 2 * count
        assert told['greatest_violation'][mode] == max(ends) < 1e-8
    begun = [np.array([[20.0, 270.0, 0.0]])]
    assert penalty.violation(begun) > 10.0


def test_derived_codes_agree_with_differences_and_a_wrong_one_does_not(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    found = checks(300, 5)
    printed = [check for check in found if not math.isnan(check.printed)]
    assert len(printed) == 4
    assert all(check.printed < 1e-6 and check.kept for check in printed)
    assert all(check.library < 1e-6 for check in found)
    assert not any(check.kept for check in found if math.isnan(check.printed))
    wrong = {('distance f1', 'x'): lambda dx, dy, _: dx / np.hypot(dx, dy)}
    monkeypatch.setattr('experiments.paper.derived_codes.DERIVED', wrong)
    assert max(check.printed for check in checks(300, 5) if not math.isnan(check.printed)) > 1.0


def test_iterates_of_the_default_descent_end_where_the_constraints_are_met() -> None:
    program = EXAMPLE.program(RING)
    states = iterates(program, np.array([20.0, 100.0, 0.0]))
    assert states[0].tolist() == [20.0, 100.0, 0.0]
    assert len(states) >= 2
    assert math.dist(states[-1][:2], (50.0, 50.0)) <= 20.0
