"""What the tests of the task planner share: missions as text, and motion planners that are not there."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from task_planner_node.mission import MissionText
from task_planner_node.oracle import (
    Advice,
    AdviceQuery,
    Answer,
    CandidateAdvice,
    Oracle,
    Query,
    Scope,
    Status,
    TextCheck,
)
from task_planner_node.outcomes import Options, Result
from task_planner_node.planner import Planner

ROVER = Path(__file__).parents[2] / 'interface_node' / 'missions' / 'rover'
PLACES = {
    'location0': (20.0, 20.0),
    'location1': (67.0, 171.0),
    'location2': (206.0, 542.0),
    'location3': (362.0, 350.0),
    'location4': (580.0, 526.0),
    'location5': (772.0, 301.0),
    'location6': (588.0, 278.0),
    'location7': (601.0, 20.0),
    'location8': (344.0, 145.0),
}


def labels(text: str) -> tuple[str, ...]:
    """The objects of ground preconditions."""
    return tuple(re.findall(r'\(object (\S+?)\)', text))


@dataclass
class RoverMotionPlanner:
    """Drives in straight lines; some places are walled in, others are never found."""

    walled: frozenset[str] = frozenset()
    unknown: frozenset[str] = frozenset()
    destinations: int = 1
    queries: list[Query] = field(default_factory=list)
    advised: list[tuple[str, ...]] = field(default_factory=list)

    def check(self, text: str, _source: str, _line: int, _column: int) -> TextCheck:
        return TextCheck('setProperty' in text)

    def satisfy(self, query: Query) -> Answer:
        self.queries.append(query)
        (label,) = labels(query.preconditions)
        if 'setProperty' in query.preconditions:
            return Answer(Status.FOUND, end=(PLACES[label], 0), assigned=True, objects=(label,))
        if label in self.walled:
            reason = f'{label} is walled in'
            return Answer(Status.IMPOSSIBLE, 103, Scope.CONNECTED_STARTS, reason, objects=(label,))
        if label in self.unknown or query.alternative >= self.destinations:
            return Answer(Status.UNKNOWN, 202, message=f'no path to {label}', objects=(label,))
        assert isinstance(query.start, tuple)
        length = math.dist(query.start[0], PLACES[label])
        end = (PLACES[label], query.alternative)
        return Answer(Status.FOUND, end=end, length=length, objects=(label,))

    def advise(self, query: AdviceQuery) -> Advice:
        places = [labels(text)[0] for text in query.preconditions]
        self.advised.append(tuple(places))
        start = query.start
        assert isinstance(start, tuple)
        costs = [(label in self.walled, math.dist(start[0], PLACES[label])) for label in places]
        candidates = tuple(
            CandidateAdvice(
                label in self.walled,
                Scope.CONNECTED_STARTS,
                103 if label in self.walled else 0,
                f'{label} is walled in' if label in self.walled else '',
                (label,),
                math.dist(start[0], PLACES[label]),
            )
            for label in places
        )
        return Advice(candidates, tuple(sorted(range(len(places)), key=lambda i: costs[i])))


class NoMotionPlanner:
    """For missions without geometric preconditions: being asked anything but a check is an error."""

    def check(self, _text: str, _source: str, _line: int, _column: int) -> TextCheck:
        return TextCheck(assigns=False)

    def satisfy(self, query: Query) -> Answer:
        raise AssertionError(query)

    def advise(self, query: AdviceQuery) -> Advice:
        raise AssertionError(query)


@pytest.fixture(scope='session')
def rover_motion_planner() -> type[RoverMotionPlanner]:
    return RoverMotionPlanner


@pytest.fixture(scope='session')
def no_motion_planner() -> NoMotionPlanner:
    return NoMotionPlanner()


@pytest.fixture(scope='session')
def rover_mission() -> tuple[str, str]:
    """Domain and problem of the paper."""
    return (ROVER / 'domain.lisp').read_text(), (ROVER / 'problem.lisp').read_text()


@pytest.fixture(scope='session')
def plan() -> Callable[..., Result]:
    """Plan two texts, named d.lisp and p.lisp."""

    def run(
        domain: str, problem: str, oracle: Oracle | None = None, options: Options | None = None
    ) -> Result:
        planner = Planner(oracle or NoMotionPlanner(), options or Options())
        return planner.plan(MissionText('d.lisp', domain), MissionText('p.lisp', problem))

    return run
