"""What advice costs, whether its bounds hold, and how near its estimates come.

No motion that is known is shorter than a bound; estimates are those of the motions that the planner
finds when it is asked the same, so these are what they are compared with.
"""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from time import perf_counter
from typing import Any

import numpy as np

from experiments.motion.asking import planner_for, request_of
from experiments.motion.goals import AGENT
from experiments.motion.reference import Known
from experiments.motion.worlds import Place
from motion_planner_node.requests import AdviceRequest
from motion_planner_node.robots.motion import Attitude

CANDIDATES = 64
#: [m] by which a bound may be above a length, as lengths are kept with four digits.
ROUNDING = 1e-3


def measure(place: Place, known: Sequence[Known], rounds: int) -> dict[str, Any]:
    """Times [ms] of advice on 64 candidates from new starts; bounds and estimates beside lengths."""
    planner = planner_for(place)
    candidates = tuple(one.text for one in known[:CANDIDATES])
    times = []
    for one in known[: rounds + 1]:
        began = perf_counter()
        planner.advise(AdviceRequest(candidates, {AGENT: Attitude(*one.start)}, seed=1))
        times.append(1e3 * (perf_counter() - began))
    wrong, tightness, estimates = 0, [], []
    for one in known:
        answer = planner.advise(AdviceRequest((one.text,), {AGENT: Attitude(*one.start)}, seed=1))
        (advice,) = answer.candidates
        wrong += advice.impossible or advice.lower_bound > one.length + ROUNDING
        if one.length > 0.0:
            tightness.append(advice.lower_bound / one.length)
        length = planner.satisfy(request_of(one)).length
        if length > 0.0:
            estimates.append(advice.estimate / length)
    low, median, high = np.percentile(estimates, (5, 50, 95))
    return {
        'candidates': len(candidates),
        'first_ms': times[0],
        'ms_p50': statistics.median(times[1:]),
        'ms_max': max(times[1:]),
        'wrong_bounds': wrong,
        'bound_by_reference_p50': statistics.median(tightness),
        'estimates': len(estimates),
        'estimate_by_length_p5': float(low),
        'estimate_by_length_p50': float(median),
        'estimate_by_length_p95': float(high),
    }
