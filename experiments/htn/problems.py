"""Random planning problems as plain data: each is written out for every planner of the comparison.

The same numbers and the same seed give the same problem.  Every problem has a plan.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from random import Random

TABLE = 'table'


@dataclass(frozen=True)
class Blocks:
    """What each block stands on at first, and what it shall stand on: another one or TABLE."""

    start: Mapping[str, str]
    goal: Mapping[str, str]


def blocks(count: int, seed: int) -> Blocks:
    """Two random arrangements of ``count`` blocks; a block starts a new tower once in four times."""
    random = Random(seed)
    names = [f'b{number}' for number in range(1, count + 1)]

    def towers() -> dict[str, str]:
        order = random.sample(names, count)
        below = {order[0]: TABLE}
        for under, block in pairwise(order):
            below[block] = TABLE if random.random() < 0.25 else under
        return {name: below[name] for name in names}

    return Blocks(towers(), towers())


@dataclass(frozen=True)
class Logistics:
    """Cities with places, the first of each an airport; ``packages`` have a start and a goal."""

    cities: Mapping[str, Sequence[str]]
    trucks: Mapping[str, str]
    planes: Mapping[str, str]
    packages: Mapping[str, tuple[str, str]]

    @property
    def city_of(self) -> Mapping[str, str]:
        """The city of each place."""
        return {place: city for city, places in self.cities.items() for place in places}


def logistics(packages: int, seed: int, cities: int = 10, places: int = 4) -> Logistics:
    """One truck a city, one plane for five cities, packages anywhere."""
    random = Random(seed)
    of = {f'c{i}': [f'c{i}-p{j}' for j in range(places)] for i in range(cities)}
    everywhere = [place for city in of.values() for place in city]
    return Logistics(
        of,
        {f't{i}': random.choice(of[f'c{i}']) for i in range(cities)},
        {f'a{i}': random.choice(list(of.values()))[0] for i in range(max(1, cities // 5))},
        {
            f'x{i}': (start, goal)
            for i in range(packages)
            for start, goal in [random.sample(everywhere, 2)]
        },
    )


@dataclass(frozen=True)
class Rover:
    """Where a rover is at first and what it carries; ``camera`` supports the modes."""

    place: str
    drill: bool
    camera: str
    modes: Sequence[str]


@dataclass(frozen=True)
class Rovers:
    """Places joined by ways; results that are wanted are samples of places and images of objectives."""

    ways: Mapping[str, Sequence[str]]
    landers: Sequence[str]
    rovers: Mapping[str, Rover]
    soil: Sequence[str]
    seen_from: Mapping[str, Sequence[str]]
    samples: Sequence[str]
    images: Sequence[tuple[str, str]]

    @property
    def routes(self) -> Mapping[tuple[str, str], tuple[int, str]]:
        """How many moves every place is away from every other, and the first place on the way there."""
        found: dict[tuple[str, str], tuple[int, str]] = {}
        for goal in self.ways:
            away = {goal: 0}
            agenda = deque([goal])
            while agenda:
                here = agenda.popleft()
                for place in self.ways[here]:
                    if place not in away:
                        away[place] = away[here] + 1
                        found[place, goal] = (away[place], here)
                        agenda.append(place)
        return found

    @property
    def bases(self) -> Mapping[str, str]:
        """The nearest place with a lander in sight, for every place."""
        routes = self.routes
        return {
            place: min(self.landers, key=lambda lander: routes.get((place, lander), (0, ''))[0])
            for place in self.ways
        }


MODES = ('colour', 'infrared', 'detail')


def rovers(objectives: int, seed: int, vehicles: int = 4) -> Rovers:
    """As many places as objectives up to 30; a third of the objectives are soil samples, the rest images."""
    random = Random(seed)
    places = [f'p{i}' for i in range(min(30, max(4, objectives)))]
    ways: dict[str, list[str]] = {place: [] for place in places}
    for number, place in enumerate(places[1:], 1):
        _join(ways, place, random.choice(places[max(0, number - 4) : number]))
    for _ in places:
        one, other = random.sample(places, 2)
        _join(ways, one, other)
    fleet = {
        f'r{i}': Rover(
            random.choice(places),
            i % 2 == 0,
            f'cam{i}',
            MODES if i == 1 else random.sample(MODES, 2),
        )
        for i in range(vehicles)
    }
    samples = random.sample(places, min(len(places), objectives // 3))
    targets = [f'o{i}' for i in range(objectives - len(samples))]
    return Rovers(
        ways,
        random.sample(places, 2),
        fleet,
        samples,
        {target: random.sample(places, 3) for target in targets},
        samples,
        [(target, random.choice(MODES)) for target in targets],
    )


def _join(ways: Mapping[str, list[str]], one: str, other: str) -> None:
    if other not in ways[one]:
        ways[one].append(other)
        ways[other].append(one)


@dataclass(frozen=True)
class Instrument:
    """On which satellite an instrument is, what it can do, and where it is calibrated."""

    satellite: str
    modes: Sequence[str]
    target: str


@dataclass(frozen=True)
class Satellites:
    """``pointing`` is where each satellite looks at first; images are of a direction in a mode."""

    pointing: Mapping[str, str]
    instruments: Mapping[str, Instrument]
    directions: Sequence[str]
    images: Sequence[tuple[str, str]]


def satellites(images: int, seed: int, vehicles: int = 5) -> Satellites:
    """Two instruments a satellite with two modes each; every mode is on board of the first satellite."""
    random = Random(seed)
    directions = [f'd{i}' for i in range(max(4, images // 2))]
    modes = [f'm{i}' for i in range(4)]
    instruments = {
        f'i{i}-{j}': Instrument(
            f's{i}',
            modes[2 * j : 2 * j + 2] if i == 0 else random.sample(modes, 2),
            random.choice(directions),
        )
        for i in range(vehicles)
        for j in range(2)
    }
    wanted = [(direction, mode) for direction in directions for mode in modes]
    return Satellites(
        {f's{i}': random.choice(directions) for i in range(vehicles)},
        instruments,
        directions,
        random.sample(wanted, images),
    )
