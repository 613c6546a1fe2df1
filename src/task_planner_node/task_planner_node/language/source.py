"""The text of a domain or a problem: loaded within limits, with line and column of every offset."""

from __future__ import annotations

import re
import stat
from bisect import bisect_right
from functools import cached_property
from pathlib import Path

from task_planner_node.errors import Diagnostic, MissionError, Severity

MAX_BYTES = 8 << 20
EXCERPT = 60
MARK = re.compile(r"['`,]|#[.+-]")
ALLOWED_CONTROLS = frozenset('\t\n\r\f\v')


class Source:
    """A named text; offsets count characters from 0."""

    def __init__(self, name: str, text: str) -> None:
        self.name = name
        self.text = text

    @cached_property
    def _line_starts(self) -> list[int]:
        return [0] + [i + 1 for i, character in enumerate(self.text) if character == '\n']

    @cached_property
    def has_marks(self) -> bool:
        """Whether a quote, a comma or another mark of Lisp occurs anywhere in the text."""
        return MARK.search(self.text) is not None

    def position(self, offset: int) -> tuple[int, int]:
        """Line and column of ``offset``, both from 1."""
        line = bisect_right(self._line_starts, offset)
        return line, offset - self._line_starts[line - 1] + 1

    def excerpt(self, start: int, end: int) -> str:
        """The text from ``start`` to ``end`` on one line, shortened."""
        words = ' '.join(self.text[start : min(end, start + 4 * EXCERPT)].split())
        return words if len(words) <= EXCERPT else words[: EXCERPT - 3] + '...'

    def diagnostic(
        self, start: int, end: int, message: str, severity: Severity = Severity.ERROR
    ) -> Diagnostic:
        """A remark about the text from ``start`` to ``end``."""
        line, column = self.position(start)
        return Diagnostic(message, line, column, self.excerpt(start, end), self.name, severity)


def split_name(path: str) -> tuple[str, str]:
    """The path of a file and the name behind its ``#``, empty without one or if a file has the whole name."""
    file, mark, name = path.rpartition('#')
    try:
        whole = not mark or Path(path).exists()
    except (OSError, ValueError):
        whole = True
    return (path, '') if whole else (file, name)


def load_source(what: str, path: str, text: str = '') -> Source:
    """Take ``text``, or the file at ``path`` when the text is empty.

    ``what`` names the text in errors, for example ``domain``.  Raises MissionError for a file that is
    missing, unreadable, larger than MAX_BYTES, or not UTF-8 text.
    """
    name = path or f'<{what}>'
    if text:
        data = text.encode('utf-8', 'surrogatepass')
        if len(data) > MAX_BYTES:
            raise _refusal(name, _too_large(what, len(data)))
    elif path:
        data = _read(what, path)
    else:
        raise _refusal(name, f'no {what} was given: neither a text nor a path')
    return Source(name, _decode(name, what, data))


def _read(what: str, path: str) -> bytes:
    try:
        file = Path(path)
        status = file.stat()
        if stat.S_ISDIR(status.st_mode):
            raise _refusal(path, f'the {what} is a directory, not a file')
        if not stat.S_ISREG(status.st_mode):
            raise _refusal(path, f'the {what} is not a regular file')
        if status.st_size > MAX_BYTES:
            raise _refusal(path, _too_large(what, status.st_size))
        with file.open('rb') as stream:
            data = stream.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, 'strerror', None) or str(error)
        raise _refusal(path, f'the {what} cannot be read: {reason}') from error
    if len(data) > MAX_BYTES:
        raise _refusal(path, _too_large(what, len(data)))
    return data


def _decode(name: str, what: str, data: bytes) -> str:
    try:
        text = data.decode('utf-8-sig')
    except UnicodeDecodeError as error:
        byte = data[error.start]
        raise _garbage(name, what, data, error.start, f'byte 0x{byte:02x}') from error
    for offset, character in enumerate(text):
        if character < ' ' and character not in ALLOWED_CONTROLS:
            before = text[:offset].encode()
            raise _garbage(name, what, before, len(before), f'character 0x{ord(character):02x}')
    return text


def _garbage(name: str, what: str, data: bytes, offset: int, found: str) -> MissionError:
    before = data[:offset]
    line = before.count(b'\n') + 1
    column = len(before[before.rfind(b'\n') + 1 :].decode('utf-8', 'replace')) + 1
    message = f'the {what} is not UTF-8 text: {found} at offset {offset}'
    return MissionError([Diagnostic(message, line, column, '', name)])


def _too_large(what: str, size: int) -> str:
    return f'the {what} has {size / 1e6:.1f} MB, more than the limit of {MAX_BYTES >> 20} MiB'


def _refusal(name: str, message: str) -> MissionError:
    return MissionError([Diagnostic(message, source=name)])
