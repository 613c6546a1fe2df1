"""What the trials show: time per added goal, work, and lengths beside the hybrid's."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from experiments.paper.methods.trials import Trial

#: The paper's 50 s against 4 s for an added goal.
SLOPE_RATIO = 12.0


class Spread(NamedTuple):
    """Quartiles and extremes of some figures; all NaN without any."""

    least: float
    lower: float
    median: float
    upper: float
    greatest: float

    def shown(self, digits: int, factor: float = 1.0) -> str:
        """Median, and the quartiles in brackets; empty without figures."""
        if np.isnan(self.median):
            return ''
        lower, median, upper = (
            f'{factor * value:.{digits}f}' for value in (self.lower, self.median, self.upper)
        )
        return f'{median} ({lower} to {upper})'


def spread(values: Iterable[float]) -> Spread:
    """The spread of what is a number."""
    known = [value for value in values if np.isfinite(value)]
    quantiles = np.quantile(known, [0.0, 0.25, 0.5, 0.75, 1.0]) if known else [np.nan] * 5
    return Spread(*(float(value) for value in quantiles))


def by_size(trials: Iterable[Trial]) -> dict[int, list[Trial]]:
    """Trials by their number of goals."""
    groups: dict[int, list[Trial]] = defaultdict(list)
    for trial in trials:
        groups[trial.goals].append(trial)
    return dict(sorted(groups.items()))


def slopes(trials: Sequence[Trial]) -> dict[int, float]:
    """Processor time per added goal [s] of each series of sets, by a straight line through its trials.

    Trials without a plan are left out, which favours the method that gave them up.
    """
    series: dict[int, list[Trial]] = defaultdict(list)
    for trial in trials:
        if trial.solved:
            series[trial.number].append(trial)
    found = {}
    for number, members in series.items():
        goals = np.array([trial.goals for trial in members], float)
        if len(set(goals)) > 1:
            found[number] = float(np.polyfit(goals, [t.seconds for t in members], 1)[0])
    return found


@dataclass(frozen=True)
class Comparison:
    """A method beside the hybrid with the same matching, on the same sets of goals.

    slope: processor time per added goal [s]
    work_per_goal: goals tried and facts compared
    steps_per_goal: tasks decomposed and actions applied
    slope_ratio, work_ratio: by the hybrid's, set by set
    length_ratios: by the hybrid's, set by set, by the number of goals
    endings: how many searches ended without a plan, by outcome and reason
    """

    graph: str
    method: str
    trials: int
    unsolved: int
    slope: Spread
    work_per_goal: Spread
    steps_per_goal: Spread
    slope_ratio: Spread
    work_ratio: Spread
    length_ratios: Mapping[int, Spread]
    hybrid_shorter: int
    compared: int
    endings: Mapping[str, int]

    @property
    def sizes_with_hybrid_shorter(self) -> int:
        """Numbers of goals for which the median of the ratios is greater than 1."""
        return sum(ratio.median > 1.0 + 1e-9 for ratio in self.length_ratios.values())

    def figures(self) -> dict[str, object]:
        """For results.json and tables, all sizes together."""
        return {
            'graph': self.graph,
            'method': self.method,
            'trials': self.trials,
            'unsolved': self.unsolved,
            'seconds_per_goal': self.slope._asdict(),
            'work_per_goal': self.work_per_goal._asdict(),
            'steps_per_goal': self.steps_per_goal._asdict(),
            'seconds_by_hybrid': self.slope_ratio._asdict(),
            'work_by_hybrid': self.work_ratio._asdict(),
            'sets_with_hybrid_shorter': self.hybrid_shorter,
            'sets_compared': self.compared,
        }

    def lengths(self) -> list[dict[str, object]]:
        """Lengths by the hybrid's for results.json and tables, size by size."""
        return [
            {'graph': self.graph, 'method': self.method, 'goals': goals, 'ratio': ratio._asdict()}
            for goals, ratio in self.length_ratios.items()
        ]


def compare(trials: Sequence[Trial], hybrid: Sequence[Trial]) -> Comparison:
    """One method's trials beside the hybrid's."""
    own, others = slopes(trials), slopes(hybrid)
    twin = {(trial.goals, trial.number): trial for trial in hybrid}
    pairs = [(t, twin[t.goals, t.number]) for t in trials if t.solved]
    ratios = {
        goals: spread(t.length / twin[t.goals, t.number].length for t in members if t.solved)
        for goals, members in by_size(trials).items()
    }
    return Comparison(
        trials[0].graph,
        trials[0].method,
        len(trials),
        sum(not trial.solved for trial in trials),
        spread(own.values()),
        spread(trial.work / trial.goals for trial in trials if trial.solved),
        spread(trial.decompositions / trial.goals for trial in trials if trial.solved),
        spread(own[number] / others[number] for number in own),
        spread(t.work / other.work for t, other in pairs),
        ratios,
        sum(t.length > (1.0 + 1e-9) * other.length for t, other in pairs),
        len(pairs),
        Counter(f'{trial.outcome}: {trial.reason}' for trial in trials if not trial.solved),
    )
