"""What the motion planner says of the requests that the reference searched exhaustively in vain.

A search at one grain that ends proves nothing: some of these requests can be met after all. So it is
told apart what the planner has a proof for, what it leaves open, and what it finds.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from experiments.motion.asking import Outcome, ask, times
from experiments.motion.grounds import lattice_of
from experiments.motion.reference import Known, Reference
from experiments.motion.requests import draw
from experiments.motion.worlds import Place
from motion_planner_node.codes import Code, Status


def drawn_again(place: Place, reference: Reference, count: int) -> list[Known]:
    """The first requests that were searched in vain, no length being known of any."""
    lattice = lattice_of(place)
    requests = [
        draw(place, lattice, reference.seed, number) for number in reference.unsolved[:count]
    ]
    return [
        Known(one.number, one.kind, tuple(one.start.tolist()), one.goal.text, math.inf)
        for one in requests
    ]


def measure(place: Place, reference: Reference, count: int) -> dict[str, Any]:
    """Ask what was searched in vain, each request once."""
    return summary(ask(place, drawn_again(place, reference, count), 1))


def summary(outcomes: Sequence[Outcome]) -> dict[str, Any]:
    """Shares of each verdict, and times [ms], in one world."""
    verdicts = [Code[outcome.code].status for outcome in outcomes]
    slowest = sorted(outcomes, key=lambda outcome: -outcome.milliseconds)[:5]
    return {
        'requests': len(outcomes),
        'impossible': verdicts.count(Status.IMPOSSIBLE) / len(outcomes),
        'unknown': verdicts.count(Status.UNKNOWN) / len(outcomes),
        'found': verdicts.count(Status.FOUND) / len(outcomes),
        'refused_motions': sum(len(outcome.faults) for outcome in outcomes),
        **times(outcomes),
        'open': [
            outcome.number
            for outcome, verdict in zip(outcomes, verdicts, strict=True)
            if verdict is Status.UNKNOWN
        ],
        'slowest': [
            {key: getattr(outcome, key) for key in ('number', 'kind', 'code', 'milliseconds')}
            for outcome in slowest
        ],
    }
