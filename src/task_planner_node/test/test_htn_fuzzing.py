"""Texts that nobody would write: domains and problems are read or refused with words and a place, at once."""

from __future__ import annotations

import random
import re
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType

import pytest

from task_planner_node.errors import MissionError, Severity
from task_planner_node.language import Source, check_mission, read_domain, read_problem, reader
from task_planner_node.language.checks import MOST_REMARKS
from task_planner_node.language.reading import MOST_ERRORS
from task_planner_node.mission import MissionText, check_and_compile, read_mission
from task_planner_node.oracle import Oracle

ROOM = Path(__file__).parents[2]
EXAMPLES = Path(__file__).parents[1] / 'domains'
PATIENCE = 20
TOKEN = re.compile(r'\s+|;[^\n]*|[()]|[^\s()]+')
WORDS = [
    *('(', ')', "'", '`', ',', ',@', '.', '?x', '?_', '?', '"', '#|', '|#', '#+', "#'", '|', '\\'),
    *(
        'nil',
        '()',
        't',
        '1',
        '-2.5',
        '1e999',
        '9' * 400,
        ':',
        '::',
        'a::b',
        '!',
        '!!',
        '-',
        '<',
        '=',
    ),
    *(
        'and',
        'or',
        'not',
        'imply',
        'forall',
        'exists',
        'assign',
        'assign*',
        'eval',
        'call',
        'setof',
    ),
    *('enforce', ':first', ':sort-by', ':ordered', ':unordered', ':immediate', ':task', 'when'),
    *(':protection', ':operator', ':op', ':method', ':-', 'Operator', 'defdomain', 'defproblem'),
    *('define', 'domain', 'problem', ':action', ':types', 'either', ':htn', ':ordering', 'lambda'),
    *('(call + ?x 1)', '(forall (?y) (p ?y) (q ?y))', '(:sort-by ?x (p ?x))', '\u0661', '\u00e9'),
]


def texts(folder: Path, pattern: str) -> list[str]:
    return [path.read_text() for path in sorted(folder.rglob(pattern))]


SHOP = [*texts(ROOM / 'interface_node' / 'missions', '*.lisp'), *texts(EXAMPLES, '*.lisp')]
HDDL = [
    (path.read_text(), path.with_name('problem.hddl').read_text())
    for path in sorted(EXAMPLES.rglob('domain.hddl'))
]


@contextmanager
def at_once() -> Iterator[None]:
    """Raise TimeoutError for what takes longer than PATIENCE seconds."""

    def ring(_signal: int, _frame: FrameType | None) -> None:
        raise TimeoutError

    before = signal.signal(signal.SIGALRM, ring)
    signal.alarm(PATIENCE)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def broken(text: str, chance: random.Random) -> str:
    """The text with a few words lost, doubled, exchanged or put in, or a piece cut out."""
    words = TOKEN.findall(text)
    for _ in range(chance.randint(1, 4)):
        place = chance.randrange(len(words))
        kind = chance.randrange(6)
        if kind == 0:
            del words[place]
        elif kind == 1:
            words.insert(place, words[chance.randrange(len(words))])
        elif kind == 2:
            words.insert(place, f' {chance.choice(WORDS)} ')
        elif kind == 3:
            words[place] = chance.choice(WORDS)
        elif kind == 4:
            other = chance.randrange(len(words))
            words[place], words[other] = words[other], words[place]
        else:
            del words[place : place + chance.randint(1, 30)]
        words = words or ['(']
    return ''.join(words)


def check_error(error: MissionError) -> None:
    assert error.diagnostics
    for remark in error.diagnostics:
        assert remark.message
        assert len(str(remark)) < 1000
        assert remark.line >= 0


@pytest.mark.parametrize('seed', range(4))
def test_broken_shop_texts_are_read_or_refused(seed: int) -> None:
    chance = random.Random(seed)
    read = 0
    for _ in range(500):
        text = broken(chance.choice(SHOP), chance)
        with at_once():
            try:
                domain = read_domain(Source('t', text))
                problem = read_problem(Source('p', '(defproblem p () ((a 1)) ())'))
                for remark in check_mission(domain, problem):
                    assert remark.message
                read += 1
            except MissionError as error:
                check_error(error)
            try:
                read_problem(Source('t', text))
            except MissionError as error:
                check_error(error)
    assert read > 20, 'hardly a text is read: the fuzzing stops at the parentheses'


