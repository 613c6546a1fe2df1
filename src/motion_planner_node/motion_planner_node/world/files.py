"""Files that a world names: only regular ones, only of a limited size."""

from __future__ import annotations

import os
import stat
from pathlib import Path
from typing import NamedTuple

from motion_planner_node.world.syntax import Place
from motion_planner_node.world.values import Faults

#: The longest name of a file with its directories [characters].
LONGEST_PATH = 4096


class File(NamedTuple):
    """A file that was read: its path, and what is in it."""

    path: str
    content: bytes


def directory_of(source: str) -> str:
    """The directory that relative names in the text ``source`` count from."""
    return str(Path(source).parent) if source else '.'


def read_file(
    directory: str, name: str, most: int, what: str, place: Place, faults: Faults
) -> File | None:
    """The file ``name``, relative to ``directory``, of at most ``most`` bytes.

    None, and a fault at ``place``, when it cannot be read; ``what`` says what it was to be.
    """
    path = str(Path(directory) / name)
    try:
        with open(path, 'rb', opener=_open) as file:
            if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                faults.add(f'{what} {path} is not a regular file', place, name)
                return None
            content = file.read(most + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, 'strerror', None) or str(error)
        faults.add(f'{what} {path} cannot be read: {reason}', place, name)
        return None
    if len(content) > most:
        faults.add(f'{what} {path} is larger than the {most} bytes allowed', place, name)
        return None
    return File(path, content)


def _open(path: str, flags: int) -> int:
    """Open without waiting for the writer of a pipe."""
    return os.open(path, flags | os.O_NONBLOCK)
