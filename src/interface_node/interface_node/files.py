"""Writing files so that a reader sees the old one or the new one, never half of it."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path


class Replacement:
    """A file that is written beside ``path`` and takes its place when it is complete.

    Raises OSError where it cannot be written.
    """

    def __init__(self, path: Path):
        self.path = path
        self._neighbour = path.with_name(f'.{path.name}.{os.getpid()}.part')
        self.file = self._neighbour.open('wb')

    def complete(self) -> None:
        """Put the file in its place."""
        self.file.close()
        self._neighbour.replace(self.path)

    def discard(self) -> None:
        """Remove what was written; the file that was there before stays."""
        with suppress(OSError):
            self.file.close()
        with suppress(OSError):
            self._neighbour.unlink(missing_ok=True)


def write_file(path: Path, data: bytes) -> None:
    """Write the whole file at once; raises OSError when that fails."""
    replacement = Replacement(path)
    try:
        replacement.file.write(data)
        replacement.complete()
    except BaseException:
        replacement.discard()
        raise
