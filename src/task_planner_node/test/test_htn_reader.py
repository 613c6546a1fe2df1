"""The reader: positions, limits, and where a parenthesis is missing."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from task_planner_node.errors import MissionError
from task_planner_node.language import Source, load_source, read_domain
from task_planner_node.language.reader import MAX_DEPTH, ListNode, Node, Symbol, read
from task_planner_node.language.source import MAX_BYTES

SYMBOLS = st.text(st.sampled_from('abz?!_-.0:=<>/*&'), min_size=1, max_size=6)
TREES = st.recursive(SYMBOLS, lambda inner: st.lists(inner, max_size=4), max_leaves=25)
GAPS = st.sampled_from([' ', '\n', '\t ', ' ; note (\n', '\r\n'])


def plain(node: Node) -> object:
    return node.text if isinstance(node, Symbol) else [plain(child) for child in node.children]


@given(st.lists(TREES, max_size=4), st.data())
def test_what_is_written_is_read_back_with_its_place(
    trees: list[object], data: st.DataObject
) -> None:
    parts: list[str] = []

    def write(tree: Any) -> None:
        parts.append(data.draw(GAPS))
        if isinstance(tree, str):
            parts.append(tree)
        else:
            parts.append('(')
            for child in tree:
                write(child)
            parts.append(data.draw(GAPS))
            parts.append(')')

    for tree in trees:
        write(tree)
    source = Source('t', ''.join(parts))
    nodes = read(source)
    assert [plain(node) for node in nodes] == trees
    agenda = list(nodes)
    while agenda:
        node = agenda.pop()
        text = source.text[node.start : node.end]
        line, column = source.position(node.start)
        assert source.text.split('\n')[line - 1][column - 1 :].startswith(text.split('\n')[0])
        if isinstance(node, ListNode):
            assert text[0] == '('
            assert text[-1] == ')'
            agenda.extend(node.children)
        else:
            assert text == node.text


@given(st.text(st.sampled_from('()ab ;"\n?.!:-') | st.characters(), max_size=200))
def test_any_text_is_read_or_refused_with_a_position(text: str) -> None:
    try:
        read_domain(Source('t', text))
    except MissionError as error:
        for diagnostic in error.diagnostics:
            assert diagnostic.message
            assert diagnostic.source == 't'
            assert 0 <= diagnostic.line <= text.count('\n') + 1


@given(st.binary(max_size=200))
def test_any_bytes_are_loaded_or_refused(
    tmp_path_factory: pytest.TempPathFactory, data: bytes
) -> None:
    path = tmp_path_factory.mktemp('bytes') / 'domain.lisp'
    path.write_bytes(data)
    try:
        source = load_source('domain', str(path))
    except MissionError as error:
        sources = {diagnostic.source for diagnostic in error.diagnostics}
    else:
        sources = {source.name}
    assert sources == {str(path)}


def refusal(text: str) -> tuple[int, int, str]:
    with pytest.raises(MissionError) as caught:
        read(Source('t', text))
    (diagnostic,) = caught.value.diagnostics
    return diagnostic.line, diagnostic.column, diagnostic.message


FIGURE_2 = """\
(Operator (!init_rover_attitude ?r ?o)
( (location ?o)(not(initialized ?r)) )
((agent ?r)(object ?o)
(setProperty(?r.x,?o.x))
(setProperty(?r.y,?o.y))
(setProperty(?r.heading,0))
( (initialized ?r) )
)
"""
FIGURE_3 = """\
(Operator (!take_photo ?r ?o ?c)
( (rover ?r)(available ?r) (location ?o)(need_photo_of ?o) (has_camera ?r ?c) )
((agent ?r)(object ?o)
(distance(?r, ?o) >= 50)
(distance(?r, ?o) <= 100)
(rel_angle(?r,?o) = cos-and-sin(pi/2))
( (has_photo_of ?r ?o) )
)
"""


def test_the_figures_as_printed_lack_a_parenthesis() -> None:
    line, column, message = refusal(FIGURE_2)
    assert (line, column) == (1, 1)
    assert '!init_rover_attitude' in message
    line, column, message = refusal('; note\n  ' + FIGURE_3)
    assert (line, column) == (2, 3)
    assert '!take_photo' in message


def test_the_operator_that_is_not_closed_is_named_among_others() -> None:
    closed = FIGURE_2.replace('heading,0))', 'heading,0)))')
    line, column, message = refusal(f'(defdomain rover (\n{FIGURE_2}{FIGURE_3}))')
    assert (line, column) == (2, 1)
    assert '(Operator (!init_rover_attitude ...) ...)' in message
    line, column, message = refusal(f'(defdomain rover (\n{closed}{FIGURE_3}))')
    assert (line, column) == (2 + closed.count('\n'), 1)
    assert '!take_photo' in message
    line, column, message = refusal(f'{FIGURE_3}(:method (a) () ())\n')
    assert (line, column) == (1, 1)
    assert '!take_photo' in message


def test_a_stray_parenthesis_has_its_place() -> None:
    assert refusal('(a))')[:2] == (1, 4)
    line, column, message = refusal('(defdomain rover\n())\n  )')
    assert (line, column) == (3, 3)
    assert '(defdomain rover ...)' in message
    assert 'line 2' in message


def test_depth_is_limited() -> None:
    assert read(Source('t', '(' * MAX_DEPTH + ')' * MAX_DEPTH))
    assert refusal('(' * 100_000) == (1, MAX_DEPTH + 1, f'lists nest deeper than {MAX_DEPTH}')


@pytest.mark.parametrize(
    ('content', 'place', 'message'),
    [
        (b'(a\n b\x00)', (2, 3), '0x00'),
        (b'(a\n b\xff)', (2, 3), '0xff'),
        (b'a\x01', (1, 2), '0x01'),
        (b'(' + b' ' * MAX_BYTES, (0, 0), 'limit of 8 MiB'),
    ],
)
def test_what_is_no_text_is_refused(
    tmp_path_factory: pytest.TempPathFactory,
    content: bytes,
    place: tuple[int, int],
    message: str,
) -> None:
    path = tmp_path_factory.mktemp('garbage') / 'd.lisp'
    path.write_bytes(content)
    with pytest.raises(MissionError) as caught:
        load_source('domain', str(path))
    (diagnostic,) = caught.value.diagnostics
    assert (diagnostic.line, diagnostic.column) == place
    assert message in diagnostic.message


def test_a_huge_file_is_refused_before_it_is_read(tmp_path: Path) -> None:
    path = tmp_path / 'huge.lisp'
    with path.open('wb') as file:
        file.truncate(50_000_000)
    with pytest.raises(MissionError, match=r'has 50\.0 MB, more than the limit of 8 MiB'):
        load_source('problem', str(path))
    with pytest.raises(MissionError, match='directory'):
        load_source('problem', str(tmp_path))
    with pytest.raises(MissionError, match='No such file'):
        load_source('problem', str(tmp_path / 'missing'))
    with pytest.raises(MissionError, match='neither a text nor a path'):
        load_source('problem', '')
    with pytest.raises(MissionError, match='null'):
        load_source('problem', 'a\0b')
