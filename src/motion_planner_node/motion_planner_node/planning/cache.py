"""A bounded memory of finished work."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

Key = TypeVar('Key', bound=Hashable)
Value = TypeVar('Value')


class Cache(Generic[Key, Value]):
    """Keeps the ``size`` values that were asked for last; what is ``forgotten`` is made anew."""

    def __init__(self, size: int, forgotten: Callable[[Value], object] = lambda _: None):
        self._size = size
        self._forgotten = forgotten
        self._values: OrderedDict[Key, Value] = OrderedDict()

    def get(self, key: Key, make: Callable[[], Value]) -> Value:
        """Return the value of ``key``; ``make`` it when it is not here. What raises is not kept."""
        if key in self._values:
            self._values.move_to_end(key)
            return self._values[key]
        value = make()
        self._values[key] = value
        if len(self._values) > self._size:
            self._forgotten(self._values.popitem(last=False)[1])
        return value

    def known(self, key: Key) -> Value | None:
        """The value of ``key``; None when it is not here."""
        return self._values.get(key)

    def clear(self) -> None:
        """Forget everything."""
        self._values.clear()

    def __len__(self) -> int:
        return len(self._values)
