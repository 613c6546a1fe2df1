"""The constraint sets and their map, as data."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

FOLDER = Path(__file__).resolve().parent
WORLD = FOLDER / 'world.yaml'
#: The agent that moves in every set.
AGENT = 'rover0'


@dataclass(frozen=True)
class ConstraintSet:
    """Constraints in the language, and whether there is an attitude on the map that meets all."""

    name: str
    constraints: tuple[str, ...]
    feasible: bool
    agents: tuple[str, ...]
    objects: tuple[str, ...]
    regions: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """The set as a text of geometric preconditions."""
        statements = [f'(agent {label})' for label in self.agents]
        statements += [f'(object {label})' for label in self.objects]
        statements += [f'(region {label})' for label in self.regions]
        return '(' + '\n '.join([*statements, *(f'({text})' for text in self.constraints)]) + ')'


def read_map() -> Mapping[str, Any]:
    """What world.yaml says, as it stands there."""
    document: Mapping[str, Any] = yaml.safe_load(WORLD.read_text(encoding='utf-8'))
    return document


def read_sets() -> tuple[ConstraintSet, ...]:
    """All sets of sets.yaml, in their order."""
    document = yaml.safe_load((FOLDER / 'sets.yaml').read_text(encoding='utf-8'))
    world = read_map()
    return tuple(
        _constraint_set(name, constraints, kind == 'feasible', world)
        for kind in ('feasible', 'infeasible')
        for name, constraints in document[kind].items()
    )


def _constraint_set(
    name: str, constraints: Sequence[str], feasible: bool, world: Mapping[str, Any]
) -> ConstraintSet:
    used = {label for text in constraints for label in re.findall(r'[A-Za-z_]\w*', text)}
    others = [label for label in world['robots'] if label in used and label != AGENT]
    objects = [label for label in world['objects'] if label in used]
    regions = [region['name'] for region in world['regions'] if region['name'] in used]
    return ConstraintSet(
        name, tuple(constraints), feasible, (AGENT, *others), tuple(objects), tuple(regions)
    )
