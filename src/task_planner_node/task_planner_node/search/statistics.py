"""What a search did and where its time went."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(slots=True)
class Statistics:
    """The counters of geohtn_msgs/PlanningStatistics; times in seconds of wall clock.

    ``work`` are the goals of conditions that were tried, and the facts that were compared one by one.
    """

    requests: int = 0
    answers: int = 0
    found: int = 0
    impossible: int = 0
    unknown: int = 0
    advices: int = 0
    decompositions: int = 0
    backtracks: int = 0
    geometric_backtracks: int = 0
    improvements: int = 0
    opportunities: int = 0
    work: int = 0
    planning_time: float = 0.0
    request_time: float = 0.0
    transport_time: float = 0.0

    @property
    def search_time(self) -> float:
        """What is left for the task planner itself [s]."""
        return max(0.0, self.planning_time - self.request_time - self.transport_time)

    def exchanged(self, round_trip: float, inside: float) -> None:
        """Count one exchange: ``inside`` [s] of ``round_trip`` [s] were spent in the motion planner."""
        inside = min(max(inside, 0.0), round_trip)
        self.request_time += inside
        self.transport_time += round_trip - inside
