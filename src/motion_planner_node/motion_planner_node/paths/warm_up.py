"""Compile every kernel before the first request comes."""

from __future__ import annotations

from motion_planner_node.paths.planner import plan_path
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world.model import Bounds, CarModel, Circle, Polygon, World
from motion_planner_node.world.scene import Scene


def warm_up() -> None:
    """Plan in a small world, so that no later call compiles.

    Takes some ten seconds the first time and less than one when the results are cached.
    """
    car = CarModel('car', wheelbase=1.0, max_steering_angle=0.5, radius=1.0, speed=1.0)
    wall = Polygon('wall', ((40.0, 0.0), (44.0, 0.0), (44.0, 40.0), (40.0, 40.0)))
    tree = Circle('tree', (60.0, 50.0), 3.0)
    world = World('', '', Bounds(0.0, 0.0, 80.0, 80.0), {}, (wall, tree), {'car': car})
    start, goal = Attitude(20.0, 10.0, 0.0), Attitude(60.0, 10.0, 0.0)
    plan_path(Scene(world), car, start, [goal], 1, lambda: False)
