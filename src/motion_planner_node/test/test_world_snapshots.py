"""A world is a snapshot: nothing that can be reached from it can be changed."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from motion_planner_node.world import read_world
from motion_planner_node.world.revision import revision_of

MISSIONS = Path(__file__).resolve().parents[2] / 'interface_node' / 'missions'


def parts_of(thing: object, path: str = 'world') -> Iterator[tuple[str, object]]:
    """Everything that a world consists of, with the way to it; arrays that it hands out as well."""
    yield path, thing
    if dataclasses.is_dataclass(thing):
        names = [field.name for field in dataclasses.fields(thing)]
        names += ['occupied'] if hasattr(type(thing), 'occupied') else []
        for name in names:
            yield from parts_of(getattr(thing, name), f'{path}.{name}')
    elif isinstance(thing, tuple):
        for number, item in enumerate(thing):
            yield from parts_of(item, f'{path}[{number}]')
    elif hasattr(thing, 'items'):
        for key, item in thing.items():
            yield from parts_of(item, f'{path}[{key}]')


@pytest.mark.parametrize('mission', ['rover', 'office', 'guards'])
def test_nothing_of_a_world_can_be_changed(mission: str) -> None:
    file = MISSIONS / mission / 'world.yaml'
    world = read_world(file.read_text(encoding='utf-8'), str(file), str(file.parent))
    kinds = set()
    for path, part in parts_of(world):
        kinds.add(type(part).__name__)
        if dataclasses.is_dataclass(part):
            name = dataclasses.fields(part)[0].name
            with pytest.raises(dataclasses.FrozenInstanceError):
                setattr(part, name, getattr(part, name))
        elif isinstance(part, np.ndarray):
            assert not part.flags.writeable, path
            with pytest.raises(ValueError, match='WRITEABLE'):
                part.setflags(write=True)
        elif hasattr(part, 'items'):
            with pytest.raises(TypeError):
                # What the types forbid is what must fail.
                part['other'] = None  # type: ignore[index]
        else:
            assert isinstance(part, (str, bytes, int, float, tuple, type(None))), path
    assert {'World', 'Bounds', 'WorldObject', 'Robot'} < kinds
    assert revision_of(world) == world.revision
