"""Which robots a set of ground geometric preconditions names."""

from __future__ import annotations

import re

AGENT = re.compile(r'\(\s*agent\s+([^\s()]+)\s*\)')


def robots_of(text: str) -> tuple[str, ...]:
    """The robots that ``text`` names as agents, the one that moves first."""
    return tuple(AGENT.findall(text))


def anywhere(text: str) -> str:
    """The robot of ``text``, and nothing that it has to meet."""
    return ''.join(f'((agent {robot}))' for robot in robots_of(text)[:1])
