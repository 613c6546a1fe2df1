"""What can be wrong with a mission, said once: diagnostics with positions, and the exceptions that carry them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum


class Severity(IntEnum):
    """Whether a text can still be used: the numbers of geohtn_msgs/Diagnostic."""

    ERROR = 0
    WARNING = 1


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One remark about a text that somebody wrote; line and column count from 1, 0 is nowhere."""

    message: str
    line: int = 0
    column: int = 0
    text: str = ''
    source: str = ''
    severity: Severity = Severity.ERROR

    def __str__(self) -> str:
        where = ':'.join(str(part) for part in (self.source, self.line, self.column) if part)
        return f'{where}: {self.message}' if where else self.message


class MissionError(Exception):
    """A domain or a problem that cannot be used; ``diagnostics`` says why, errors and warnings."""

    def __init__(self, diagnostics: Sequence[Diagnostic]) -> None:
        self.diagnostics = tuple(diagnostics)
        super().__init__('\n'.join(str(diagnostic) for diagnostic in self.diagnostics))


class LimitReached(Exception):
    """A limit of time, memory or depth ended the search; the message is a sentence."""


class TermRefused(LimitReached):
    """A term that nests too deeply, or a dotted pair that is no list."""


class Cancelled(Exception):
    """The client took the mission back."""


class GeometryUnavailable(Exception):
    """The motion planner does not answer; the message is a sentence."""


class GeometryFailed(Exception):
    """The motion planner cannot work on any request of this mission; the message is a sentence."""
