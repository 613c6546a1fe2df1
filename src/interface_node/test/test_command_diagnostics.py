"""Remarks about files point at the place that they are about."""

from __future__ import annotations

import io
from unicodedata import east_asian_width

from hypothesis import given
from hypothesis import strategies as st

from interface_node.command_line.console import Console
from interface_node.command_line.diagnostics import excerpt, place, write_diagnostics
from interface_node.command_line.missions import Source
from interface_node.plan import Diagnostic


def test_the_excerpt_underlines_the_offending_text() -> None:
    text = 'one\n\tdistanse(?r, ?o) >= 50\nthree'
    remark = Diagnostic('unknown function', 'd.lisp', 2, 2, 'distanse')
    assert excerpt(remark, text) == (' distanse(?r, ?o) >= 50', ' ^~~~~~~~')


def test_without_offending_text_one_character_is_marked() -> None:
    assert excerpt(Diagnostic('m', 'f', 1, 3), 'abcd') == ('abcd', '  ^')
    assert excerpt(Diagnostic('m', 'f', 1, 3, 'elsewhere'), 'abcd') == ('abcd', '  ^')


def test_the_end_of_a_line_and_of_a_file_can_be_marked() -> None:
    assert excerpt(Diagnostic('m', 'f', 1, 5), 'abcd\n') == ('abcd', '    ^')
    assert excerpt(Diagnostic('m', 'f', 2, 1), 'abcd\n') == ('', '^')
    assert excerpt(Diagnostic('m', 'f', 1, 99), 'abcd') == ('abcd', '    ^')


def test_there_is_no_excerpt_of_what_is_not_there() -> None:
    assert excerpt(Diagnostic('m', 'f'), 'abcd') == ()
    assert excerpt(Diagnostic('m', 'f', 7, 1), 'abcd') == ()


def test_a_place_may_lack_column_or_line() -> None:
    assert place(Diagnostic('m', 'f', 3, 4)) == 'f:3:4'
    assert place(Diagnostic('m', 'f', 3)) == 'f:3'
    assert place(Diagnostic('m', 'f', 0, 4)) == 'f'
    assert place(Diagnostic('m')) == ''


@given(st.text(max_size=400), st.integers(0, 6), st.integers(0, 500), st.text(max_size=20))
def test_excerpts_are_short_printable_and_never_fail(
    text: str, line: int, column: int, offending: str
) -> None:
    for shown in excerpt(Diagnostic('m', 'f', line, column, offending), text):
        assert len(shown) <= 201
        assert shown.isprintable()


@given(st.text('ab (\t\xe9\u6f22\U0001f697', min_size=1, max_size=100), st.data())
def test_the_caret_stands_below_its_character(line: str, data: st.DataObject) -> None:
    column = data.draw(st.integers(1, len(line)))
    lines = excerpt(Diagnostic('m', 'f', 1, column), f'{line}\nnext')
    before = sum(2 if east_asian_width(c) in 'WF' else 1 for c in line[: column - 1])
    assert lines[1].index('^') == before


def test_long_lines_are_cut_around_the_column() -> None:
    line = 'x' * 5000 + 'HERE' + 'y' * 5000
    shown, caret = excerpt(Diagnostic('m', 'f', 1, 5001, 'HERE'), line)
    assert shown[caret.index('^') : caret.rindex('~') + 1] == 'HERE'
    assert len(shown) <= 100


def test_diagnostics_are_written_as_compilers_do() -> None:
    err = io.StringIO()
    source = Source('/abs/domain.lisp', 'domain.lisp', 'first\n(wrong here)\n')
    write_diagnostics(
        Console(io.StringIO(), err, {}),
        [
            Diagnostic('it is wrong', '/abs/domain.lisp', 2, 2, 'wrong'),
            Diagnostic('odd', '/abs/other.lisp', 4, 1, warning=True),
            Diagnostic('no such picture', '/abs/office.yaml', 1, 8),
            Diagnostic('no place'),
        ],
        [source],
    )
    assert err.getvalue() == (
        'domain.lisp:2:2: error: it is wrong\n'
        '    (wrong here)\n'
        '     ^~~~~\n'
        '/abs/other.lisp:4:1: warning: odd\n'
        '/abs/office.yaml:1:8: error: no such picture\n'
        'error: no place\n'
    )
