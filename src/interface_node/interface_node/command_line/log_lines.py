"""Telling a node's warnings and errors from its chatter."""

from __future__ import annotations

import re

_SEVERITY = re.compile(r'\s*\[(DEBUG|INFO|WARN|ERROR|FATAL)\]')
_TRACEBACK = 'Traceback (most recent call last):'


class Filter:
    """Passes the records that matter to a person, with the lines that continue them."""

    def __init__(self) -> None:
        self._passing = False

    def passes(self, line: str) -> bool:
        """Whether the next line of a node's output is a warning or worse, or belongs to one."""
        severity = _SEVERITY.match(line)
        if severity:
            self._passing = severity.group(1) in ('WARN', 'ERROR', 'FATAL')
        elif line.startswith(_TRACEBACK):
            self._passing = True
        return self._passing
