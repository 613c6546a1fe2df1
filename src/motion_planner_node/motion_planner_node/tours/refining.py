"""Move the attitudes of a tour, each within what its goal allows, while that shortens the way."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from motion_planner_node.paths.edges import Rows, edge_lengths
from motion_planner_node.paths.shortening import best_subsequence, nudge
from motion_planner_node.planning.ground import Ground
from motion_planner_node.stopping import ShouldStop, go_on
from motion_planner_node.tours.goals import Goal, fit
from motion_planner_node.tours.legs import Legs, lengths_over

#: Attitudes that are tried in place of each one in a sweep, at a spread that starts at so many
#: turning radii and shrinks with every sweep.
PROBES, SPREAD, SHRINKING = 24, 3.0, 0.65
#: Random moves of the attitudes between two goals in a sweep.
MOVES = 16
#: What a change has to gain [m].
GAIN = 1e-3


def refined(
    goals: Sequence[Goal],
    rows: Rows,
    legs: Legs,
    ground: Ground,
    sweeps: int,
    rng: np.random.Generator,
    should_stop: ShouldStop,
) -> Rows:
    """Attitudes (n + 1, 3) of a tour that starts as ``rows`` and meets ``goals`` (n) in order.

    The ways between them are bent along, so that obstacles do not hold the attitudes in their place.

    :raises Stopped: when ``should_stop`` said so
    """

    def check_time() -> None:
        go_on(should_stop)

    part = ground.parts_of(rows[:1])[0]
    ways = [legs.leg(a, b)[1].copy() for a, b in itertools.pairwise(rows)]
    reach = max(ground.robot.turning_radius, ground.robot.radius)
    for sweep in range(sweeps):
        spread = SPREAD * reach * SHRINKING**sweep
        for index, goal in enumerate(goals):
            go_on(should_stop)
            way, onward = ways[index], ways[index + 1] if index + 1 < len(ways) else None
            here = way[-1]
            scale = (spread, spread, min(spread / reach, 1.0))
            probes = here + rng.normal(size=(PROBES, 3)) * scale
            states = np.concatenate((here[None, :], fit(goal, ground, part, probes)))
            after = here if onward is None else onward[1]
            lengths = lengths_over(legs.frame, way[-2], states, after, onward is not None)
            best = int(np.argmin(lengths))
            if not lengths[best] < lengths[0] - GAIN:
                continue
            if not ground.can_turn_round(states[best : best + 1], check_time)[0]:
                continue
            way[-1] = states[best]
            if onward is not None:
                onward[0] = states[best]
        for index, way in enumerate(ways):
            if len(way) > 2:
                edges = edge_lengths(legs.frame, way)
                nudge(legs.frame, way, edges, spread, rng.uniform(-1.0, 1.0, (MOVES, 3)))
                along = np.concatenate(([0.0], np.cumsum(edges)))
                ways[index], _ = best_subsequence(legs.frame, way, along, check_time)
    return np.vstack((rows[:1], *(way[-1:] for way in ways)))
