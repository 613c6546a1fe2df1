"""Writing for people, to terminals, files and readers that go away."""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys

import pytest

from interface_node.command_line.console import Console
from interface_node.command_line.log_lines import Filter


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True

    def shown(self) -> list[str]:
        """Lines as they stand on the screen."""
        lines = self.getvalue().split('\n')
        return [re.sub(r'\x1b\[[\d;]*m', '', line.split('\r\x1b[K')[-1]) for line in lines]


def test_the_status_line_is_rewritten_in_place_on_a_terminal() -> None:
    terminal = Terminal()
    console = Console(io.StringIO(), terminal, {})
    console.status('one')
    console.status('two')
    assert terminal.shown() == ['two']
    console.note('a warning')
    assert terminal.shown() == ['a warning', 'two']
    console.end_status()
    assert terminal.shown() == ['a warning', '']


def test_a_long_status_never_wraps() -> None:
    terminal = Terminal()
    Console(io.StringIO(), terminal, {}).status('x' * 500)
    assert len(terminal.shown()[0]) < 80


def test_elsewhere_the_status_is_a_line_now_and_then() -> None:
    err = io.StringIO()
    console = Console(io.StringIO(), err, {}, status_interval=1000.0)
    console.status('one')
    console.status('two')
    console.status('three', new_phase=True)
    console.status('three', new_phase=True)
    console.end_status()
    assert err.getvalue() == 'one\nthree\n'


@pytest.mark.parametrize(
    ('environment', 'coloured'),
    [({}, True), ({'NO_COLOR': '1'}, False), ({'NO_COLOR': ''}, True), ({'TERM': 'dumb'}, False)],
)
def test_colours_only_where_they_are_wanted(environment: dict[str, str], coloured: bool) -> None:
    console = Console(Terminal(), io.StringIO(), environment)
    assert ('\x1b[' in console.styled('text', 'red')) == coloured
    assert console.styled_err('text', 'red') == 'text'


def test_an_error_is_one_line_with_details_below() -> None:
    err = io.StringIO()
    Console(io.StringIO(), err, {}).error('it failed', ('because', 'of this'))
    assert err.getvalue() == 'geohtn: it failed\n    because\n    of this\n'


def test_a_reader_that_goes_away_is_no_error() -> None:
    script = (
        'import sys\n'
        'from interface_node.command_line.console import Console\n'
        'console = Console(sys.stdout, sys.stderr)\n'
        'for k in range(100000): console.print(f"line {k}")\n'
        'sys.exit(7)\n'
    )
    with subprocess.Popen(
        [sys.executable, '-c', script],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env={**os.environ, 'PYTHONPATH': os.pathsep.join(sys.path)},
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        assert process.stdout.readline() == b'line 0\n'
        process.stdout.close()
        assert process.stderr.read() == b''
        assert process.wait() == 7


def test_characters_that_the_stream_lacks_are_replaced() -> None:
    raw = io.BytesIO()
    out = io.TextIOWrapper(raw, encoding='ascii')
    Console(out, io.StringIO(), {}).print('caf\xe9 \ud800')
    assert raw.getvalue() == b'caf? ?\n'


def test_warnings_and_what_continues_them_pass_the_filter() -> None:
    passing = Filter()
    log = [
        ('[INFO] [1.0] [node]: all is well', False),
        ('and continues', False),
        ('[WARN] [1.1] [node]: careful', True),
        ('  more of it', True),
        ('[DEBUG] [1.2] [node]: detail', False),
        ('Traceback (most recent call last):', True),
        ('  File "x.py", line 1', True),
        ('[FATAL] [1.3] [node]: over', True),
    ]
    assert [(line, passing.passes(line)) for line, _ in log] == log
