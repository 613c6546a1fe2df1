"""Numbers, names and keys out of a YAML tree, with every fault noted at its place."""

from __future__ import annotations

import re
from collections.abc import Collection
from difflib import get_close_matches
from math import isfinite

from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic, MotionPlannerError
from motion_planner_node.world.syntax import Mapping, Node, Place, Scalar, Sequence

#: The largest number [m] that is read: beyond it, a nanometre is lost in rounding.
LARGEST_NUMBER = 1e7
#: The smallest length [m] of anything that has to have one.
SMALLEST_LENGTH = 1e-3
#: Faults that are told at once.
MOST_FAULTS = 100

_NUMBER = re.compile(r'[-+]?((0|[1-9][0-9]*)(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?')
_NOT_FINITE = re.compile(r'[-+]?\.?(nan|inf|infinity)', re.IGNORECASE)
_BOOLEANS = frozenset({'true', 'false', 'yes', 'no', 'on', 'off'})
_LABEL = re.compile(r'[^\W\d]\w*(-[^\W\d_]\w*)*')
_FIELD = re.compile(r'[^\W\d]\w*')
_RESERVED = frozenset({'pi', 'nil'})
LONGEST_NAME = 100


class Faults:
    """Collects what is wrong with a text."""

    def __init__(self, source: str) -> None:
        self._source = source
        self._diagnostics: list[Diagnostic] = []
        self._left_out = 0

    def add(self, message: str, place: Place, text: str = '') -> None:
        """Note ``message`` at ``place``; beyond the first hundred they are only counted."""
        if len(self._diagnostics) == MOST_FAULTS:
            self._left_out += 1
            return
        self._diagnostics.append(
            Diagnostic(
                message, place.line, place.column, text[:80], self._source, code=Code.NO_WORLD
            )
        )

    def include(self, others: Faults) -> None:
        """Take over the faults of another file, after those noted so far."""
        room = MOST_FAULTS - len(self._diagnostics)
        self._left_out += others._left_out + max(len(others._diagnostics) - room, 0)
        self._diagnostics += others._diagnostics[:room]

    def __bool__(self) -> bool:
        return bool(self._diagnostics)

    def error(self) -> MotionPlannerError:
        """The error (NO_WORLD) with all faults, of which there is at least one, in their order."""
        diagnostics = sorted(
            self._diagnostics,
            key=lambda fault: (
                fault.source != self._source,
                fault.source,
                fault.line,
                fault.column,
            ),
        )
        if self._left_out:
            message = f'and {self._left_out} more faults'
            diagnostics.append(Diagnostic(message, source=self._source, code=Code.NO_WORLD))
        return MotionPlannerError.from_diagnostics(diagnostics)


def is_nothing(node: Node) -> bool:
    """Whether a key is followed by no value."""
    return isinstance(node, Scalar) and node.plain and node.text in ('', '~', 'null')


def kind_of(node: Node) -> str:
    """What a person would call ``node``."""
    if isinstance(node, Mapping):
        return 'keys and values'
    if isinstance(node, Sequence):
        return f'a list of {len(node.items)}'
    if not node.plain:
        return f'the text "{node.text[:40]}"'
    if is_nothing(node):
        return 'nothing'
    if node.text.lower() in _BOOLEANS:
        return f'the truth value {node.text}'
    return node.text[:40]


def read_number(node: Node, what: str, faults: Faults) -> float | None:
    """A finite number not larger than ``LARGEST_NUMBER``."""
    if not isinstance(node, Scalar) or not node.plain or not _NUMBER.fullmatch(node.text):
        if isinstance(node, Scalar) and node.plain and _NOT_FINITE.fullmatch(node.text):
            faults.add(f'{what} has to be finite, not {node.text}', node.place, node.text)
        else:
            faults.add(f'{what} has to be a number, not {kind_of(node)}', node.place)
        return None
    number = float(node.text)
    if not isfinite(number) or abs(number) > LARGEST_NUMBER:
        message = f'{what} is {node.text[:40]}, beyond {LARGEST_NUMBER:g}'
        faults.add(message, node.place, node.text)
        return None
    return number + 0.0


