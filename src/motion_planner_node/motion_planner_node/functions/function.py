"""What the language knows of a function: its name, kinds, value and derivatives."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from typing import Any


class Kind(Enum):
    """What an argument or a result is; the value is its name in messages."""

    NUMBER = 'a number'
    ANGLE = 'an angle'
    PLACE = 'an agent or an object'
    AGENT = 'an agent'


#: Components of the state vector by which a derivative can be taken, in the order of gradients.
COMPONENTS = ('x', 'y', 'heading')


@dataclass(frozen=True, slots=True)
class Function:
    """A function of the library (Table 2 of the paper).

    ``value`` takes a ``Scalar`` for each NUMBER (an ANGLE is one too, in radians, modulo 2 pi) and
    a ``Place`` for each PLACE or AGENT, and returns a ``Scalar``. Its derivatives follow by
    forward-mode differentiation; ``derived_codes`` names the components whose derivatives the
    paper's truncated gradient keeps.
    """

    name: str
    arguments: tuple[Kind, ...]
    result: Kind
    value: Callable[..., Any]
    description: str
    derived_codes: tuple[str, ...] = COMPONENTS
    symmetric: bool = False

    def truncated(self, *arguments: Any) -> Any:
        """``value`` with only the derivatives of ``derived_codes``, as in Table 2."""
        result = self.value(*arguments)
        if self.derived_codes == COMPONENTS:
            return result
        return result.restricted(tuple(name in self.derived_codes for name in COMPONENTS))
