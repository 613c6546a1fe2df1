"""Entry point of ``geohtn``; it imports the rest only when signals are heeded."""

from __future__ import annotations

from collections.abc import Sequence

from interface_node.command_line.interrupts import Interrupts


def main(argv: Sequence[str] | None = None) -> int:
    """Run one verb; returns the exit code."""
    with Interrupts() as interrupts:
        from interface_node.command_line.dispatch import dispatch

        return dispatch(argv, interrupts)
