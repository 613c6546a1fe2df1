"""The graph of waypoints, in both readings of the paper's "70 edges and 1126 vertices"."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import combinations
from math import cos, dist, inf, pi, sin, tau

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import minimum_spanning_tree

from experiments.motion.worlds import ROVER
from motion_planner_node.world import read_world
from motion_planner_node.world.model import Obstacle, Polygon, World

Point = tuple[float, float]
START = 'location0'
#: Sides of the polygons that stand for round obstacles.
SIDES = 7
#: Added to the free space, so that a line along an obstacle's grown edge counts as free [m].
SLACK = 1e-6
#: The literal reading: arcs, vertices, and how many of these have an arc.
FEW_ARCS, MANY_VERTICES, JOINED = 70, 1126, 30


@dataclass(frozen=True)
class Graph:
    """Waypoints and the straight ways between them.

    points: positions [m] by label, of those with and without a way
    arcs: lengths [m] of ways by their ends; each way is there in both directions
    """

    name: str
    points: Mapping[str, Point]
    arcs: Mapping[tuple[str, str], float]

    @property
    def joined(self) -> list[str]:
        """The waypoints with a way."""
        ends = {end for arc in self.arcs for end in arc}
        return [label for label in self.points if label in ends]

    @property
    def goals(self) -> list[str]:
        """Where a mission may lead."""
        return [label for label in self.joined if label != START]

    def lengths(self) -> csr_array:
        """Lengths of the arcs [m] as a sparse matrix, in the order of the points."""
        number = {label: index for index, label in enumerate(self.points)}
        rows = [number[a] for a, _ in self.arcs]
        columns = [number[b] for _, b in self.arcs]
        size = len(self.points)
        return csr_array((list(self.arcs.values()), (rows, columns)), shape=(size, size))


def rover_world() -> World:
    """The world of the rover's mission."""
    return read_world(ROVER.read_text(encoding='utf-8'), str(ROVER))


def grown(obstacle: Obstacle, margin: float) -> shapely.Polygon:
    """A polygon that keeps ``margin`` [m] from an obstacle, with as many corners as that has."""
    if isinstance(obstacle, Polygon):
        return shapely.Polygon(obstacle.corners).buffer(margin, join_style='mitre')
    (x, y), reach = obstacle.center, (obstacle.radius + margin) / cos(pi / SIDES)
    turns = [tau * side / SIDES for side in range(SIDES)]
    return shapely.Polygon([(x + reach * cos(turn), y + reach * sin(turn)) for turn in turns])


def visibility_graph(world: World) -> Graph:
    """All waypoints that see each other: corners of the grown obstacles, and the objects.

    Obstacles are grown by the rover's radius; corners outside of the map or in another obstacle
    are no waypoints.
    """
    (robot,) = world.robots.values()
    b, margin = world.bounds, robot.radius
    map_area = shapely.box(b.x_min + margin, b.y_min + margin, b.x_max - margin, b.y_max - margin)
    shapes = [grown(obstacle, margin) for obstacle in world.obstacles]
    free = shapely.buffer(shapely.difference(map_area, shapely.union_all(shapes)), SLACK)
    corners = [corner for shape in shapes for corner in list(shape.exterior.coords)[:-1]]
    standing = [corner for corner in corners if free.covers(shapely.Point(corner))]
    points: dict[str, Point] = {
        label: (place.fields['x'], place.fields['y']) for label, place in world.objects.items()
    }
    points |= {f'corner{index}': (x, y) for index, (x, y) in enumerate(standing)}
    arcs = {}
    for a, c in combinations(points, 2):
        if free.covers(shapely.LineString([points[a], points[c]])):
            arcs[a, c] = arcs[c, a] = dist(points[a], points[c])
    return Graph('swapped', points, {arc: arcs[arc] for arc in sorted(arcs)})


def literal_graph(dense: Graph, world: World, seed: int) -> Graph:
    """70 arcs between a few waypoints of ``dense``, far from each other, among 1126 vertices.

    The ways are those of a shortest spanning tree and the shortest others; the vertices without a
    way are random free places.
    """
    labels = _spread(dense, JOINED)
    number = [list(dense.points).index(label) for label in labels]
    lengths = dense.lengths().toarray()[np.ix_(number, number)]
    tree = minimum_spanning_tree(lengths).tocoo()
    ways = {tuple(sorted((labels[i], labels[j]))) for i, j in zip(*tree.coords, strict=True)}
    if len(ways) != len(labels) - 1:
        raise ValueError('the waypoints that were chosen do not see one another: choose more')
    among = [arc for arc in dense.arcs if arc[0] < arc[1] and set(arc) <= set(labels)]
    others = sorted((arc for arc in among if arc not in ways), key=lambda arc: dense.arcs[arc])
    ways.update(others[: FEW_ARCS // 2 - len(ways)])
    arcs = {(a, b): dense.arcs[a, b] for way in ways for a, b in (way, way[::-1])}
    points = {label: dense.points[label] for label in labels}
    lonely = _free_places(world, MANY_VERTICES - len(points), np.random.default_rng(seed))
    points |= {f'vertex{index}': place for index, place in enumerate(lonely)}
    return Graph('literal', points, {arc: arcs[arc] for arc in sorted(arcs)})


def _spread(graph: Graph, count: int) -> list[str]:
    """``count`` waypoints, each the farthest from those before it."""
    chosen = [START]
    while len(chosen) < count:
        chosen.append(max(graph.points, key=lambda label: _nearest(graph, label, chosen)))
    return chosen


def _nearest(graph: Graph, label: str, others: Sequence[str]) -> float:
    distances = (dist(graph.points[label], graph.points[other]) for other in others)
    return reduce(min, distances, inf)


def _free_places(world: World, count: int, rng: np.random.Generator) -> list[Point]:
    (robot,) = world.robots.values()
    shapes = shapely.union_all([grown(obstacle, robot.radius) for obstacle in world.obstacles])
    b = world.bounds
    found: list[Point] = []
    while len(found) < count:
        places: NDArray[np.float64] = rng.uniform(
            (b.x_min, b.y_min), (b.x_max, b.y_max), (count, 2)
        )
        inside = shapely.contains_xy(shapes, places[:, 0], places[:, 1])
        found += [(float(x), float(y)) for x, y in places[~inside]]
    return found[:count]
