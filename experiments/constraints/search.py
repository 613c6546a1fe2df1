"""How reliably the motion planner solves the sets, from random starts."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from experiments.constraints.judge import Judge
from experiments.constraints.sets import AGENT, WORLD, ConstraintSet, read_map
from motion_planner_node.language import parse
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.satisfaction import Program, compile_program, descend
from motion_planner_node.world import read_world
from motion_planner_node.world.model import World

#: Starts that are solved together.
BATCH = 64
#: Violation [m or rad] of an attitude that was handed out as a solution, at most.
TOLERANCE = 2e-9


@dataclass(frozen=True)
class Outcome:
    """What became of one set.

    ``solved`` counts starts that led to an attitude that the judge agrees with, ``wrong`` those that
    led to one that it does not; ``batches`` counts batches of starts with at least one that is right.
    """

    name: str
    feasible: bool
    starts: int
    solved: int
    wrong: int
    batches: int
    batches_solved: int
    worst_violation: float
    steps: float
    proof_by: str
    proof: str

    def as_figures(self) -> dict[str, Any]:
        """All of it, for results.json."""
        return asdict(self)


class Bench:
    """The map of the sets, as the motion planner and the judge see it."""

    def __init__(self) -> None:
        self.world: World = read_world(WORLD.read_text(encoding='utf-8'), WORLD.name)
        self.judge = Judge(read_map(), AGENT)

    def program(self, constraints: ConstraintSet) -> Program:
        """The set as the motion planner compiles it."""
        state = {label: robot.start for label, robot in self.world.robots.items() if robot.start}
        state[AGENT] = Attitude(0.0, 0.0, 0.0)
        return compile_program(parse(constraints.text), self.world, state, AGENT)

    def starts(self, seed: int, count: int) -> NDArray[np.float64]:
        """Attitudes (n, 3) anywhere on the map."""
        bounds = self.world.bounds
        low = np.array([bounds.x_min, bounds.y_min, -np.pi])
        high = np.array([bounds.x_max, bounds.y_max, np.pi])
        return np.random.default_rng(seed).uniform(low, high, (count, 3))

    def proof(self, program: Program) -> tuple[str, str]:
        """By which method the motion planner proves that there is no solution, and its words."""
        sentence = program.contradiction(self.world.bounds)
        if sentence is None:
            return '', ''
        _, _, by = sentence.rstrip(')').rpartition('(proven by ')
        return 'the text alone' if program.contradictions else by, sentence

    def on_map(self, states: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which attitudes (n, 3) are where a destination may be: only those are handed out."""
        bounds, x, y = self.world.bounds, states[:, 0], states[:, 1]
        inside = (bounds.x_min <= x) & (x <= bounds.x_max)
        return np.asarray(inside & (bounds.y_min <= y) & (y <= bounds.y_max))

    def solve(self, constraints: ConstraintSet, starts: NDArray[np.float64]) -> Outcome:
        """Try ``starts`` (n, 3) in batches, and ask for a proof that there is no solution."""
        program = self.program(constraints)
        solved = wrong = batches_solved = 0
        steps: list[int] = []
        worst = 0.0
        batches = [starts[at : at + BATCH] for at in range(0, len(starts), BATCH)]
        for batch in batches:
            descent = descend(program, batch)
            found = descent.satisfied & self.on_map(descent.states)
            violations = [
                self.judge.violation(constraints, (float(x), float(y), float(heading)))
                for x, y, heading in descent.states[found]
            ]
            right = sum(violation <= TOLERANCE for violation in violations)
            solved += right
            wrong += len(violations) - right
            batches_solved += right > 0
            worst = max([worst, *violations])
            steps += descent.iterations[found].tolist()
        by, proof = self.proof(program)
        return Outcome(
            name=constraints.name,
            feasible=constraints.feasible,
            starts=len(starts),
            solved=solved,
            wrong=wrong,
            batches=len(batches),
            batches_solved=batches_solved,
            worst_violation=worst,
            steps=float(np.median(steps)) if steps else 0.0,
            proof_by=by,
            proof=proof,
        )
