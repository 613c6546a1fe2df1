"""What a step was made from, so that it is done again when that has changed, and only then.

A stamp is written when its step is through. A step that was interrupted has none.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from pathlib import Path

#: Folders and endings of what tools leave in the source tree.
LEFTOVERS = frozenset({'__pycache__', '.mypy_cache', '.pytest_cache', '.ruff_cache', '.hypothesis'})


def files_below(folder: Path) -> list[Path]:
    """The source files in and below ``folder``, in a fixed order."""
    return sorted(
        path
        for path in folder.rglob('*')
        if path.is_file()
        and not LEFTOVERS.intersection(path.relative_to(folder).parts)
        and path.suffix != '.pyc'
    )


def fingerprint(
    words: Iterable[str] = (), contents: Iterable[Path] = (), names: Iterable[Path] = ()
) -> str:
    """A hash over ``words``, the names and contents of ``contents`` and the mere names of ``names``."""
    digest = hashlib.sha256()
    for word in words:
        _add(digest, b'word', word.encode())
    for path in contents:
        _add(digest, str(path).encode(), path.read_bytes())
    for path in names:
        _add(digest, b'name', str(path).encode())
    return digest.hexdigest()


def _add(digest: hashlib._Hash, *parts: bytes) -> None:
    """Each part with its length, so that no two lists of parts look alike."""
    for part in parts:
        digest.update(f'{len(part)}:'.encode() + part)


def is_current(stamp: Path, wanted: str) -> bool:
    """Whether ``stamp`` says that the step was done from ``wanted``."""
    try:
        return stamp.read_text('utf-8') == wanted
    except (OSError, UnicodeDecodeError):
        return False


def write(stamp: Path, made_from: str) -> None:
    """Say that the step is through; whole or not at all."""
    partial = stamp.with_name(stamp.name + '.partial')
    partial.write_text(made_from, 'utf-8')
    partial.replace(stamp)