def read_at_least(node: Node, what: str, least: float, faults: Faults) -> float | None:
    """A number that is not less than ``least``."""
    number = read_number(node, what, faults)
    if number is not None and number < least:
        faults.add(f'{what} has to be at least {least:g}, not {number:g}', node.place)
        return None
    return number


def check_count(node: Node, what: str, most: int, faults: Faults) -> bool:
    """Whether a list or mapping has at most ``most`` items; more are a fault."""
    count = 0
    if isinstance(node, Sequence):
        count = len(node.items)
    elif isinstance(node, Mapping):
        count = len(node.entries)
    if count > most:
        faults.add(f'{count} {what} are more than the {most} allowed', node.place)
    return count <= most


def read_numbers(node: Node, what: str, names: Collection[str], faults: Faults) -> list[float]:
    """The numbers of a list with one item for each of ``names``; empty when there is a fault."""
    if not isinstance(node, Sequence) or len(node.items) != len(names):
        faults.add(f'{what} has to be [{", ".join(names)}], not {kind_of(node)}', node.place)
        return []
    numbers = [
        read_number(item, f'{what}: {name}', faults)
        for item, name in zip(node.items, names, strict=True)
    ]
    return [number for number in numbers if number is not None] if None not in numbers else []


def read_mapping(node: Node, what: str, faults: Faults) -> dict[str, tuple[Place, Node]]:
    """The entries of a mapping, each key once, with the places of the keys."""
    if not isinstance(node, Mapping):
        faults.add(f'{what} has to be keys and values, not {kind_of(node)}', node.place)
        return {}
    entries: dict[str, tuple[Place, Node]] = {}
    for key, value in node.entries:
        if key.text in entries:
            first = entries[key.text][0].line
            message = f'{what}: {key.text[:40]} is there already, in line {first}'
            faults.add(message, key.place, key.text)
        else:
            entries[key.text] = (key.place, value)
    return entries


def read_fields(
    node: Node, what: str, required: Collection[str], optional: Collection[str], faults: Faults
) -> dict[str, Node]:
    """The values of a mapping that has these keys and no other."""
    entries = read_mapping(node, what, faults)
    known = [*required, *optional]
    for key, (place, _) in entries.items():
        if key not in known:
            close = get_close_matches(key, known, 1)
            hint = f'did you mean {close[0]}?' if close else f'known are {", ".join(known)}'
            faults.add(f'{what} has no {key[:40] or "empty key"}; {hint}', place, key)
    if isinstance(node, Mapping):
        for key in required:
            if key not in entries:
                faults.add(f'{what} lacks {key}', node.place)
    return {key: value for key, (_, value) in entries.items() if key in known}


def check_label(label: str, place: Place, what: str, faults: Faults) -> None:
    """Note when ``label`` cannot be written in the Lisp syntax and in preconditions."""
    if len(label) > LONGEST_NAME:
        faults.add(f'{what} has a name longer than {LONGEST_NAME} characters', place, label)
    elif label in _RESERVED:
        faults.add(f'{what} cannot be called {label}, which has a meaning already', place, label)
    elif not _LABEL.fullmatch(label):
        message = (
            f'{what} cannot be called "{label}": a name is letters, digits and _, '
            'begins with a letter, and has a hyphen only before a letter'
        )
        faults.add(message, place, label)


def check_field(name: str, place: Place, what: str, faults: Faults) -> None:
    """Note when ``name`` cannot be the name of a field in preconditions."""
    if len(name) > LONGEST_NAME or not _FIELD.fullmatch(name):
        message = f'{what} cannot have a field "{name[:40]}": letters, digits and _ are allowed'
        faults.add(message, place, name)


def read_text(node: Node, what: str, faults: Faults, most: int = LONGEST_NAME) -> str | None:
    """A text of one line that is not empty and has at most ``most`` characters."""
    if not isinstance(node, Scalar) or not node.text.strip() or '\n' in node.text:
        faults.add(f'{what} has to be a text of one line, not {kind_of(node)}', node.place)
        return None
    if len(node.text) > most:
        faults.add(f'{what} is longer than {most} characters', node.place, node.text)
        return None
    return node.text
