"""Expected lengths of sequences of motions against trying all choices of places."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from task_planner_node.oracle import Advice, Place
from task_planner_node.search.lengths import Lengths

UNKNOWN = 'nowhere'


@dataclass
class World:
    """Places by number: the text that each belongs to, and what lies between; each text has a robot of its own."""

    robots: list[int]
    owners: list[int]
    first: list[float]
    between: list[list[float]]

    @property
    def texts(self) -> list[str]:
        return [f't{index}' for index in range(len(self.robots))]

    def advice(self) -> Advice:
        """The attitude of a place is its number."""
        places = tuple(Place(owner, number) for number, owner in enumerate(self.owners))
        rows = [self.first, *self.between]
        return Advice((), (), places=places, place_lengths=tuple(x for row in rows for x in row))

    def choices(self, text: str, narrow: frozenset[int]) -> list[int]:
        """The places of a text that count."""
        if text == UNKNOWN:
            return []
        index = self.texts.index(text)
        own = [number for number, owner in enumerate(self.owners) if owner == index]
        return own[:1] if index in narrow else own

    def length(self, visited: Sequence[int]) -> float:
        """What the robots drive to visit places one after the other."""
        last: dict[int, int] = {}
        total = 0.0
        for place in visited:
            robot = self.robots[self.owners[place]]
            if robot not in last:
                total += self.first[place]
            elif self.owners[last[robot]] == self.owners[place]:
                total += 0.0 if last[robot] == place else math.inf
            else:
                total += self.between[last[robot]][place]
            last[robot] = place
        return total

    def shortest(self, texts: Sequence[str], narrow: frozenset[int]) -> float:
        choices = [self.choices(text, narrow) for text in texts]
        return min(map(self.length, itertools.product(*filter(None, choices))))


@st.composite
def worlds(draw: st.DrawFn) -> World:
    """Up to three robots, texts that have no place or several, ways that are longer there than back."""
    robots = draw(st.lists(st.integers(0, 2), max_size=4))
    counts = [draw(st.integers(0, 3)) for _ in robots]
    numbers = [index for index, count in enumerate(counts) for _ in range(count)]
    owners = draw(st.permutations(numbers))
    count = len(owners)
    values = st.lists(st.integers(0, 20).map(float), min_size=count, max_size=count)
    between = [draw(values) for _ in owners]
    for one, other in itertools.product(range(count), repeat=2):
        mine, yours = owners[one], owners[other]
        if mine == yours or robots[mine] != robots[yours]:
            between[one][other] = math.inf
    return World(robots, list(owners), draw(values), between)


@settings(max_examples=300, deadline=None)
@given(worlds(), st.frozensets(st.integers(0, 3)), st.data())
def test_lengths_are_the_shortest_over_all_choices_of_places(
    world: World, narrow: frozenset[int], data: st.DataObject
) -> None:
    lengths = Lengths(world.texts, world.advice(), narrow)
    count = data.draw(st.integers(0, 5))
    texts = st.sampled_from([*world.texts, UNKNOWN])
    orders = data.draw(
        st.lists(st.lists(texts, min_size=count, max_size=count), min_size=1, max_size=4)
    )
    expected = [world.shortest(order, narrow) for order in orders]
    assert [lengths.expected(order) for order in orders] == expected
    numbered = np.array([lengths.numbered(order) for order in orders]).reshape(len(orders), count)
    assert lengths.of(numbered).tolist() == expected
