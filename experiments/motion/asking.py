"""Ask the motion planner what the reference was asked, and judge what it says."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from time import perf_counter
from typing import Any

import numpy as np

from experiments.motion.checking import Checker, Told
from experiments.motion.goals import AGENT
from experiments.motion.reference import Known
from experiments.motion.worlds import Place
from motion_planner_node.parameters import Parameters
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import GeometricAnswer, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world import read_world

#: Requests with another seed before the measurement, after which nothing is left to compile.
WARM_UP = 3


@dataclass(frozen=True)
class Outcome:
    """What became of one request; ``faults`` are those of all its motions."""

    number: int
    kind: str
    reference: float
    length: float | None
    milliseconds: float
    code: str
    message: str
    motions: int
    faults: tuple[str, ...]

    @property
    def ratio(self) -> float:
        """Length by the reference's; 1 where both stay."""
        assert self.length is not None
        return self.length / self.reference if self.reference > 0.0 else 1.0


def planner_for(place: Place, parameters: Parameters | None = None) -> MotionPlanner:
    """A motion planner that has been told the world."""
    planner = MotionPlanner(read_world(place.text, str(place.write())), parameters)
    planner.prepare()
    return planner


def request_of(known: Known, alternative: int = 0, planner: str = '') -> GeometricRequest:
    """A request of the reference as the motion planner is asked it."""
    return GeometricRequest(
        known.text,
        {AGENT: Attitude(*known.start)},
        alternative=alternative,
        seed=known.number,
        planner=planner,
    )


def ask(place: Place, known: Sequence[Known], alternatives: int) -> list[Outcome]:
    """Ask each request, and for so many ``alternatives`` in all; only the first answer's time counts."""
    planner, checker = planner_for(place), Checker(place)
    for one in known[:WARM_UP]:
        planner.satisfy(replace(request_of(one), seed=one.number + 1_000_000))
    return [_ask(planner, checker, one, alternatives) for one in known]


def _ask(planner: MotionPlanner, checker: Checker, known: Known, alternatives: int) -> Outcome:
    began = perf_counter()
    first = planner.satisfy(request_of(known))
    seconds = perf_counter() - began
    answers = [first]
    answers += [planner.satisfy(request_of(known, k)) for k in range(1, alternatives)]
    faults = [fault for answer in answers for fault in _faults(checker, known, answer)]
    return Outcome(
        number=known.number,
        kind=known.kind,
        reference=known.length,
        length=first.motion.length if first.motion else None,
        milliseconds=1e3 * seconds,
        code=first.code.name,
        message='' if first.motion else first.message,
        motions=sum(answer.motion is not None for answer in answers),
        faults=tuple(faults),
    )


def _faults(checker: Checker, known: Known, answer: GeometricAnswer) -> list[str]:
    if answer.motion is None:
        return []
    end, told = answer.end[AGENT], Told.by(answer)
    return list(checker.faults(known.text, known.start, answer.motion, end, told))


def times(outcomes: Sequence[Outcome]) -> dict[str, float]:
    """How long [ms] answers took."""
    taken = np.array([outcome.milliseconds for outcome in outcomes])
    return {
        'ms_p50': float(np.median(taken)),
        'ms_p95': float(np.percentile(taken, 95)),
        'ms_max': float(taken.max()),
    }


def summary(outcomes: Sequence[Outcome]) -> dict[str, Any]:
    """Figures of one world."""
    found = [outcome for outcome in outcomes if outcome.length is not None]
    ratios = np.array([outcome.ratio for outcome in found])
    longest = sorted(found, key=lambda outcome: -outcome.ratio)[:5]
    return {
        'requests': len(outcomes),
        'success': len(found) / len(outcomes),
        'motions': sum(outcome.motions for outcome in outcomes),
        'refused_motions': sum(len(outcome.faults) for outcome in outcomes),
        'ratio_p50': float(np.median(ratios)),
        'ratio_p95': float(np.percentile(ratios, 95)),
        'ratio_max': float(ratios.max()),
        'shorter_than_reference': float(np.mean(ratios < 0.999)),
        **times(outcomes),
        'failed': [asdict(outcome) for outcome in outcomes if outcome.length is None],
        'faulty': [asdict(outcome) for outcome in outcomes if outcome.faults],
        'longest': [asdict(outcome) for outcome in longest],
    }
