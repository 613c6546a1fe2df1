"""Broken texts of geometric preconditions by the thousand: each is read, or refused politely.

``make fuzz`` tries 100,000 of them. Texts come from a seed, so that a failure can be had again.
"""

from __future__ import annotations

import argparse
import random
import re
import signal
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

from experiments.constraints.search import Bench
from experiments.constraints.sets import AGENT, read_sets
from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.language import check, parse, to_text
from motion_planner_node.planner import warm_up
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.satisfaction import DescentOptions, compile_program, descend
from motion_planner_node.world.model import World

#: [s] of processor time that one text may take.
PATIENCE = 1.0
#: Descents that look for an attitude that meets what the checker calls a contradiction.
STARTS = 8

FIGURE_2 = """((agent ?r)(object ?o)
(setProperty(?r.x,?o.x))
(setProperty(?r.y,?o.y))
(setProperty(?r.heading,0)))"""
FIGURE_3 = """((agent ?r)(object ?o)
(distance(?r, ?o) >= 50)
(distance(?r, ?o) <= 100)
(rel_angle(?r,?o) = cos-and-sin(pi/2)))"""
LOOSE = '(agent rover0) setProprety(rover0.x, -1e2) ; a comment\nrover0.x-2 < deg(.5)'
TOKENS: tuple[str, ...] = (
    *'()(),.;?+-*/<>=!_#"\'\\|{}[]:@ \n\t\r',
    *(
        '<=',
        '>=',
        '!=',
        '==',
        '=>',
        '((',
        '))',
        '--',
        '?',
        'pi',
        'pie',
        'nan',
        'inf',
        '-inf',
        'NaN',
    ),
    *(
        '1e999',
        '1e308',
        '-1e308',
        '5e-324',
        '0',
        '-0',
        '1/0',
        '0x10',
        '1_000',
        '1e',
        '.',
        '9' * 400,
    ),
    *('agent', 'object', '(agent rover0)', '(object a)', 'rover0', 'rover0.x', 'a.reach', '?o.'),
    *('distance(', 'rel_angle(rover0, a)', 'cos-and-sin(', 'deg(', 'setProperty(', 'cos-and-sin'),
    *(
        '\0',
        '\x7f',
        '\u2264',
        '\u00e9',
        '\u0661',
        '\u200b',
        '\ufeff',
        '\U0001f680',
        '\ud800',
        '\u2028',
    ),
)
WORD = re.compile(r'[\w.?-]+|[^\w\s]')
COMPARATOR = re.compile(r'[<>]=?|!?=')
COMPARATORS = ('<', '<=', '>', '>=', '=', '!=')


class Texts:
    """An endless supply of broken texts, the same for the same ``seed``."""

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)
        sets = read_sets()
        self._origins = (FIGURE_2, FIGURE_3, LOOSE, *(constraints.text for constraints in sets))
        labels = {
            f'({concept} {label})'
            for each in sets
            for concept, known in (
                ('agent', each.agents),
                ('object', each.objects),
                ('region', each.regions),
            )
            for label in known
        }
        self._statements = ''.join(sorted(labels))
        self._constraints = tuple(text for each in sets for text in each.constraints)
        self._mutations: tuple[Callable[[str], str], ...] = (
            self._without,
            self._with_token,
            self._with_token_instead,
            self._with_another_word,
            self._with_another_word,
            self._with_another_word,
            self._recombined,
            self._swapped,
            self._repeated,
            self._cut,
            self._spliced,
            self._nested,
        )

    def __iter__(self) -> Iterator[str]:
        while True:
            text = self._random.choice(self._origins)
            for _ in range(self._random.choice((1, 1, 2, 3, 5, 12))):
                text = self._random.choice(self._mutations)(text)
            yield text[:200_000]

    def _span(self, text: str) -> tuple[int, int]:
        """Two indices of ``text``, most often near each other."""
        at = self._random.randint(0, len(text))
        return at, min(len(text), at + int(self._random.expovariate(0.2)))

    def _without(self, text: str) -> str:
        low, high = self._span(text)
        return text[:low] + text[high + 1 :]

    def _with_token(self, text: str) -> str:
        at = self._random.randint(0, len(text))
        return text[:at] + self._random.choice(TOKENS) + text[at:]

    def _with_token_instead(self, text: str) -> str:
        low, high = self._span(text)
        return text[:low] + self._random.choice(TOKENS) + text[high:]

    def _with_another_word(self, text: str) -> str:
        """One word, number or sign replaced by one of the same or another text."""
        words = list(WORD.finditer(text))
        others: list[str] = WORD.findall(self._random.choice((text, *self._origins)))
        if not words or not others:
            return text
        word = self._random.choice(words)
        return text[: word.start()] + self._random.choice(others) + text[word.end() :]

    def _recombined(self, _text: str) -> str:
        """A new text of constraints that may well exclude each other."""
        several = self._random.choices(self._constraints, k=self._random.randint(1, 3))
        several += self._random.choices(several, k=self._random.randint(0, 3))
        changed = (
            COMPARATOR.sub(lambda _: self._random.choice(COMPARATORS), each, count=1)
            if self._random.random() < 0.5
            else each
            for each in several
        )
        return self._statements + ''.join(f'({each})' for each in changed)

    def _swapped(self, text: str) -> str:
        low, high = sorted(self._random.randint(0, len(text)) for _ in range(2))
        return text[high:] + text[low:high] + text[:low]

    def _repeated(self, text: str) -> str:
        low, high = self._span(text)
        times = self._random.choice((2, 2, 3, 10, 200, 3000))
        return text[:low] + text[low:high] * times + text[high:]

    def _cut(self, text: str) -> str:
        at = self._random.randint(0, len(text))
        return text[:at] if self._random.random() < 0.5 else text[at:]

    def _spliced(self, text: str) -> str:
        other = self._random.choice(self._origins)
        at, start = self._random.randint(0, len(text)), self._random.randint(0, len(other))
        return text[:at] + other[start:]

    def _nested(self, text: str) -> str:
        low, high = self._span(text)
        levels = self._random.choice((1, 2, 90, 101, 10_000))
        opening, closing = self._random.choice((('(', ')'), ('-', ''), ('deg(', ')'), ('1+(', ')')))
        return text[:low] + opening * levels + text[low:high] + closing * levels + text[high:]


