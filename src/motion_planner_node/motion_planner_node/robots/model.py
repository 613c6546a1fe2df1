"""What a model of robots says about itself; each model is one file beside this one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ompl import base


@dataclass(frozen=True)
class Model:
    """One way in which robots move.

    name: in world files and messages.
    components: of its state vector, in order; constraints and commands can name them.
    steers: whether it drives arcs: it has a wheelbase and a largest steering angle.
    reverses: whether it drives backwards.
    slides: whether it slides in any direction instead of driving ahead.
    turns: whether it turns on the spot: it has a turning speed.
    words: number of the words of its steering function.
    space: OMPL's state space of the model, given the turning radius [m].
    """

    name: str
    components: tuple[str, ...]
    steers: bool
    reverses: bool
    slides: bool
    turns: bool
    words: int
    space: Callable[[float], base.StateSpace]
