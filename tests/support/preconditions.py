"""What a mission's domain file asks of attitudes, checked without the planner's reader or functions.

Operators are found in the text, their variables are replaced by the action's arguments, and the
constraints are judged by ``experiments/constraints/judge.py``: Python's parser, math and shapely.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from experiments.constraints.judge import Judge
from experiments.constraints.sets import ConstraintSet
from tests.support.vehicle import TOLERANCE, Pose

_STATEMENT = re.compile(r'(?:agent|object|region)\s')


class Preconditions:
    """The geometric preconditions of the operators of a domain, in the paper's form."""

    def __init__(self, domain: str, world: Mapping[str, Any]):
        self.world = world
        self._operators: dict[str, tuple[list[str], list[str]]] = {}
        text = re.sub(r';[^\n]*', '', domain)
        for head in re.finditer(r'\(Operator\s+\((!\S+)([^()]*)\)', text):
            after = _lists(text, head.end())
            next(after)
            parts = [part[1:-1].strip() for part in _lists(next(after)[1:-1], 0)]
            self._operators[head[1]] = head[2].split(), parts

    def faults(
        self, action: Sequence[str], agent: str, attitudes: Mapping[str, Pose]
    ) -> Iterator[str]:
        """Say which constraints ``attitudes``, those of all robots after the action, miss."""
        parameters, parts = self._operators[action[0]]
        values = dict(zip(parameters, action[1:], strict=True))
        ground = [re.sub(r'\?[\w-]+', lambda name: values[name[0]], part) for part in parts]
        agents = re.findall(r'\(agent (\S+)\)', ' '.join(f'({part})' for part in ground))
        if agents[:1] != [agent]:
            yield f'{agent} moves, not {agents[:1]}'
            return
        robots = {
            label: {'start': dict(zip(('x', 'y', 'heading'), pose, strict=True))}
            for label, pose in attitudes.items()
        }
        judge = Judge({**self.world, 'robots': robots}, agent)
        for part in ground:
            if _STATEMENT.match(part):
                continue
            constraint = _as_constraint(part)
            asked = ConstraintSet('', (constraint,), feasible=True, agents=(), objects=())
            missed = judge.violation(asked, attitudes[agent], bounded=False)
            if not missed <= TOLERANCE:
                yield f'{constraint} is missed by {missed}'


def _as_constraint(part: str) -> str:
    """A command holds afterwards as an equation."""
    command = re.fullmatch(r'setProperty\(([^,]+),(.+)\)', part, re.DOTALL)
    return f'{command[1]} = {command[2]}' if command else ' '.join(part.split())


def _lists(text: str, start: int) -> Iterator[str]:
    """The balanced lists that follow one another in a text from ``start`` on."""
    depth = begin = 0
    for place in range(start, len(text)):
        if text[place] == '(':
            begin = begin if depth else place
            depth += 1
        elif text[place] == ')':
            depth -= 1
            if depth == 0:
                yield text[begin : place + 1]
            elif depth < 0:
                return
