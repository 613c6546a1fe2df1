"""Dead ends that have the same cause, counted together, so that a person sees all causes at once."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from task_planner_node.explanation.vocabulary import labels_of
from task_planner_node.language.model import shorten, show
from task_planner_node.search.dead_ends import DeadEnd

TOKEN = re.compile(r'[^\s(),;:]+')
NUMBER = re.compile(r'[-+]?\d+(\.\d+)?(e[-+]?\d+)?')
ARGUMENTS = re.compile(r'\(([^\s()]+) [^()]*\)')


@dataclass
class Cause:
    """The first of ``alike`` dead ends, which were come to ``count`` times in all."""

    example: DeadEnd
    alike: int = 0
    count: int = 0

    def __str__(self) -> str:
        others = f' and {self.alike - 1} like it' if self.alike > 1 else ''
        times = f' ({self.count} times)' if self.count > self.alike else ''
        return f'{shorten(show(self.example.task))}{others}: {self.example.reason}{times}'


def causes_of(dead_ends: Sequence[DeadEnd], most: int) -> list[Cause]:
    """The causes, in the order of their first dead ends: each dead end is its own if they are at most ``most``.

    Else those are put together whose tasks have one name and whose reasons differ in the arguments of the tasks and in
    numbers only; and if that still leaves more than ``most``, those whose reasons differ in any arguments.
    """
    if len(dead_ends) <= most:
        return [Cause(dead_end, 1, dead_end.count) for dead_end in dead_ends]
    causes = _grouped(dead_ends, coarsely=False)
    return causes if len(causes) <= most else _grouped(dead_ends, coarsely=True)


def _grouped(dead_ends: Sequence[DeadEnd], coarsely: bool) -> list[Cause]:
    found: dict[tuple[object, int, str], Cause] = {}
    for dead_end in dead_ends:
        task = dead_end.task
        cause = found.setdefault(
            (task[0], len(task), _pattern(dead_end, coarsely)), Cause(dead_end)
        )
        cause.alike += 1
        cause.count += dead_end.count
    return list(found.values())


def _pattern(dead_end: DeadEnd, coarsely: bool) -> str:
    places: dict[str, str] = {}
    for label in labels_of(dead_end.task):
        places.setdefault(label, f'?{len(places)}')

    def general(found: re.Match[str]) -> str:
        word = found.group()
        return '#' if NUMBER.fullmatch(word) else places.get(word, word)

    text = TOKEN.sub(general, dead_end.reason)
    return ARGUMENTS.sub(r'(\1)', text) if coarsely else text
