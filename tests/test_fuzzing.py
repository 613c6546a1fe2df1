"""Texts that nobody would write: read or refused with words and a place, at once."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from itertools import count, islice

import pytest

from experiments.fuzz import PATIENCE, Reader, Texts, fuzz, time_limit
from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.language import parse
from motion_planner_node.planning.check import check_text

STATED = '(agent rover0)(object a)'


@pytest.fixture(scope='module')
def reader() -> Reader:
    """Knows the map of the constraint sets."""
    return Reader()


@pytest.fixture(autouse=True)
def what_others_left() -> Iterator[None]:
    """Memory that other tests left behind is not looked through while texts are timed."""
    gc.collect()
    gc.freeze()
    yield
    gc.unfreeze()


def test_broken_texts_are_read_or_refused() -> None:
    """``make fuzz`` tries 100,000."""
    valid, contradictions, longest = fuzz(seed=20, count=2000)
    assert valid > 20, 'hardly a text is without errors: the fuzzing reaches the parser only'
    assert contradictions > 20
    assert longest < PATIENCE


def test_the_texts_of_a_seed_are_the_same_again() -> None:
    first, again, other = (list(islice(Texts(seed), 50)) for seed in (1, 1, 2))
    assert first == again
    assert first != other


def test_a_text_that_takes_too_long_is_noticed() -> None:
    with pytest.raises(TimeoutError), time_limit():
        sum(1 for _ in count())


@pytest.mark.parametrize(
    'text',
    [
        STATED + '(rover0.x = nan)',
        STATED + '(rover0.x = NaN)',
        STATED + '(rover0.x = inf)',
        STATED + '(rover0.x <= -infinity)',
        STATED + '(rover0.x = 1e999)',
        STATED + f'(rover0.x = {"9" * 400})',
        STATED + '(rover0.x = 1e308 * 1e308)',
        STATED + '(rover0.x = 1e308 + 1e308 - 1e308)',
        STATED + '(rover0.x = 0 / 0)',
        STATED + '(setProperty(rover0.x, 1e308 * 10))',
        STATED + f'(rover0.x = {"(" * 10_000}1{")" * 10_000})',
        STATED + f'(rover0.x = {"-" * 10_000}1)',
        STATED + f'(rover0.x = {"deg(" * 10_000}1{")" * 10_000})',
        STATED + f'(rover0.x = {"1+" * 10_000}1)',
        STATED + f'(rover0.x = {"1*" * 10_000}1)',
        '(' * 10_000,
        ')' * 10_000,
        '(' * 500_000 + ')' * 500_000,
        ' ' * 1_000_000,
        ';' * 1_000_000,
        'x' * 1_000_000,
        '9' * 1_000_000,
        STATED + '(rover0.x = 1)' * 70_000,
        'x' * 60_000,
        STATED + '(rover0.x = 1)' * 4_000,
        STATED + '(rover0.x \0 1)',
        STATED + '(rover0.x = \ud800)',
        STATED + '(rover0.x = \u0661)',
        '\ufeff' + STATED,
    ],
    ids=lambda text: ascii(text[len(STATED) :][:24]) + f'_{len(text)}',
)
def test_what_cannot_be_is_refused_with_a_place_and_words(reader: Reader, text: str) -> None:
    with time_limit():
        assert not reader.read(text)
    with time_limit():
        result = check_text(text, reader.world)
    assert not result.valid
    for remark in result.diagnostics:
        assert remark.message
        assert remark.line == 1
        assert remark.column >= 1
        assert len(str(remark)) < 500


def test_numbers_at_the_ends_of_the_range_are_read() -> None:
    parse(STATED + '(rover0.x <= 1e308)(rover0.y >= 5e-324)(rover0.x >= -1.7976931348623157e308)')
    with pytest.raises(MotionPlannerError):
        parse(STATED + '(rover0.x <= 1.8e308)')
