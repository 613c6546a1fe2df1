"""The same problems for the task planner and its peers, and how they did."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from experiments.htn import aries_peer, hddl_texts, ours, problems, shop_texts
from experiments.htn.gtpyhop_peer import Peer
from experiments.htn.shop_texts import Problem
from experiments.htn.validation import fault_of

#: A walk of so many steps.
LONG = 100_000
WALK = """(defdomain walk (
 (:operator (!step ?n) () () ())
 (:method (walk ?n) ((call > ?n 0)) ((!step ?n) (walk (call - ?n 1))) () ())))"""


@dataclass(frozen=True)
class Speed:
    """One problem: plan lengths, decompositions a second, and processor times [s].

    ``fault`` and ``peer_fault`` say why a plan does not reach the goal by GTPyhop's actions; empty when it does.
    """

    name: str
    actions: int
    decompositions: int
    reading: float
    searching: float
    peer_strategy: str
    peer_actions: int
    peer_nodes: int
    peer_searching: float
    fault: str
    peer_fault: str

    @property
    def rate(self) -> float:
        """Decompositions per second of search."""
        return self.decompositions / self.searching

    @property
    def peer_rate(self) -> float:
        """Actions and methods tried per second by GTPyhop."""
        return self.peer_nodes / self.peer_searching

    @property
    def times_faster(self) -> float:
        """GTPyhop's time over that of the search."""
        return self.peer_searching / self.searching

    def as_figures(self) -> dict[str, Any]:
        """For results.json."""
        rates = {'rate': self.rate, 'peer_rate': self.peer_rate, 'times_faster': self.times_faster}
        return {**asdict(self), **rates}


def large_problems(seed: int) -> Mapping[str, Problem]:
    """The problems of which the speed is measured."""
    return {
        'blocks 300': problems.blocks(300, seed),
        'logistics 60': problems.logistics(60, seed),
        'rovers 20': problems.rovers(20, seed),
        'rovers 100': problems.rovers(100, seed),
        'satellites 60': problems.satellites(60, seed),
    }


def small_problems(seed: int) -> Mapping[str, Problem]:
    """The problems for Aries and unified-planning's simulator, in HDDL."""
    return {
        'blocks 3': problems.blocks(3, seed),
        'blocks 30': problems.blocks(30, seed),
        'logistics 3': problems.logistics(3, seed, cities=3, places=2),
        'logistics 20': problems.logistics(20, seed),
        'rovers 3': problems.rovers(3, seed, vehicles=2),
        'rovers 12': problems.rovers(12, seed),
        'satellites 3': problems.satellites(3, seed, vehicles=1),
        'satellites 20': problems.satellites(20, seed),
    }


def speed(name: str, problem: Problem, repetitions: int) -> Speed:
    """Plan with both, the fastest of so many searches each."""
    peer = Peer(problem)
    own = ours.best_of(
        repetitions, shop_texts.domain_text(problem), shop_texts.problem_text(problem)
    )
    other = peer.plan(max(1, repetitions // 2))
    plan = [step.action for step in own.result.steps]
    return Speed(
        name,
        len(plan),
        own.decompositions,
        own.reading,
        own.searching,
        other.strategy,
        len(other.plan),
        other.nodes,
        other.seconds,
        peer.fault_of(plan) if ours.solved(own) else own.result.explanation,
        peer.fault_of(other.plan),
    )


def block_lengths(count: int, seeds: Sequence[int]) -> list[tuple[int, int]]:
    """Our plan length and GTPyhop's for blocks problems with these seeds."""
    found = []
    for seed in seeds:
        problem = problems.blocks(count, seed)
        own = ours.plan(shop_texts.domain_text(problem), shop_texts.problem_text(problem))
        found.append((len(own.result.steps), len(Peer(problem).plan(1).plan)))
    return found


@dataclass(frozen=True)
class Hddl:
    """One HDDL problem: actions, time [s] of reading and searching, the simulator's verdict, and Aries."""

    name: str
    actions: int
    seconds: float
    fault: str
    peer: aries_peer.Run | None

    def as_figures(self) -> dict[str, Any]:
        """For results.json."""
        return asdict(self)


def hddl(name: str, problem: Problem, budget: float) -> Hddl:
    """Plan, let unified-planning judge the plan, and ask Aries, at most ``budget`` [s], if that is not 0."""
    domain = hddl_texts.domain_file(problem)
    text = hddl_texts.problem_text(problem)
    own = ours.plan(domain.read_text(encoding='utf-8'), text)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / 'problem.hddl'
        file.write_text(text, encoding='utf-8')
        steps = [step.action for step in own.result.steps]
        fault = fault_of(domain, file, steps) if ours.solved(own) else own.result.explanation
        peer = aries_peer.plan(domain, file, budget) if budget else None
    return Hddl(name, len(steps), own.reading + own.searching, fault, peer)


def long_plan(length: int) -> ours.Run:
    """A plan of ``length`` steps."""
    return ours.plan(WALK, f'(defproblem far walk () ((walk {length})))')
