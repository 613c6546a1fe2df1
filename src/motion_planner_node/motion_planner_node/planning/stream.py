"""The motions that answer one request, worked out as far as they were asked for."""

from __future__ import annotations

from collections.abc import Iterator

from motion_planner_node.planning.proofs import Impossible
from motion_planner_node.planning.tried import Tried
from motion_planner_node.planning.ways import Found, Ways
from motion_planner_node.stopping import ShouldStop


class Stream:
    """Motions to really different destinations, kept for those who ask for them again.

    What comes k-th depends on what is asked alone: not on who asked before, nor on time.  Streams
    refer to what they are made of and never the other way round, so that those which are forgotten
    are gone at once.

    Attributes:
        proof: why no motion can exist, where that is known
    """

    def __init__(self, ways: Ways) -> None:
        self._ways = ways
        self._restart()

    def _restart(self) -> None:
        self._ways.forget()
        self._more: Iterator[Found] = self._ways.motions()
        self._found: list[Found] = []
        self.proof: Impossible | None = None
        self._has_sought_proof = False
        self._broken = False

    @property
    def tried(self) -> Tried:
        """What was looked at in vain since the last motion was found."""
        return self._ways.tried

    def find(self, alternative: int, should_stop: ShouldStop) -> Found | None:
        """Return the motion number ``alternative``, or None when there are not so many.

        Then ``tried`` says what was looked at in vain, and ``proof``, where there is one, why no
        motion can exist.

        :raises Stopped: when ``should_stop`` said so; the next call starts over
        """
        if self._broken:
            self._restart()
        self._broken = True
        with self._ways.broken_off_by(should_stop):
            while len(self._found) <= alternative:
                found = next(self._more, None)
                if found is None:
                    break
                self._found.append(found)
            if not self._found and not self._has_sought_proof:
                self.proof, self._has_sought_proof = self._ways.proof(), True
        self._broken = False
        return self._found[alternative] if alternative < len(self._found) else None
