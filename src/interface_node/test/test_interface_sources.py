"""Reading texts: what is good comes through, what is bad is named with its place."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from interface_node.sources import MAX_BYTES, SourceError, directory_of, read_source


def test_the_text_wins_over_the_path(tmp_path: Path) -> None:
    file = tmp_path / 'domain.lisp'
    file.write_text('(from the file)', encoding='utf-8')
    assert read_source('domain', str(file), '(given)') == '(given)'
    assert read_source('domain', str(file), '') == '(from the file)'


def test_a_relative_path_counts_from_the_working_directory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / 'world.yaml').write_text('é', encoding='utf-8')
    monkeypatch.chdir(tmp_path)
    assert read_source('world', 'world.yaml', '') == 'é'


def test_a_text_of_the_largest_size_is_read(tmp_path: Path) -> None:
    file = tmp_path / 'world.yaml'
    file.write_bytes(b'a' * MAX_BYTES)
    assert len(read_source('world', str(file), '')) == MAX_BYTES


@pytest.mark.parametrize(
    ('content', 'line', 'column', 'words'),
    [
        (b'good\nb\xc3\xa9d \xff', 2, 5, '0xff'),
        (b'\x89PNG\r\n', 1, 1, '0x89'),
        (b'one\ntwo\0', 2, 4, 'null character'),
        (b'a' * (MAX_BYTES + 1), 0, 0, 'at most 1 MiB'),
    ],
    ids=['a byte that is no UTF-8', 'a picture', 'a null character', 'a byte too long'],
)
def test_a_bad_file_is_named_with_the_place(
    tmp_path: Path, content: bytes, line: int, column: int, words: str
) -> None:
    file = tmp_path / 'domain.lisp'
    file.write_bytes(content)
    with pytest.raises(SourceError, match=words) as caught:
        read_source('domain', str(file), '')
    remark = caught.value.diagnostic
    assert (remark.source, remark.line, remark.column) == (str(file), line, column)


def test_what_is_no_file_is_refused_without_reading_it(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / 'pipe')
    for name, words in (
        ('missing', 'does not exist'),
        ('', 'is a directory'),
        ('pipe', 'no regular file'),
        ('nul\0', 'null character'),
        ('x' * 300, 'cannot be read'),
    ):
        with pytest.raises(SourceError, match=words):
            read_source('problem', f'{tmp_path}/{name}', '')


def test_a_mission_without_a_text_or_a_path_is_refused() -> None:
    with pytest.raises(SourceError, match='the mission has no problem'):
        read_source('problem', '', '')


def test_a_text_that_was_given_is_limited_as_well() -> None:
    with pytest.raises(SourceError, match='at most 1 MiB'):
        read_source('world', '', 'é' * (MAX_BYTES // 2 + 1))


def test_file_names_in_a_text_start_from_its_directory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert directory_of('') == str(tmp_path)
    assert directory_of('rover/world.yaml') == str(tmp_path / 'rover')
    assert directory_of(str(tmp_path / 'world.yaml')) == str(tmp_path)
