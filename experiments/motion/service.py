"""What requests cost through the service of a node, beside the time that the node spends on them."""

from __future__ import annotations

from collections.abc import Sequence
from time import perf_counter
from typing import Any

import numpy as np
from geohtn_msgs import msg, srv

from experiments.exchange import client, motion_planner, own_namespace
from experiments.motion.goals import AGENT
from experiments.motion.reference import Known
from experiments.motion.worlds import Place

#: Exchanges before the measurement begins.
WARM_UP = 10


class Exchanges:
    """The same requests in several rounds, each asked of a node that has just been started."""

    def __init__(self, place: Place, known: Sequence[Known]) -> None:
        self._place = place
        self._known = known
        #: Times [ms] of each request as the client and as the node see them, and how many were not found.
        self._rounds: list[tuple[list[float], list[float], int]] = []

    def __len__(self) -> int:
        return len(self._rounds)

    def ask(self) -> None:
        """Ask all once more."""
        self._rounds.append(_ask(self._place, self._known))

    def figures(self) -> dict[str, Any]:
        """Times [ms] of all rounds, of which there is one at least.

        Of the times of a request the least counts, as others use the machine, too; the medians of single rounds
        within the node are told beside it.
        """
        outside, inside, lost = (np.array(each) for each in zip(*self._rounds, strict=True))
        each = np.median(inside, axis=1)
        more = (outside - inside).min(axis=0)
        outside, inside = outside.min(axis=0), inside.min(axis=0)
        return {
            'requests': len(self._known),
            'rounds': len(self),
            'not_found': int(lost.sum()),
            'node_ms_p50': float(np.median(inside)),
            'node_ms_p95': float(np.percentile(inside, 95)),
            'fastest_round_node_ms_p50': float(each.min()),
            'slowest_round_node_ms_p50': float(each.max()),
            'client_ms_p50': float(np.median(outside)),
            'client_ms_p95': float(np.percentile(outside, 95)),
            'more_ms_p50': float(np.median(more)),
            'more_ms_p95': float(np.percentile(more, 95)),
        }


def _ask(place: Place, known: Sequence[Known]) -> tuple[list[float], list[float], int]:
    """The times of each request [ms] as the client and as a new node see them, and how many were not found."""
    namespace = own_namespace('motion')
    outside: list[float] = []
    inside: list[float] = []
    lost = 0
    with (
        motion_planner(namespace, place.write()),
        client(namespace, {srv.SatisfyPreconditions: 'satisfy_preconditions'}) as exchange,
    ):
        for number, one in enumerate([*known[:WARM_UP], *known]):
            x, y, heading = one.start
            request = srv.SatisfyPreconditions.Request(
                request=msg.GeometricRequest(
                    preconditions=one.text,
                    agent=AGENT,
                    start=[msg.AgentState(agent=AGENT, x=x, y=y, heading=heading)],
                    # Another seed where a request comes a second time: nothing is remembered.
                    seed=one.number + (number < WARM_UP) * 1_000_000,
                )
            )
            began = perf_counter()
            answer = exchange(srv.SatisfyPreconditions, request).answer
            took = 1e3 * (perf_counter() - began)
            if number >= WARM_UP:
                outside.append(took)
                inside.append(1e3 * answer.time_spent)
                lost += answer.status != msg.GeometricAnswer.FOUND
    return outside, inside, lost
