"""The text that describes a message type in a recording: its definition and all it depends on."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

#: What a field's type may be without being another message.
PRIMITIVES = frozenset(('bool', 'byte', 'char', 'string', 'wstring', 'float32', 'float64')).union(
    f'{sign}int{bits}' for sign in ('', 'u') for bits in (8, 16, 32, 64)
)
SEPARATOR = '=' * 80


def schema_text(name: str, definition: Callable[[str], str]) -> str:
    """The definition of ``name``, for example ``nav_msgs/msg/Path``, in the encoding ros2msg.

    ``definition`` gives the text of a ``.msg`` file by such a name. The dependencies follow in the
    order in which they are first named, each after a line of 80 ``=`` and ``MSG: package/Name``.
    """
    texts: dict[str, str] = {}
    waiting = [name]
    while waiting:
        current = waiting.pop(0)
        if current not in texts:
            texts[current] = definition(current)
            waiting += dependencies(current.split('/')[0], texts[current])
    parts = [texts.pop(name).rstrip('\n')]
    parts += [
        f'{SEPARATOR}\nMSG: {other.replace("/msg/", "/")}\n{text.rstrip()}'
        for other, text in texts.items()
    ]
    return '\n'.join(parts) + '\n'


def same_definition(first: str, second: str) -> bool:
    """Whether two such texts define the same fields, whatever their comments and order."""
    return _sections(first) == _sections(second)


def dependencies(package: str, text: str) -> Iterator[str]:
    """Message types that the fields of a definition in ``package`` have, as package/msg/Name."""
    for line in text.splitlines():
        words = line.split('#')[0].split()
        if not words:
            continue
        kind = re.sub(r'(<=\d+)?(\[.*\])?$', '', words[0])
        if kind in PRIMITIVES:
            continue
        if kind == 'Header':
            kind = 'std_msgs/Header'
        owner, _, base = kind.rpartition('/')
        yield f'{owner.removesuffix("/msg") or package}/msg/{base}'


def _sections(text: str) -> tuple[list[str], set[str]]:
    own, *others = (
        [' '.join(line.split('#')[0].split()) for line in section.splitlines()]
        for section in re.split(r'(?m)^={80}$', text)
    )
    return [line for line in own if line], {'\n'.join(filter(None, lines)) for lines in others}
