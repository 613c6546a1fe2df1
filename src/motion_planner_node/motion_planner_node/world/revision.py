"""The digest by which equal worlds are known to be equal."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict

from motion_planner_node.world.model import Obstacle, Region, World


def revision_of(world: World) -> str:
    """The first 16 hexadecimal digits of SHA-256 over the content, not over source or layout."""
    content: dict[str, object] = {
        'bounds': asdict(world.bounds),
        'objects': {label: dict(thing.fields) for label, thing in world.objects.items()},
        'obstacles': [_outline(obstacle) for obstacle in world.obstacles],
        'robots': {label: asdict(robot) for label, robot in world.robots.items()},
    }
    if world.regions:
        content['regions'] = {label: _outline(region) for label, region in world.regions.items()}
    if world.map:
        content['map'] = {
            'cells': hashlib.sha256(world.map.cells).hexdigest(),
            'size': [world.map.rows, world.map.columns, world.map.resolution],
            'origin': [world.map.x, world.map.y, world.map.yaw],
            'outside': world.map.unknown_occupied,
        }
    canonical = json.dumps(content, sort_keys=True, separators=(',', ':'))
    return hashlib.sha256(canonical.encode()).hexdigest()[:16]


def _outline(outline: Obstacle | Region) -> dict[str, object]:
    """What an outline is; one without holes as if there were none in the language."""
    return {key: value for key, value in asdict(outline).items() if key != 'holes' or value}