@pytest.mark.parametrize('seed', range(2))
def test_broken_hddl_is_read_or_refused(seed: int, no_motion_planner: Oracle) -> None:
    chance = random.Random(seed)
    read = 0
    for _ in range(300):
        domain, problem = chance.choice(HDDL)
        if chance.random() < 0.7:
            domain = broken(domain, chance)
        else:
            problem = broken(problem, chance)
        with at_once():
            try:
                pair = read_mission(MissionText('d', domain), MissionText('p', problem))
                check_and_compile(*pair, no_motion_planner)
                read += 1
            except MissionError as error:
                check_error(error)
    assert read > 5


@pytest.mark.parametrize(
    'text',
    [
        '(' * 100_000,
        ')' * 100_000,
        "'" * 100_000,
        "(a '" + "'" * 1000 + 'b)',
        '#|' * 100_000,
        '"' * 99_999,
        '|' * 100_001,
        '#' * 100_000,
        '\\' * 100_000,
        ',@' * 100_000,
        'x ' * 100_000,
        'x' * 1_000_000,
        '9' * 1_000_000,
        '?' * 1_000_000,
        ' ' * 1_000_000,
        ';' * 1_000_000,
        '(:method (m) ' + '(' * 190 + ')' * 190 + ' ())',
        '(:method (m) (' + '(not ' * 190 + '(a)' + ')' * 190 + ') ())',
        '(:method (m) () (' + '(:unordered ' * 190 + '(a)' + ')' * 190 + '))',
        '(:operator (!o) () () () ' + '(+ ' * 190 + '1' + ')' * 190 + ')',
        '(:- (a ' + '(' * 190 + ')' * 190 + ') ())',
        '(:method (m) ((call ' + '+ 1 ' * 10_000 + ')) ())',
        '(:method (m ' + ' '.join(f'?x{i}' for i in range(10_000)) + ') () ())',
        '(:method (m) () (' + ' '.join(f'(t{i})' for i in range(10_000)) + '))',
        '(:method (m) (' + ' '.join(f'(p{i})' for i in range(10_000)) + ') ())',
        '(:operator (!o) () () (' + ' '.join(f'(p ?x{i})' for i in range(10_000)) + '))',
        ''.join(f'(:operator (!o{i}) () () ())' for i in range(5_000)) + '(:method (m) () ((!o)))',
        '(:method (m' + ' ?x' * 10_000 + ') () ())',
        '(:method (m) ' + '((a)) ((m)) ' * 5_000 + ')',
        '(define (domain d) ' + '(:types a - b b - a) ' * 1000 + ')',
        '(define (domain d) (:types ' + ' '.join(f't{i} - t{i + 1}' for i in range(5000)) + '))',
    ],
    ids=lambda text: ascii(text[:24]) + f'_{len(text)}',
)
def test_huge_and_deep_texts_are_read_or_refused_at_once(text: str) -> None:
    problem = (
        '(define (problem p) (:domain d) (:objects x - t0))'
        if 'define' in text
        else '(defproblem p () () ())'
    )
    with at_once():
        try:
            check_mission(*read_mission(MissionText('d', text), MissionText('p', problem)))
        except MissionError as error:
            check_error(error)


def test_the_number_of_words_is_limited(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reader, 'MAX_NODES', 1000)
    read_domain(Source('t', '(:method (m) () ' + '()' * 495 + ')'))
    with pytest.raises(MissionError, match='t:1:2001: more than 1000 words'):
        read_domain(Source('t', 'x ' * 1001))


def test_an_error_is_told_behind_any_number_of_warnings() -> None:
    ways = ''.join(f'() ((t{i}))' for i in range(3000))
    domain = f'(:method (m) {ways} () ()) (:method (n) () ((m 1)))'
    pair = read_mission(MissionText('d', domain), MissionText('p', '(defproblem p () () (m))'))
    with at_once():
        remarks = check_mission(*pair)
    assert [str(r) for r in remarks if r.severity == Severity.ERROR] == [
        f'd:1:{len(domain) - 6}: m takes 0 arguments, not 1'
    ]
    assert len(remarks) == MOST_REMARKS


def test_hopeless_texts_are_given_up() -> None:
    with pytest.raises(MissionError) as caught:
        read_domain(Source('t', 'x ' * 100_000))
    assert len(caught.value.diagnostics) == MOST_ERRORS
