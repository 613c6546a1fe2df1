"""Comparing two answers field by field: the same means bit for bit."""

from __future__ import annotations

import struct
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Protocol, runtime_checkable


@runtime_checkable
class Message(Protocol):
    """What all generated messages have in common."""

    def get_fields_and_field_types(self) -> Mapping[str, str]:
        """Types of the fields, by name."""


def differences(
    recorded: Any, now: Any, ignored: frozenset[str] = frozenset(), where: str = ''
) -> Iterator[str]:
    """Say which fields differ, with both values; fields named in ``ignored`` may differ.

    Floats are equal when they have the same bits, or are both 0, so NaN equals NaN.
    """
    if isinstance(recorded, Message) and isinstance(now, Message):
        for name in recorded.get_fields_and_field_types():
            if name not in ignored:
                yield from differences(
                    getattr(recorded, name),
                    getattr(now, name),
                    ignored,
                    f'{where}.{name}' if where else name,
                )
    elif _is_sequence(recorded) and _is_sequence(now):
        if len(recorded) != len(now):
            yield f'{where} had {len(recorded)} elements and now has {len(now)}'
            return
        for index, (before, after) in enumerate(zip(recorded, now, strict=True)):
            yield from differences(before, after, ignored, f'{where}[{index}]')
    elif not _equal(recorded, now):
        yield f'{where} was {recorded!r} and now is {now!r}'


def _is_sequence(value: Any) -> bool:
    return hasattr(value, '__len__') and not isinstance(value, (str, bytes, Mapping))


def _equal(first: Any, second: Any) -> bool:
    if isinstance(first, float) and isinstance(second, float):
        return first == second or struct.pack('d', first) == struct.pack('d', second)
    return bool(first == second)


def sentence(name: str, found: Sequence[str]) -> str:
    """One sentence on an exchange that differs: the first differences, and how many more."""
    more = f' and {len(found) - 3} more differences' if len(found) > 3 else ''
    return f'{name}: {"; ".join(found[:3])}{more}'
