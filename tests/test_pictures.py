"""The pictures of the documents can be drawn again."""

from __future__ import annotations

from pathlib import Path

from experiments.pictures.functions import main


def test_the_picture_of_the_functions(tmp_path: Path) -> None:
    main(['--output', str(tmp_path), '--cells', '21'])
    assert (tmp_path / 'functions.png').read_bytes().startswith(b'\x89PNG')
