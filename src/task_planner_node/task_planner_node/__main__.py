"""Entry point of the node; it imports the rest only when signals are heeded."""

from __future__ import annotations

import sys

from task_planner_node.signals import StopSignals


def main() -> int:
    """Run the node until it is told to stop; returns the exit code."""
    signals = StopSignals()
    from task_planner_node.node import run

    return run(sys.argv, signals)


if __name__ == '__main__':
    sys.exit(main())
