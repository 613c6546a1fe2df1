"""Planning one mission with nodes that run: waiting for them, progress, cancelling, the report."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection
from math import inf, isfinite
from typing import Protocol

from interface_node.command_line.console import Console
from interface_node.command_line.diagnostics import write_diagnostics
from interface_node.command_line.errors import CommandError
from interface_node.command_line.exit_codes import ExitCode, exit_code_of
from interface_node.command_line.goals import MissionGoal
from interface_node.command_line.interrupts import Interrupts
from interface_node.command_line.nodes import NODES
from interface_node.command_line.progress import progress_line
from interface_node.command_line.results import MissionResult, Progress
from interface_node.command_line.solution import solution_plan, step_table, totals
from interface_node.plan import Plan
from interface_node.starting import how_to_start

#: [s] that nodes may take to start; the first start on a machine compiles.
START_PATIENCE = 60.0
_POLL = 0.05
_CANCEL_PATIENCE = 0.9
#: Looks without news after which the interface node, which tells how it goes twice a second, is
#: given up. They are counted, so that a command that was suspended does not blame the node.
_SILENT_LOOKS = 70
#: The same before the first news: discovery announces itself again after 3 s when it was not heard.
_FIRST_LOOKS = 140


class Client(Protocol):
    """What planning needs of :class:`mission_client_node.MissionClient`."""

    progress: Progress
    result: MissionResult | None
    heard: int  # messages from the interface node

    def missing(self) -> tuple[str, ...]:
        """Names of the nodes that are not to be seen."""

    def start(self, goal: MissionGoal) -> None:
        """Send a mission."""

    def wait(self, seconds: float) -> bool:
        """Whether the mission has ended, after at most ``seconds``."""

    def cancel(self) -> None:
        """Ask for the mission to end."""


def wait_for_nodes(
    client: Client,
    patience: float,
    namespace: str,
    check: Callable[[], None],
    *,
    nodes: Collection[str] = NODES,
    speaker: str = '',
) -> None:
    """Wait until ``nodes`` are to be seen; ``check`` raises what ends the waiting early.

    A ``speaker`` that is to be seen is enough: it tells itself which of the others are missing.

    Raises:
        CommandError: NO_NODE with the missing nodes' names, after ``patience`` [s].
    """
    deadline = time.monotonic() + patience
    while missing := [node for node in client.missing() if node in nodes]:
        if speaker and speaker not in missing:
            return
        check()
        if time.monotonic() > deadline:
            names = ' and '.join(filter(None, (', '.join(missing[:-1]), missing[-1])))
            verb = 'is' if len(missing) == 1 else 'are'
            raise CommandError(
                f'{names} {verb} not running in namespace /{namespace}: '
                + how_to_start(missing, namespace),
                ExitCode.NO_NODE,
            )
        time.sleep(_POLL)


def plan_mission(
    client: Client, goal: MissionGoal, console: Console, check: Callable[[], None]
) -> MissionResult:
    """Plan a mission and show how it goes; ``check`` raises what ends it early.

    Whatever ends it, the nodes are asked to stop working on it.

    Raises:
        CommandError: when the interface node refuses the mission or goes away.
    """
    client.start(goal)
    phase = ''
    first = best = inf
    heard = silent = 0
    try:
        while not client.wait(_POLL):
            progress = client.progress
            length = progress.best_length
            first = first if isfinite(first) else length
            news = progress.phase != phase or length != best
            console.status(progress_line(progress, first), new_phase=news)
            phase, best = progress.phase, length
            check()
            if 'interface_node' in client.missing():
                raise CommandError('interface_node went away while it planned', ExitCode.NO_NODE)
            silent = silent + 1 if client.heard == heard else 0
            heard = client.heard
            if silent >= (_SILENT_LOOKS if heard else _FIRST_LOOKS):
                raise CommandError(
                    'interface_node no longer answers: it hangs, or was killed', ExitCode.NO_NODE
                )
    except BaseException:
        client.cancel()
        client.wait(_CANCEL_PATIENCE)
        raise
    finally:
        console.end_status()
    if client.result is None:
        raise CommandError(
            'another mission is being planned: wait for it, or cancel it with Ctrl-C where it was '
            'started; a mission whose client was killed ends with its time budget',
            ExitCode.FAILED,
        )
    return client.result


def report(result: MissionResult, goal: MissionGoal, console: Console) -> ExitCode:
    """Write what came of a mission: the plan to ``out``, or to ``err`` why there is none.

    A plan whose files could not all be written counts as FAILED.
    """
    plan = result.plan
    write_diagnostics(console, plan.diagnostics, goal.mission.sources.values())
    if plan.outcome != 'SOLVED':
        first, *rest = _explanation(plan)
        console.error(f'{plan.outcome}: {first}', tuple(rest))
        for file in result.files:
            console.note(f'wrote {file}')
        return exit_code_of(plan.outcome)
    heading, *actions = solution_plan(plan.steps)
    console.print(console.styled(heading, 'bold'))
    for line in actions:
        console.print(line)
    console.print('')
    if plan.steps:
        heading, *rows = step_table(plan)
        console.print(console.styled(heading, 'bold'))
        for line in rows:
            console.print(line)
        console.print('')
    for line in totals(result):
        console.print(line)
    complete = all(remark.warning for remark in plan.diagnostics)
    return ExitCode.DONE if complete else ExitCode.FAILED


def checking(interrupts: Interrupts, *checks: Callable[[], None]) -> Callable[[], None]:
    """One check that a signal or any of ``checks`` ends."""

    def check() -> None:
        interrupts.check()
        for each in checks:
            each()

    return check


def _explanation(plan: Plan) -> list[str]:
    """The lines of the explanation that are no copies of the diagnostics; at least one."""
    told = {str(diagnostic) for diagnostic in plan.diagnostics}
    lines = [line for line in plan.explanation.splitlines() if line not in told]
    if lines:
        return lines
    errors = sum(not diagnostic.warning for diagnostic in plan.diagnostics)
    if not errors:
        return ['the nodes did not say why']
    return [f'{errors} error{"" if errors == 1 else "s"} in the mission']
