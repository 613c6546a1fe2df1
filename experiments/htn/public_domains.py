"""Reads every HDDL mission below a folder, as in the repository of the planning competition of 2020.

Nothing of such a repository is shipped: clone it and name the folder.  With ``--solve`` each mission is searched for
so many seconds, and its plan judged by unified-planning.

    python -m experiments.htn.public_domains FOLDER [--solve SECONDS] [--first N]
"""

from __future__ import annotations

import argparse
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from experiments.htn.validation import NotJudged, fault_of
from task_planner_node.errors import Diagnostic, MissionError, Severity
from task_planner_node.language import check_mission
from task_planner_node.language.model import show
from task_planner_node.mission import MissionText, read_mission
from task_planner_node.oracle import Advice, AdviceQuery, Answer, Query, TextCheck
from task_planner_node.outcomes import Options, Outcome
from task_planner_node.planner import Planner


class NoMotionPlanner:
    """Stands where HDDL has nothing to ask."""

    def check(self, text: str, source: str, line: int, column: int) -> TextCheck:
        """Never asked."""
        raise LookupError((text, source, line, column))

    def satisfy(self, query: Query) -> Answer:
        """Never asked."""
        raise LookupError(query)

    def advise(self, query: AdviceQuery) -> Advice:
        """Never asked."""
        raise LookupError(query)


def missions(folder: Path) -> Iterator[tuple[Path, Path]]:
    """Each problem with its domain: ``domain.hddl`` beside it, or ``<problem>-domain.hddl``."""
    for problem in sorted(folder.rglob('*.hddl')):
        if 'domain' in problem.name.lower():
            continue
        names = ('domain.hddl', f'{problem.stem}-domain.hddl', f'domain-{problem.stem}.hddl')
        found = [problem.with_name(name) for name in names if problem.with_name(name).exists()]
        if found:
            yield found[0], problem


def faults_of(domain: Path, problem: Path) -> list[Diagnostic]:
    """The errors of one mission."""
    try:
        pair = read_mission(MissionText(str(domain)), MissionText(str(problem)))
    except MissionError as error:
        return list(error.diagnostics)
    return [remark for remark in check_mission(*pair) if remark.severity == Severity.ERROR]


def solve(domain: Path, problem: Path, seconds: float) -> str:
    """The outcome of a search, ``VALID`` or why the plan is none."""
    planner = Planner(NoMotionPlanner(), Options(time_budget=seconds))
    result = planner.plan(MissionText(str(domain)), MissionText(str(problem)))
    if result.outcome != Outcome.SOLVED:
        return result.outcome.name
    actions = [[show(part) for part in step.action] for step in result.steps]
    try:
        fault = fault_of(domain, problem, actions)
    except NotJudged:
        return 'not judged'
    return f'WRONG: {fault}' if fault else 'VALID'


def main() -> None:
    """Print a line for each folder of missions, and the sum."""
    parser = argparse.ArgumentParser(description=(__doc__ or '').partition('\n')[0])
    parser.add_argument('folder', type=Path)
    parser.add_argument('--solve', type=float, default=0.0, metavar='SECONDS')
    parser.add_argument('--first', type=int, default=0, metavar='N', help='of each folder only')
    options = parser.parse_args()
    counts: dict[Path, Counter[str]] = {}
    began = time.monotonic()
    for domain, problem in missions(options.folder):
        count = counts.setdefault(problem.parent, Counter())
        if options.first and count['missions'] == options.first:
            continue
        count['missions'] += 1
        faults = faults_of(domain, problem)
        count['read' if not faults else 'refused'] += 1
        for fault in faults[:1]:
            print(f'  {fault}')
        if options.solve and not faults:
            count[solve(domain, problem, options.solve)] += 1
    total: Counter[str] = sum(counts.values(), Counter())
    for folder, count in [*counts.items(), (Path('all'), total)]:
        name = folder.relative_to(options.folder) if folder != Path('all') else folder
        print(f'{name}: ' + ', '.join(f'{number} {what}' for what, number in count.items()))
    print(f'{time.monotonic() - began:.0f} s')


if __name__ == '__main__':
    main()
