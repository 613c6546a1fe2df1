"""What ends a verb early: one sentence for people and an exit code for scripts."""

from __future__ import annotations

from interface_node.command_line.exit_codes import ExitCode


class CommandError(Exception):
    """The command cannot go on; ``details`` are lines to show below the sentence."""

    def __init__(self, message: str, exit_code: ExitCode, details: tuple[str, ...] = ()):
        super().__init__(message)
        self.message = message
        self.exit_code = exit_code
        self.details = details


class Interrupted(Exception):
    """A signal asked the command to stop, for example Ctrl-C."""

    def __init__(self, signal_number: int):
        super().__init__(f'stopped by signal {signal_number}')
        self.signal_number = signal_number
