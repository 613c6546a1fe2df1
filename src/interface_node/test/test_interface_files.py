"""A file is replaced whole, or stays as it was."""

from __future__ import annotations

from pathlib import Path

import pytest

from interface_node.files import Replacement, write_file


def test_a_file_is_replaced_when_it_is_complete(tmp_path: Path) -> None:
    path = tmp_path / 'plan.json'
    path.write_bytes(b'old')
    replacement = Replacement(path)
    replacement.file.write(b'new')
    assert path.read_bytes() == b'old'
    replacement.complete()
    assert path.read_bytes() == b'new'
    assert list(tmp_path.iterdir()) == [path]


def test_what_is_discarded_leaves_the_old_file_and_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / 'plan.json'
    write_file(path, b'old')
    replacement = Replacement(path)
    replacement.file.write(b'half')
    replacement.discard()
    assert path.read_bytes() == b'old'
    assert list(tmp_path.iterdir()) == [path]


def test_a_failed_write_leaves_nothing_behind(tmp_path: Path) -> None:
    (tmp_path / 'plan.json').mkdir()
    with pytest.raises(OSError, match=r'plan\.json'):
        write_file(tmp_path / 'plan.json', b'new')
    assert [file.name for file in tmp_path.iterdir()] == ['plan.json']
