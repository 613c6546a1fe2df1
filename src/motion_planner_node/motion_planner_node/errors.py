"""What can go wrong in the motion planner: one family of exceptions, each with its code."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import IntEnum
from typing import TypeVar

from motion_planner_node.codes import Code

Result = TypeVar('Result')


class Severity(IntEnum):
    """Whether a text can still be used."""

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
    code: Code = Code.INVALID_PRECONDITIONS

    def moved(self, source: str, line: int, column: int) -> Diagnostic:
        """The same remark when its text begins at ``line`` and ``column`` of ``source``."""
        if not self.line or not line:
            return replace(self, source=source)
        on_first_line = self.line == 1
        return replace(
            self,
            source=source,
            line=self.line + line - 1,
            column=self.column + column - 1 if on_first_line else self.column,
        )

    def __str__(self) -> str:
        where = ':'.join(str(part) for part in (self.source, self.line, self.column) if part)
        return f'{where}: {self.message}' if where else self.message


class MotionPlannerError(Exception):
    """A request, a text or a world that the motion planner cannot work on."""

    def __init__(self, code: Code, message: str, diagnostics: Sequence[Diagnostic] = ()):
        super().__init__(message)
        self.code = code
        self.message = message
        self.diagnostics = tuple(diagnostics)

    @classmethod
    def from_diagnostics(cls, diagnostics: Sequence[Diagnostic]) -> MotionPlannerError:
        """The error that stands for all of ``diagnostics``: the code and words of the first."""
        first = diagnostics[0]
        return cls(first.code, str(first), diagnostics)


class Stopped(Exception):
    """``should_stop`` said so: the deadline is over, or the client took the request back."""


def guarded(work: Callable[[], Result], log: Callable[[str], object]) -> Result:
    """Do ``work``; a fault of the program goes to ``log`` and is told, so that a node outlives it.

    :raises MotionPlannerError: whatever goes wrong; INTERNAL for what should not
    :raises Stopped: when the work was broken off
    """
    try:
        return work()
    except (MotionPlannerError, Stopped):
        raise
    except Exception as error:
        log(traceback.format_exc())
        raise MotionPlannerError(
            Code.INTERNAL,
            f'a fault of the motion planner, please report it with its log: '
            f'{type(error).__name__}: {error}',
        ) from error
