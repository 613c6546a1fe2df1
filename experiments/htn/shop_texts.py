"""The problems as SHOP texts for the domains in src/task_planner_node/domains."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from experiments.htn.problems import TABLE, Blocks, Logistics, Rovers, Satellites

ROOT = Path(__file__).resolve().parent.parent.parent
DOMAINS = ROOT / 'src' / 'task_planner_node' / 'domains'
OWN = Path(__file__).resolve().parent / 'shop'

Problem = Blocks | Logistics | Rovers | Satellites


def domain_text(problem: Problem) -> str:
    """The domain of a problem."""
    name = type(problem).__name__.lower()
    own = OWN / f'{name}.lisp'
    path = own if own.exists() else DOMAINS / name / 'domain.lisp'
    return path.read_text(encoding='utf-8')


def problem_text(problem: Problem) -> str:
    """``(defproblem random domain facts tasks)``."""
    if isinstance(problem, Blocks):
        facts, tasks = _blocks(problem), '(arrange)'
    elif isinstance(problem, Logistics):
        deliveries = [f'(deliver {x} {goal})' for x, (_, goal) in problem.packages.items()]
        facts, tasks = _logistics(problem), '\n'.join(deliveries)
    elif isinstance(problem, Rovers):
        facts, tasks = _rovers(problem), '(investigate)'
    else:
        facts, tasks = _satellites(problem), '(observe)'
    name = type(problem).__name__.lower()
    return f'(defproblem random {name}\n ({_lines(facts)})\n ({tasks}))\n'


def _lines(facts: Iterable[str]) -> str:
    return '\n  '.join(facts)


def _blocks(problem: Blocks) -> list[str]:
    covered = set(problem.start.values())
    facts = [
        f'(on-table {block})' if below == TABLE else f'(on {block} {below})'
        for block, below in problem.start.items()
    ]
    facts += [f'(clear {block})' for block in problem.start if block not in covered]
    return facts + [
        f'(goal-on-table {block})' if below == TABLE else f'(goal-on {block} {below})'
        for block, below in problem.goal.items()
    ]


def _logistics(problem: Logistics) -> list[str]:
    facts = [f'(place {place} {city})' for place, city in problem.city_of.items()]
    facts += [f'(airport {places[0]})' for places in problem.cities.values()]
    for truck, place in problem.trucks.items():
        facts += [f'(truck {truck} {problem.city_of[place]})', f'(at {truck} {place})']
    for plane, place in problem.planes.items():
        facts += [f'(plane {plane})', f'(at {plane} {place})']
    return facts + [f'(at {package} {start})' for package, (start, _) in problem.packages.items()]


def _rovers(problem: Rovers) -> list[str]:
    facts = [f'(way {a} {b})' for a, others in problem.ways.items() for b in others]
    facts += [f'(route {place} {place} 0 {place})' for place in problem.ways]
    for (start, goal), (count, first) in problem.routes.items():
        facts.append(f'(route {start} {goal} {count} {first})')
    facts += [f'(base {place} {lander})' for place, lander in problem.bases.items()]
    facts += [f'(lander-visible {place})' for place in problem.landers]
    for name, rover in problem.rovers.items():
        facts += [f'(at {name} {rover.place})', f'(camera {rover.camera} {name})']
        facts += [f'(supports {rover.camera} {mode})' for mode in rover.modes]
        if rover.drill:
            facts += [f'(has-drill {name})', f'(store-empty {name})']
    facts += [f'(soil {place})' for place in problem.soil]
    facts += [
        f'(visible {o} {place})' for o, places in problem.seen_from.items() for place in places
    ]
    facts += [f'(wanted (soil-of {place}))' for place in problem.samples]
    return facts + [f'(wanted (image-of {target} {mode}))' for target, mode in problem.images]


def _satellites(problem: Satellites) -> list[str]:
    facts = []
    for name, instrument in problem.instruments.items():
        facts += [
            f'(on-board {name} {instrument.satellite})',
            f'(target {name} {instrument.target})',
        ]
        facts += [f'(supports {name} {mode})' for mode in instrument.modes]
    for satellite, direction in problem.pointing.items():
        facts += [f'(power {satellite})', f'(pointing {satellite} {direction})']
    return facts + [f'(wanted {direction} {mode})' for direction, mode in problem.images]
