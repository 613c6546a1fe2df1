"""Tours of PyVRP and OR-Tools through matrices of costs.

Both choose one attitude of each group by themselves: PyVRP in groups of clients that exclude each other,
OR-Tools in disjunctions.  The way is open: back to the start costs nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: Whole numbers of the libraries are so many to the metre.
SCALE = 100
#: [m] where there is no way.
NO_WAY = 1e5
Matrix = NDArray[np.int64]


def whole(costs: NDArray[np.float32]) -> Matrix:
    """The costs as whole numbers, the way home for nothing."""
    matrix = np.where(np.isfinite(costs), costs, NO_WAY)
    matrix = np.rint(matrix * SCALE).astype(np.int64)
    matrix[:, 0] = 0
    np.fill_diagonal(matrix, 0)
    return np.asarray(matrix, np.int64)


def by_pyvrp(matrix: Matrix, owner: NDArray[np.int64], seconds: float, seed: int) -> list[int]:
    """Attitudes in their order after so many seconds."""
    import pyvrp
    from pyvrp.stop import MaxRuntime

    model = pyvrp.Model()
    places = [model.add_location(0, 0) for _ in owner]
    model.add_depot(places[0])
    model.add_vehicle_type(1)
    groups = [model.add_client_group(required=True) for _ in range(int(owner.max()))]
    for place, group in zip(places[1:], owner[1:], strict=True):
        model.add_client(place, required=False, group=groups[group - 1])
    data = model.data().replace(
        distance_matrices=[matrix], duration_matrices=[np.zeros_like(matrix)]
    )
    best = pyvrp.solve(data, MaxRuntime(seconds), seed=seed, display=False).best
    activities = [activity for route in best.routes() for activity in route]
    return [1 + activity.idx for activity in activities if activity.is_client()]


def by_ortools(matrix: Matrix, owner: NDArray[np.int64], seconds: float, _seed: int) -> list[int]:
    """Attitudes in their order after so many seconds of guided local search."""
    from ortools.constraint_solver import pywrapcp, routing_enums_pb2

    manager = pywrapcp.RoutingIndexManager(len(owner), 1, 0)
    routing = pywrapcp.RoutingModel(manager)
    transit = routing.RegisterTransitMatrix(matrix.tolist())
    routing.SetArcCostEvaluatorOfAllVehicles(transit)
    for group in range(1, int(owner.max()) + 1):
        members = [manager.NodeToIndex(int(i)) for i in np.flatnonzero(owner == group)]
        routing.AddDisjunction(members, 10**10, 1)
    options: Any = pywrapcp.DefaultRoutingSearchParameters()
    options.first_solution_strategy = routing_enums_pb2.FirstSolutionStrategy.PATH_CHEAPEST_ARC
    options.local_search_metaheuristic = (
        routing_enums_pb2.LocalSearchMetaheuristic.GUIDED_LOCAL_SEARCH
    )
    options.time_limit.FromMilliseconds(int(1000 * seconds))
    solution = routing.SolveWithParameters(options)
    if solution is None:
        return []
    tour, index = [], solution.Value(routing.NextVar(routing.Start(0)))
    while not routing.IsEnd(index):
        tour.append(manager.IndexToNode(index))
        index = solution.Value(routing.NextVar(index))
    return tour


#: Attitudes in their order for a matrix, the group of each attitude, seconds and a seed.
Library = Callable[[Matrix, NDArray[np.int64], float, int], list[int]]
LIBRARIES: dict[str, Library] = {'PyVRP': by_pyvrp, 'OR-Tools': by_ortools}
PACKAGES = {'PyVRP': 'pyvrp', 'OR-Tools': 'ortools'}


def installed() -> dict[str, str]:
    """The versions of the libraries that are there, by their names."""
    found = {}
    for name, package in PACKAGES.items():
        try:
            found[name] = version(package)
        except PackageNotFoundError:
            continue
    return found


def length_of(costs: NDArray[np.float32], owner: NDArray[np.int64], tour: list[int]) -> float:
    """Length [m] of a tour; infinite where it leaves a group out or there is no way."""
    if sorted(owner[tour]) != list(range(1, int(owner.max()) + 1)):
        return float('inf')
    return float(costs[[0, *tour[:-1]], tour].astype(np.float64).sum())
