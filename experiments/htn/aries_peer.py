"""Aries, the planner for hierarchies of unified-planning, on HDDL files."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter


@dataclass(frozen=True)
class Run:
    """How the search ended, the number of actions, and the time [s] of reading and searching."""

    outcome: str
    actions: int
    seconds: float


def plan(domain: Path, problem: Path, budget: float) -> Run:
    """Plan in a process of its own, which is ended after ``budget`` [s]."""
    began = perf_counter()
    words = [sys.executable, '-m', __name__, str(domain), str(problem)]
    pipe = subprocess.PIPE
    # The planner is a server that this process starts: both are ended with their session.
    process = subprocess.Popen(words, stdout=pipe, stderr=pipe, text=True, start_new_session=True)
    try:
        output, faults = process.communicate(timeout=budget)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return Run('no answer in time', 0, perf_counter() - began)
    if process.returncode:
        fault = (faults.strip().splitlines() or ['failed'])[-1]
        return Run(fault[:80], 0, perf_counter() - began)
    found = json.loads(output.splitlines()[-1])
    return Run(found['outcome'], found['actions'], found['seconds'])


def main(domain: str, problem: str) -> None:
    """Plan, and print the run in JSON."""
    from unified_planning.io import PDDLReader
    from unified_planning.shortcuts import OneshotPlanner, get_environment

    environment = get_environment()
    environment.credits_stream = None
    environment.error_used_name = False
    began = perf_counter()
    mission = PDDLReader().parse_problem(domain, problem)
    with OneshotPlanner(name='aries') as planner:
        result = planner.solve(mission)
    seconds = perf_counter() - began
    actions = 0
    if result.plan is not None:
        flat = getattr(result.plan, 'action_plan', result.plan)
        actions = len(getattr(flat, 'actions', None) or flat.timed_actions)
    found = {'outcome': result.status.name, 'actions': actions, 'seconds': seconds}
    print('\n' + json.dumps(found))


if __name__ == '__main__':
    main(*sys.argv[1:])
