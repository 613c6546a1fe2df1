"""What the language knows of a function: its name, kinds, value and derivatives."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from typing import Any

from motion_planner_node.robots.motion import COMPONENTS


class Kind(Enum):
    """What an argument or a result is; the value is its name in messages."""

    NUMBER = 'a number'
    ANGLE = 'an angle'
    PLACE = 'an agent or an object'
    AGENT = 'an agent'
    REGION = 'a region'
    CONDITION = 'a condition'


@dataclass(frozen=True, slots=True)
class Function:
    """A function of the library (Table 2 of the paper).

    ``value`` takes a ``Scalar`` for each NUMBER or ANGLE (in radians, modulo 2 pi), a ``Place`` for
    each PLACE or AGENT and a ``Field`` for each REGION, and returns a ``Scalar``. Its derivatives
    follow by forward-mode differentiation.

    Attributes:
        name: as constraints spell it
        arguments: kinds of the arguments
        result: NUMBER or ANGLE, what ``value`` returns
        value: the function itself, over generic scalars
        description: a sentence for people
        derived_codes: the components whose derivatives the paper's truncated gradient keeps
        symmetric: whether the order of the arguments makes no difference
        condition: for a function that stands alone as a constraint, how ``value`` has to compare
            with zero: ``<=``, ``>=`` or ``=``
        repeats: whether more arguments of the last kind may follow
        sees_world: whether ``value`` takes the ``Surroundings`` before its other arguments
    """

    name: str
    arguments: tuple[Kind, ...]
    result: Kind
    value: Callable[..., Any]
    description: str
    derived_codes: tuple[str, ...] = COMPONENTS
    symmetric: bool = False
    condition: str = ''
    repeats: bool = False
    sees_world: bool = False

    @property
    def gives(self) -> Kind:
        """What a call is: CONDITION for what stands alone, else ``result``."""
        return Kind.CONDITION if self.condition else self.result

    def kinds(self, count: int) -> tuple[Kind, ...] | None:
        """Kinds of ``count`` arguments, None if the function does not take so many."""
        more = count - len(self.arguments)
        if more and not (self.repeats and more > 0):
            return None
        return self.arguments + self.arguments[-1:] * more

    def truncated(self, *arguments: Any) -> Any:
        """``value`` with only the derivatives of ``derived_codes``, as in Table 2."""
        result = self.value(*arguments)
        if self.derived_codes == COMPONENTS:
            return result
        return result.restricted(tuple(name in self.derived_codes for name in COMPONENTS))
