"""The problems as HDDL texts, in the manner of the total-order track of the planning competition of 2020."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from experiments.htn.problems import TABLE, Blocks, Logistics, Rovers, Satellites

FOLDER = Path(__file__).resolve().parent / 'hddl'

Problem = Blocks | Logistics | Rovers | Satellites


def domain_file(problem: Problem) -> Path:
    """The domain of a problem."""
    return FOLDER / f'{type(problem).__name__.lower()}.hddl'


def problem_text(problem: Problem) -> str:
    """``(define (problem random) ...)``; names are written with underscores."""
    if isinstance(problem, Blocks):
        parts = _blocks(problem)
    elif isinstance(problem, Logistics):
        parts = _logistics(problem)
    elif isinstance(problem, Rovers):
        parts = _rovers(problem)
    else:
        parts = _satellites(problem)
    objects, tasks, facts, goals = parts
    typed = [f'{" ".join(names)} - {kind}' for kind, names in objects.items() if names]
    text = '\n'.join(
        [
            f'(define (problem random) (:domain {type(problem).__name__.lower()})',
            f' (:objects {_lines(typed)})',
            f' (:htn :parameters () :ordered-subtasks (and {_lines(tasks)}))',
            f' (:init {_lines(facts)})',
            f' (:goal (and {_lines(goals)})))\n',
        ]
    )
    return text.replace('-', '_').replace(' _ ', ' - ').replace(':ordered_', ':ordered-')


def _lines(facts: Iterable[str]) -> str:
    return '\n  '.join(facts)


Parts = tuple[Mapping[str, list[str]], list[str], list[str], list[str]]


def _blocks(problem: Blocks) -> Parts:
    covered = set(problem.start.values())

    def standing(prefix: str, below: Mapping[str, str]) -> list[str]:
        return [
            f'({prefix}on_table {x})' if y == TABLE else f'({prefix}on {x} {y})'
            for x, y in below.items()
        ]

    facts = [*standing('', problem.start), *standing('goal_', problem.goal)]
    facts += [f'(clear {block})' for block in problem.start if block not in covered]
    return {'block': list(problem.start)}, ['(arrange)'], facts, standing('', problem.goal)


def _logistics(problem: Logistics) -> Parts:
    airports = [places[0] for places in problem.cities.values()]
    objects = {
        'city': list(problem.cities),
        'airport': airports,
        'place': [place for place in problem.city_of if place not in airports],
        'truck': list(problem.trucks),
        'plane': list(problem.planes),
        'package': list(problem.packages),
    }
    facts = [f'(in_city {place} {city})' for place, city in problem.city_of.items()]
    for truck, place in problem.trucks.items():
        facts += [f'(of_city {truck} {problem.city_of[place]})', f'(at {truck} {place})']
    facts += [f'(at {plane} {place})' for plane, place in problem.planes.items()]
    facts += [f'(lies {package} {start})' for package, (start, _) in problem.packages.items()]
    goals = [(package, goal) for package, (_, goal) in problem.packages.items()]
    tasks = [f'(deliver {package} {goal})' for package, goal in goals]
    return objects, tasks, facts, [f'(lies {package} {goal})' for package, goal in goals]


def _rovers(problem: Rovers) -> Parts:
    objects = {
        'rover': list(problem.rovers),
        'place': list(problem.ways),
        'camera': [rover.camera for rover in problem.rovers.values()],
        'objective': list(problem.seen_from),
        'mode': sorted({mode for rover in problem.rovers.values() for mode in rover.modes}),
    }
    facts = [f'(way {a} {b})' for a, others in problem.ways.items() for b in others]
    facts += [f'(lander_seen {place})' for place in problem.landers]
    for name, rover in problem.rovers.items():
        facts += [f'(at {name} {rover.place})', f'(on_board {rover.camera} {name})']
        facts += [f'(supports {rover.camera} {mode})' for mode in rover.modes]
        if rover.drill:
            facts += [f'(has_drill {name})', f'(empty {name})']
    facts += [f'(soil {place})' for place in problem.soil]
    facts += [f'(seen_from {o} {p})' for o, places in problem.seen_from.items() for p in places]
    tasks = [f'(get_sample {place})' for place in problem.samples]
    tasks += [f'(get_image {target} {mode})' for target, mode in problem.images]
    goals = [f'(sent_sample {place})' for place in problem.samples]
    goals += [f'(sent_image {target} {mode})' for target, mode in problem.images]
    return objects, tasks, facts, goals


def _satellites(problem: Satellites) -> Parts:
    modes = {mode for each in problem.instruments.values() for mode in each.modes}
    objects = {
        'satellite': list(problem.pointing),
        'instrument': list(problem.instruments),
        'direction': list(problem.directions),
        'mode': sorted(modes),
    }
    facts = []
    for name, instrument in problem.instruments.items():
        facts += [
            f'(on_board {name} {instrument.satellite})',
            f'(target {name} {instrument.target})',
        ]
        facts += [f'(supports {name} {mode})' for mode in instrument.modes]
    for satellite, direction in problem.pointing.items():
        facts += [f'(power {satellite})', f'(pointing {satellite} {direction})']
    tasks = [f'(photograph {direction} {mode})' for direction, mode in problem.images]
    return objects, tasks, facts, [f'(image {d} {mode})' for d, mode in problem.images]