class Reader:
    """Reads texts to the end: parser, checker, printer and compiler.

    What the checker calls a contradiction must not hold anywhere on the way of a few descents.
    """

    def __init__(self) -> None:
        warm_up()
        bench = Bench()
        self.world: World = bench.world
        self._starts = bench.starts(1, STARTS)
        state = {label: robot.start for label, robot in self.world.robots.items() if robot.start}
        self.contradictions = 0
        self._state = {**state, AGENT: Attitude(400.0, 300.0, 0.0)}

    def read(self, text: str) -> bool:
        """Whether ``text`` is without errors; whatever else happens is a fault of the language."""
        try:
            preconditions = parse(text)
        except MotionPlannerError as error:
            complaints = error.diagnostics
            assert complaints
            assert all(each.message and each.line > 0 and each.column > 0 for each in complaints)
            return False
        written = to_text(preconditions)
        if len(written) < 60_000:
            assert parse(written) == preconditions, 'written and read again, it is another text'
        found = (*check(preconditions, None), *check(preconditions, self.world))
        assert all(each.message for each in found)
        try:
            program = compile_program(preconditions, self.world, self._state)
        except MotionPlannerError as error:
            return not str(error)
        if program.contradictions:
            self.contradictions += 1
            descent = descend(program, self._starts, DescentOptions(retries=0))
            # Within the tolerance of ``=``, ``<`` and ``!=`` of the same number hold beside it.
            holds = descent.satisfied & (descent.violations == 0.0).all(axis=1)
            assert not holds.any(), 'what is called a contradiction holds'
        return not found


@contextmanager
def time_limit() -> Iterator[None]:
    """Break off what takes more than ``PATIENCE`` [s] of processor time."""

    def stop(_signal: int, _frame: FrameType | None) -> None:
        raise TimeoutError(f'more than {PATIENCE} s of processor time')

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, PATIENCE)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
        signal.signal(signal.SIGVTALRM, before)


def fuzz(seed: int, count: int) -> tuple[int, int, float]:
    """Read ``count`` texts: how many had no errors, how many were contradictions, the longest time.

    The time is that of the processor [s] for one text.

    Raises AssertionError with the text and what it did.
    """
    reader, valid, longest = Reader(), 0, 0.0
    for number, text in zip(range(count), Texts(seed), strict=False):
        began = time.process_time()
        try:
            with time_limit():
                valid += reader.read(text)
        except Exception as fault:
            shown = text if len(text) < 2000 else text[:1000] + ' ... ' + text[-1000:]
            message = f'text {number} of seed {seed}: {type(fault).__name__}: {fault}\n{shown!r}'
            raise AssertionError(message) from fault
        longest = max(longest, time.process_time() - began)
    return valid, reader.contradictions, longest


def main() -> int:
    """Fuzz from the command line."""
    parser = argparse.ArgumentParser(description='Read broken texts of geometric preconditions.')
    parser.add_argument('--texts', type=int, default=100_000, help='how many (default: 100000)')
    parser.add_argument('--seed', type=int, default=1, help='where to begin (default: 1)')
    arguments = parser.parse_args()
    try:
        valid, contradictions, longest = fuzz(arguments.seed, arguments.texts)
    except AssertionError as fault:
        print(ascii(str(fault)), file=sys.stderr)
        return 1
    print(
        f'{arguments.texts} texts: {valid} without errors, {contradictions} contradictions, '
        f'the others refused; the slowest took {1e3 * longest:.0f} ms'
    )
    return 0


if __name__ == '__main__':
    sys.exit(main())
