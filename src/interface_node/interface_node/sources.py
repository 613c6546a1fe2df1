"""Reading the texts that make up a mission, from a file or as they are."""

from __future__ import annotations

import stat
from pathlib import Path

from interface_node.plan import Diagnostic

#: Longest text that is read [bytes].
MAX_BYTES = 1024 * 1024


class SourceError(Exception):
    """A text that cannot be read; ``diagnostic`` says which and why."""

    def __init__(self, diagnostic: Diagnostic):
        super().__init__(str(diagnostic))
        self.diagnostic = diagnostic


def directory_of(path: str) -> str:
    """The directory, in full, that file names in the text at ``path`` start from.

    The working directory for a text without a path.
    """
    return str(Path(path or 'world').absolute().parent)


def read_source(kind: str, path: str, text: str) -> str:
    """The text itself, or that of the file at ``path`` when it is empty.

    ``kind`` is domain, problem or world. A relative path counts from the working directory.
    Raises SourceError for a text that is too long, is no UTF-8, or cannot be read.
    """
    if not text and not path:
        raise _error(kind, f'the mission has no {kind}: give its text, or the path of its file')
    source = path or kind
    data = text.encode('utf-8', 'surrogatepass') if text else _read(kind, path)
    if len(data) > MAX_BYTES:
        raise _error(source, _too_long(kind, len(data)))
    try:
        text = data.decode('utf-8')
    except UnicodeDecodeError as error:
        before = data[: error.start].decode('utf-8')
        raise _error(
            source,
            f'the {kind} is no UTF-8 text: the byte {data[error.start]:#04x} cannot stand here',
            before,
        ) from None
    if '\0' in text:
        before = text[: text.index('\0')]
        raise _error(source, f'the {kind} is no text: it holds a null character', before)
    return text


def _file(path: str) -> Path:
    """The file that ``path`` names; ``problems.lisp#first`` is a problem in the file ``problems.lisp``."""
    file, mark, _ = path.rpartition('#')
    return Path(file) if mark and not Path(path).exists() else Path(path)


def _read(kind: str, path: str) -> bytes:
    try:
        file = _file(path)
        status = file.stat()
        if stat.S_ISDIR(status.st_mode):
            raise _error(path, f'the {kind} is a directory; a file is needed')
        if not stat.S_ISREG(status.st_mode):
            raise _error(path, f'the {kind} is no regular file')
        if status.st_size > MAX_BYTES:
            raise _error(path, _too_long(kind, status.st_size))
        with file.open('rb') as content:
            return content.read(MAX_BYTES + 1)
    except FileNotFoundError:
        where = '' if file.is_absolute() else f' (looked for in {Path.cwd()})'
        raise _error(path, f'the {kind} does not exist{where}') from None
    except OSError as error:
        raise _error(path, f'the {kind} cannot be read: {error.strerror}') from None
    except ValueError:
        raise _error(kind, f'the path of the {kind} holds a null character') from None


def _too_long(kind: str, size: int) -> str:
    return f'the {kind} has {size / 2**20:.1f} MiB; at most {MAX_BYTES / 2**20:g} MiB are read'


def _error(source: str, message: str, before: str | None = None) -> SourceError:
    if before is None:
        return SourceError(Diagnostic(message=message, source=source))
    line = before.count('\n') + 1
    column = len(before) - (before.rfind('\n') + 1) + 1
    return SourceError(Diagnostic(message=message, source=source, line=line, column=column))
