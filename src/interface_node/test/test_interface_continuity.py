"""A plan whose steps do not fit together is found out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import inf, nan, pi

import pytest

from interface_node.continuity import faults, same
from interface_node.plan import Attitude, Plan, Segment, Step


def changed(plan: Plan, index: int, change: Callable[[Step], Step]) -> Plan:
    steps = list(plan.steps)
    steps[index] = change(steps[index])
    return replace(plan, steps=tuple(steps))


def shifted(attitude: Attitude | None, x: float) -> Attitude:
    assert attitude is not None
    return replace(attitude, x=attitude.x + x)


def test_a_plan_that_fits_has_no_faults(sample_plan: Plan) -> None:
    assert list(faults(sample_plan)) == []


@pytest.mark.parametrize(
    ('index', 'change', 'words'),
    [
        (1, lambda s: replace(s, state={'rover0': shifted(s.end, 0)}), 'starts with rover0 at'),
        (2, lambda s: replace(s, state={'rover0': Attitude(nan, 0, 0)}), 'starts with rover0 at'),
        (1, lambda s: replace(s, motion_start=shifted(s.motion_start, 1e-3)), 'drives from'),
        (3, lambda s: replace(s, end=shifted(s.end, 1e-4)), 'drives to'),
        (
            2,
            lambda s: replace(s, state={'rover0': replace(s.state['rover0'], heading=inf)}),
            'starts with rover0 at',
        ),
        (3, lambda s: replace(s, end=None), 'says nothing of where rover0 ends'),
        (3, lambda s: replace(s, length=s.length + 1), 'is said to be'),
        (3, lambda s: replace(s, length=nan), 'is said to be'),
        (3, lambda s: replace(s, agent='rover9'), 'the world does not have'),
        (3, lambda s: replace(s, segments=(Segment(0.0, inf),)), 'that rover0 cannot drive'),
        (0, lambda s: replace(s, assigned=False), 'stands nowhere yet'),
    ],
)
def test_every_fault_is_told(
    sample_plan: Plan, index: int, change: Callable[[Step], Step], words: str
) -> None:
    told = list(faults(changed(sample_plan, index, change)))
    assert told
    assert words in told[0]
    assert told[0].startswith(f'step {index + 1},')


def test_headings_are_directions() -> None:
    assert same(Attitude(0.0, 0.0, pi), Attitude(0.0, 0.0, -pi + 1e-9))
    assert not same(Attitude(0.0, 0.0, 0.0), Attitude(0.0, 0.0, 1e-3))
