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


class Watch:
    """Looks at the clock for work that takes turns with others, each of whom asks for themselves."""

    def __init__(self) -> None:
        self.should_stop: ShouldStop = never

    def look(self) -> None:
        """Go on.

        :raises Stopped: when ``should_stop`` says not to
        """
        go_on(self.should_stop)
