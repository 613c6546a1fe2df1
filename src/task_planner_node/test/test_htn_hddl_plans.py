"""Plans in the competition's format, verified against the HDDL text by a verifier that shares no code with the planner."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from task_planner_node.hddl import plan_text
from task_planner_node.mission import MissionText
from task_planner_node.oracle import Oracle
from task_planner_node.outcomes import Options, Outcome
from task_planner_node.planner import Planner

DOMAINS = Path(__file__).parents[1] / 'domains'
WORD = re.compile(r';[^\n]*|[()]|[^\s()]+')


def tree_of(text: str) -> Any:
    """The first list in a text, as nested Python lists of lower-case words."""
    stack: list[list[Any]] = [[]]
    for word in WORD.findall(text):
        if word == '(':
            stack.append([])
        elif word == ')':
            done = stack.pop()
            stack[-1].append(done)
        elif not word.startswith(';'):
            stack[-1].append(word.lower())
    return stack[0][0]


def fields(definition: list[Any]) -> dict[str, Any]:
    return {word: definition[i + 1] for i, word in enumerate(definition[:-1]) if word[:1] == ':'}


def subtasks(part: dict[str, Any]) -> tuple[list[list[str]], list[tuple[int, int]]]:
    """The tasks of a network and the pairs of them that are ordered."""
    word = next((w for w in (':subtasks', ':tasks', ':ordered-subtasks') if w in part), '')
    content = part.get(word, [])
    parts = content[1:] if content[:1] == ['and'] else [content] if content else []
    names = [each[0] if len(each) > 1 and isinstance(each[1], list) else '' for each in parts]
    tasks = [each[1] if name else each for name, each in zip(names, parts, strict=True)]
    if word == ':ordered-subtasks':
        return tasks, list(pairwise(range(len(tasks))))
    order = part.get(':ordering', [])
    pairs = order[1:] if order[:1] == ['and'] else [order] if order else []
    return tasks, [(names.index(first), names.index(second)) for _, first, second in pairs]


class Verifier:
    """A plan text beside the definitions of its domain."""

    def __init__(self, text: str, domain: Any, problem: Any) -> None:
        lines = text.strip().split('\n')
        assert lines[0] == '==>'
        assert lines[-1] == '<=='
        self.actions: dict[int, list[str]] = {}
        self.tasks: dict[int, tuple[list[str], str, list[int]]] = {}
        self.roots: list[int] = []
        for line in lines[1:-1]:
            words = line.lower().split()
            if words[0] == 'root':
                self.roots = [int(word) for word in words[1:]]
            elif '->' in words:
                arrow = words.index('->')
                children = [int(word) for word in words[arrow + 2 :]]
                self.tasks[int(words[0])] = (words[1:arrow], words[arrow + 1], children)
            else:
                self.actions[int(words[0])] = words[1:]
        self.methods = {d[1]: fields(d) for d in domain if d[0] == ':method'}
        self.names = {d[1] for d in domain if d[0] == ':action'}
        self.network = next(fields(['', *d]) for d in problem if d[0] == ':htn')

    def verify(self) -> None:
        used = [*self.roots, *(c for _, _, children in self.tasks.values() for c in children)]
        assert sorted(used) == sorted({**self.actions, **self.tasks}), 'each is used once'
        assert {words[0] for words in self.actions.values()} <= self.names
        self.check_part(self.network, self.roots, {})
        for words, method, children in self.tasks.values():
            definition = self.methods[method]
            binding: dict[str, str] = {}
            self.unify(definition[':task'], words, binding)
            self.check_part(definition, children, binding)

    def check_part(
        self, part: dict[str, Any], children: list[int], binding: dict[str, str]
    ) -> None:
        tasks, pairs = subtasks(part)
        assert len(tasks) == len(children)
        for task, child in zip(tasks, children, strict=True):
            words = self.actions[child] if child in self.actions else self.tasks[child][0]
            self.unify(task, words, binding)
        for first, second in pairs:
            before, after = [*self.leaves(children[first])], [*self.leaves(children[second])]
            assert not before or not after or max(before) < min(after)

    def unify(self, pattern: list[str], words: list[str], binding: dict[str, str]) -> None:
        assert len(pattern) == len(words)
        for wanted, word in zip(pattern, words, strict=True):
            assert binding.setdefault(wanted, word) == word if wanted[0] == '?' else wanted == word

    def leaves(self, number: int) -> Iterator[int]:
        if number in self.actions:
            yield number
        else:
            for child in self.tasks[number][2]:
                yield from self.leaves(child)


def verifier(folder: str, oracle: Oracle) -> Verifier:
    domain, problem = (DOMAINS / folder / name for name in ('domain.hddl', 'problem.hddl'))
    planner = Planner(oracle, Options())
    result = planner.plan(MissionText(str(domain)), MissionText(str(problem)))
    assert result.outcome == Outcome.SOLVED
    text = plan_text(result.plans[0].tree)
    found = Verifier(text, tree_of(domain.read_text())[2:], tree_of(problem.read_text())[2:])
    assert [words[0] for words in found.actions.values()] == [
        str(step.action[0]).lstrip('!') for step in result.steps
    ]
    return found


@pytest.mark.parametrize('folder', ['parcels', 'kitchen'])
def test_the_written_plan_is_a_decomposition(folder: str, no_motion_planner: Oracle) -> None:
    verifier(folder, no_motion_planner).verify()


@pytest.mark.parametrize('folder', ['parcels', 'kitchen'])
def test_the_verifier_notices_what_is_wrong(folder: str, no_motion_planner: Oracle) -> None:
    found = verifier(folder, no_motion_planner)
    number, (words, method, children) = next(
        (number, task) for number, task in found.tasks.items() if len(task[2]) > 1
    )
    found.tasks[number] = (words, method, [children[1], children[0], *children[2:]])
    with pytest.raises(AssertionError):
        found.verify()
    found.tasks[number] = (words, method, children[:-1])
    with pytest.raises(AssertionError):
        found.verify()
    found.tasks[number] = (words, method, children)
    found.verify()
