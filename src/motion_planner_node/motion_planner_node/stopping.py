"""How long work is told to stop: a predicate that goes down with it and is asked now and then."""

from __future__ import annotations

from collections.abc import Callable

from motion_planner_node.errors import Stopped

#: Whether to stop now: the deadline is over, or the client took the request back.
ShouldStop = Callable[[], bool]


def never() -> bool:
    """The predicate of work that nobody breaks off."""
    return False


def go_on(should_stop: ShouldStop) -> None:
    """Ask whether to stop.

    :raises Stopped: when ``should_stop`` says so
    """
    if should_stop():
        raise Stopped
