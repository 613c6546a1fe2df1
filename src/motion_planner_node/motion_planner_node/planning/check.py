"""Checks of a text of geometric preconditions before it is used."""

from __future__ import annotations

from dataclasses import dataclass

from motion_planner_node.errors import Diagnostic, Severity
from motion_planner_node.language import check, read
from motion_planner_node.world.model import World


@dataclass(frozen=True, slots=True)
class CheckResult:
    """Whether a text can be used, whether it sets an attitude, and all remarks about it."""

    valid: bool
    assigns: bool
    diagnostics: tuple[Diagnostic, ...]


def check_text(
    text: str, world: World | None, source: str = '', line: int = 0, column: int = 0
) -> CheckResult:
    """Check ``text``, possibly with variables, that begins at ``line`` and ``column`` of ``source``.

    Without a ``world`` labels are not looked up.  Lines and columns count from 1; 0 means that the
    positions are those in the text itself.
    """
    preconditions, errors = read(text)
    remarks = errors
    if not errors or preconditions.statements:
        remarks = (*errors, *check(preconditions, world))
    remarks = tuple(sorted(remarks, key=lambda remark: (remark.line, remark.column)))
    moved = tuple(remark.moved(source, line, column) for remark in remarks)
    valid = all(remark.severity is not Severity.ERROR for remark in moved)
    return CheckResult(valid, not errors and preconditions.assigns, moved)
