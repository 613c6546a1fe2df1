"""Requests of several clients: one is worked on at a time, in the order in which they came."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from time import perf_counter

from motion_planner_node.codes import Code
from motion_planner_node.errors import MotionPlannerError, Stopped

#: Why a request was broken off, in words.
REASONS = {
    Code.CANCELLED: 'the request was cancelled',
    Code.OUT_OF_TIME: 'the time budget ran out',
}


class Turn:
    """The turn of one request: calling it says whether the work has to stop (``should_stop``)."""

    def __init__(self, request_id: str, end: float, clock: Callable[[], float]) -> None:
        self.request_id = request_id
        self.cancelled = False
        self._end = end
        self._clock = clock

    def __call__(self) -> bool:
        """Whether the work has to stop."""
        return self.cancelled or self._clock() > self._end

    @property
    def time_left(self) -> float:
        """What is left of the budget [s]; negative when it is spent."""
        return self._end - self._clock()

    @property
    def code(self) -> Code:
        """Why it was broken off, where it was: CANCELLED or OUT_OF_TIME."""
        return Code.CANCELLED if self.cancelled else Code.OUT_OF_TIME

    def broken_off(self, where: str = '') -> MotionPlannerError:
        """The error that says so; ``where`` goes on with the sentence."""
        return MotionPlannerError(self.code, REASONS[self.code] + where)


class Turns:
    """A queue of requests; safe for several threads.

    The time that a request waits counts for its budget, and it can be cancelled while it waits.
    """

    def __init__(self, clock: Callable[[], float] = perf_counter) -> None:
        self._clock = clock
        self._changed = threading.Condition()
        self._queue: deque[Turn] = deque()
        self._closed = False

    @contextmanager
    def take(self, request_id: str, budget: float) -> Iterator[Turn]:
        """Wait for the turn of a request that has ``budget`` [s], and have it inside the block.

        :raises MotionPlannerError: CANCELLED or OUT_OF_TIME when that comes first, and for a
            Stopped inside the block
        """
        turn = Turn(request_id, self._clock() + budget, self._clock)
        with self._changed:
            turn.cancelled = self._closed
            self._queue.append(turn)
        try:
            self._wait(turn)
            yield turn
        except Stopped:
            raise turn.broken_off() from None
        finally:
            with self._changed:
                self._queue.remove(turn)
                self._changed.notify_all()

    def cancel(self, request_id: str) -> int:
        """Break off all that wait or run under ``request_id``; returns how many."""
        with self._changed:
            return self._cancel([turn for turn in self._queue if turn.request_id == request_id])

    def close(self) -> None:
        """Break off everything, and whatever still comes."""
        with self._changed:
            self._closed = True
            self._cancel(self._queue)

    def __len__(self) -> int:
        return len(self._queue)

    def _cancel(self, turns: Iterable[Turn]) -> int:
        going = [turn for turn in turns if not turn.cancelled]
        for turn in going:
            turn.cancelled = True
        self._changed.notify_all()
        return len(going)

    def _wait(self, turn: Turn) -> None:
        with self._changed:
            while self._queue[0] is not turn:
                if turn():
                    raise turn.broken_off(' while it waited for its turn')
                self._changed.wait(min(max(turn.time_left, 0.0), threading.TIMEOUT_MAX))
