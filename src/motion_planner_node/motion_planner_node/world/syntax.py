"""YAML as a tree of values with their places; nothing is constructed, no tag or alias followed."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

import yaml

from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic, MotionPlannerError

#: The longest text [characters] and the deepest nesting of values that are read.
LONGEST_TEXT = 1 << 20
DEEPEST_NESTING = 16

_UNPRINTABLE = re.compile('[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]')
_LOADER = getattr(yaml, 'CSafeLoader', yaml.SafeLoader)


@dataclass(frozen=True, slots=True)
class Place:
    """Line and column, from 1."""

    line: int
    column: int


@dataclass(frozen=True, slots=True)
class Scalar:
    """A single value; ``plain`` when it stands without quotes."""

    place: Place
    text: str
    plain: bool


@dataclass(frozen=True, slots=True)
class Sequence:
    """Values in order."""

    place: Place
    items: list[Node] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class Mapping:
    """Keys and values in order, keys perhaps twice."""

    place: Place
    entries: list[tuple[Scalar, Node]] = field(default_factory=list)


Node = Scalar | Sequence | Mapping


def refusal(message: str, source: str, place: Place | None, text: str = '') -> MotionPlannerError:
    """The error for a text that cannot be read any further than ``place``."""
    line, column = (place.line, place.column) if place else (1, 1)
    return MotionPlannerError.from_diagnostics(
        [Diagnostic(message, line, column, text, source, code=Code.NO_WORLD)]
    )


def _place_of(mark: yaml.Mark | None) -> Place:
    return Place(mark.line + 1, mark.column + 1) if mark else Place(1, 1)


def _check_characters(text: str, source: str, most: int) -> None:
    if len(text) > most:
        message = f'the text has {len(text)} characters, more than the {most} allowed'
        raise refusal(message, source, None)
    found = _UNPRINTABLE.search(text)
    if found:
        before = text[: found.start()]
        place = Place(before.count('\n') + 1, found.start() - (before.rfind('\n') + 1) + 1)
        message = f'not a text file: character U+{ord(found.group()):04X} is not allowed'
        raise refusal(message, source, place)


class _Builder:
    """Turns the events of the YAML parser into a tree."""

    def __init__(self, events: Iterator[yaml.Event], source: str) -> None:
        self._events = events
        self._source = source

    def document(self) -> Node:
        root: Node | None = None
        for event in self._events:
            if isinstance(event, yaml.DocumentStartEvent):
                if root is not None:
                    message = 'a second document; a world is one'
                    raise refusal(message, self._source, _place_of(event.start_mark))
                root = self._node(next(self._events), 0)
        if root is None:
            raise refusal('the text is empty', self._source, None)
        return root

    def _node(self, event: yaml.Event, depth: int) -> Node:
        place = _place_of(event.start_mark)
        if isinstance(event, yaml.AliasEvent) or getattr(event, 'anchor', None):
            raise refusal('anchors and aliases are not allowed', self._source, place)
        tag = getattr(event, 'tag', None)
        if tag:
            raise refusal(f'tags such as {tag[:40]} are not allowed', self._source, place)
        if depth > DEEPEST_NESTING:
            message = f'nested more than {DEEPEST_NESTING} levels deep'
            raise refusal(message, self._source, place)
        if isinstance(event, yaml.ScalarEvent):
            return Scalar(place, event.value, event.style is None or event.style == '')
        if isinstance(event, yaml.SequenceStartEvent):
            sequence = Sequence(place)
            for item in self._events:
                if isinstance(item, yaml.SequenceEndEvent):
                    break
                sequence.items.append(self._node(item, depth + 1))
            return sequence
        mapping = Mapping(place)
        for item in self._events:
            if isinstance(item, yaml.MappingEndEvent):
                break
            key = self._node(item, depth + 1)
            if not isinstance(key, Scalar):
                raise refusal('a key has to be a name', self._source, key.place)
            mapping.entries.append((key, self._node(next(self._events), depth + 1)))
        return mapping


def read_tree(text: str, source: str, most: int = LONGEST_TEXT) -> Node:
    """The tree of the one YAML or JSON document in ``text``; ``source`` names it in errors.

    Raises MotionPlannerError (NO_WORLD) with line and column when it is longer than ``most``, nested
    too deeply, no text, not YAML, or uses anchors, aliases or tags.
    """
    _check_characters(text, source, most)
    try:
        return _Builder(iter(yaml.parse(text, Loader=_LOADER)), source).document()
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        message = ', '.join(part for part in (error.context, error.problem) if part)
        raise refusal(f'not YAML: {message}', source, _place_of(mark)) from None
    except yaml.YAMLError as error:
        raise refusal(f'not YAML: {error}', source, None) from None
