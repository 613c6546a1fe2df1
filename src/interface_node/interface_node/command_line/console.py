"""Writing for people: colours where they help, and one status line that is rewritten in place."""

from __future__ import annotations

import os
import time
from collections.abc import Mapping
from threading import RLock
from typing import TextIO

_STYLES = {'bold': '1', 'red': '1;31', 'yellow': '33', 'green': '32', 'dim': '2'}
_USUAL_COLUMNS = 80
_CLEAR_LINE = '\r\x1b[K'


class Console:
    """Two streams: ``out`` for what was asked for, ``err`` for everything said on the way.

    Colours appear only on terminals, and never when ``NO_COLOR`` is set or ``TERM`` is ``dumb``.
    A reader that goes away (``geohtn missions | head -1``) ends the writing, not the command.
    """

    def __init__(
        self,
        out: TextIO,
        err: TextIO,
        environment: Mapping[str, str] = os.environ,
        status_interval: float = 3.0,
    ):
        self._out = out
        self._err = err
        plain = bool(environment.get('NO_COLOR')) or environment.get('TERM') == 'dumb'
        self._colours = {id(stream): stream.isatty() and not plain for stream in (out, err)}
        self._live = err.isatty() and environment.get('TERM') != 'dumb'
        self._interval = status_interval
        self._status = ''
        self._status_time = -status_interval
        self._gone: set[int] = set()
        self._lock = RLock()

    def print(self, text: str) -> None:
        """Write a line of the result to ``out``."""
        self._line(self._out, text)

    def note(self, text: str) -> None:
        """Write a line to ``err``, above the status line."""
        self._line(self._err, text)

    def error(self, message: str, details: tuple[str, ...] = ()) -> None:
        """Write ``geohtn: message`` to ``err``, and ``details`` indented below."""
        self.note(f'{self.styled_err("geohtn:", "red")} {message}')
        for line in details:
            self.note(f'    {line}')

    def status(self, text: str, *, new_phase: bool = False) -> None:
        """Show ``text`` as the status line.

        Off a terminal write it as a line, at most every few seconds unless it is a ``new_phase``.
        """
        with self._lock:
            if not self._live:
                now = time.monotonic()
                is_due = new_phase or now - self._status_time >= self._interval
                if is_due and text != self._status:
                    self._status, self._status_time = text, now
                    self._line(self._err, text)
            elif text != self._status:
                self._status = text
                self._write(self._err, _CLEAR_LINE + self._fitted(text))

    def end_status(self) -> None:
        """Take the status line away."""
        with self._lock:
            if self._live and self._status:
                self._write(self._err, _CLEAR_LINE)
            self._status = ''

    def styled(self, text: str, style: str) -> str:
        """``text`` for ``out`` in a style: bold, red, yellow, green or dim."""
        return self._styled(self._out, text, style)

    def styled_err(self, text: str, style: str) -> str:
        """``text`` for ``err`` in a style: bold, red, yellow, green or dim."""
        return self._styled(self._err, text, style)

    def _styled(self, stream: TextIO, text: str, style: str) -> str:
        return f'\x1b[{_STYLES[style]}m{text}\x1b[0m' if self._colours[id(stream)] else text

    def _fitted(self, text: str) -> str:
        try:
            columns = os.get_terminal_size(self._err.fileno()).columns
        except (OSError, ValueError):
            columns = 0
        return text[: (columns or _USUAL_COLUMNS) - 1]

    def _line(self, stream: TextIO, text: str) -> None:
        with self._lock:
            if self._live and self._status:
                self._write(self._err, _CLEAR_LINE)
            self._write(stream, text + '\n')
            if self._live and self._status:
                self._write(self._err, self._fitted(self._status))

    def _write(self, stream: TextIO, text: str) -> None:
        if id(stream) in self._gone:
            return
        encoding = stream.encoding or 'utf-8'
        try:
            stream.write(text.encode(encoding, 'replace').decode(encoding))
            stream.flush()
        except (BrokenPipeError, ValueError):
            self._gone.add(id(stream))
            _discard(stream)


def _discard(stream: TextIO) -> None:
    """Point a broken stream at nothing, so that the interpreter can flush it on its way out."""
    try:
        nothing = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nothing, stream.fileno())
        os.close(nothing)
    except (OSError, ValueError):
        pass
