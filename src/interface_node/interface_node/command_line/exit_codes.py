"""What a script learns from ``geohtn``: one exit code per kind of ending."""

from __future__ import annotations

from enum import IntEnum


class ExitCode(IntEnum):
    """Exit codes of every verb."""

    DONE = 0
    FAILED = 1
    INPUT = 2
    NO_NODE = 3
    CANCELLED = 130


#: For ``geohtn --help``.
TABLE = """\
exit codes:
  0    solved, or done
  1    no plan within the limits, a file that could not be written, another mission
       in the way, a replay that differs, or a fault
  2    the input is at fault, or it is proven that there is no plan
  3    a node is not running
  130  stopped by Ctrl-C (143 by SIGTERM, 129 by SIGHUP)
"""

_OF_OUTCOME = {
    'SOLVED': ExitCode.DONE,
    'NO_PLAN': ExitCode.INPUT,
    'LIMIT': ExitCode.FAILED,
    'CANCELLED': ExitCode.CANCELLED,
    'INVALID': ExitCode.INPUT,
    'UNAVAILABLE': ExitCode.NO_NODE,
    'FAILED': ExitCode.FAILED,
}


def exit_code_of(outcome: str) -> ExitCode:
    """Exit code of a search by its outcome's name in geohtn_msgs/Outcome."""
    return _OF_OUTCOME.get(outcome, ExitCode.FAILED)


def exit_code_of_signal(number: int) -> int:
    """Exit code of a command that this signal ended, as shells have it."""
    return 128 + number
