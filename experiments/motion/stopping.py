"""How soon a search stops that is told to: the longest that it went on."""

from __future__ import annotations

from collections.abc import Sequence
from time import perf_counter
from typing import Any

import numpy as np

from experiments.motion.asking import planner_for, request_of
from experiments.motion.reference import Known
from experiments.motion.worlds import Place

#: Times [s] after which searches are told to stop.
DEADLINES = (0.0, 0.001, 0.003, 0.01, 0.03)


def measure(place: Place, known: Sequence[Known]) -> dict[str, Any]:
    """By how many milliseconds answers came later than the moment at which they were to stop."""
    planner = planner_for(place)
    late = []
    for number, one in enumerate(known):
        end = perf_counter() + DEADLINES[number % len(DEADLINES)]

        def is_over(end: float = end) -> bool:
            return perf_counter() >= end

        planner.satisfy(request_of(one), is_over)
        late.append(1e3 * max(perf_counter() - end, 0.0))
    return {
        'requests': len(late),
        'late_ms_p50': float(np.median(late)),
        'late_ms_p99': float(np.percentile(late, 99)),
        'late_ms_max': max(late),
    }
