"""Functions that arithmetic on numbers cannot express, such as distances to many obstacles."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]


class Field(Protocol):
    """A real function of a few numbers, evaluated for batches of n of each."""

    def values(self, *arguments: _Array) -> _Array:
        """Values (n,) at arguments (n,) each; NaN where undefined."""
        ...

    def slopes(self, *arguments: _Array) -> Sequence[_Array]:
        """Derivatives (n,) by each argument in turn; at a kink one of the one-sided ones."""
        ...

    def bounds(self, *ranges: tuple[_Array, _Array]) -> tuple[_Array, _Array]:
        """Least and greatest value (n,) over boxes, or numbers beyond them; infinite is allowed."""
        ...
