"""Domains for GTPyhop, method for method those of the SHOP texts.

Each function declares actions and methods with ``gtpyhop``, fills the ``state``, and returns the goal as a test of a
state; the task is ``('all',)``.  Facts that never change are kept outside of the state, which GTPyhop copies with
every action, as its examples do.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from experiments.htn.problems import Logistics, Rovers, Satellites

Goal = Callable[[Any], bool]


def _named(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    function.__name__ = name
    return function


def logistics(gtpyhop: Any, problem: Logistics, state: Any) -> Goal:
    """Packages, trucks and aeroplanes."""
    city_of, airports = problem.city_of, {places[0] for places in problem.cities.values()}
    truck_of = {city_of[place]: truck for truck, place in problem.trucks.items()}
    goals = {package: goal for package, (_, goal) in problem.packages.items()}
    state.at = {**problem.trucks, **problem.planes}
    state.at.update({package: start for package, (start, _) in problem.packages.items()})

    def load(s: Any, package: str, vehicle: str, place: str) -> Any:
        if s.at[package] == place and s.at[vehicle] == place:
            s.at[package] = vehicle
            return s
        return None

    def unload(s: Any, package: str, vehicle: str, place: str) -> Any:
        if s.at[package] == vehicle and s.at[vehicle] == place:
            s.at[package] = place
            return s
        return None

    def drive(s: Any, truck: str, start: str, goal: str) -> Any:
        if s.at[truck] == start and city_of[start] == city_of[goal]:
            s.at[truck] = goal
            return s
        return None

    def fly(s: Any, plane: str, start: str, goal: str) -> Any:
        if s.at[plane] == start and start in airports and goal in airports:
            s.at[plane] = goal
            return s
        return None

    def everything(_: Any) -> Any:
        return [('deliver', package, goal) for package, goal in goals.items()]

    def deliver(s: Any, package: str, goal: str) -> Any:
        start = s.at[package]
        if start == goal:
            return []
        here, there = city_of[start], city_of[goal]
        if here == there:
            return [('by_truck', package, start, goal)]
        departure, arrival = problem.cities[here][0], problem.cities[there][0]
        return [
            ('by_truck', package, start, departure),
            ('by_plane', package, departure, arrival),
            ('by_truck', package, arrival, goal),
        ]

    def by_truck(_: Any, package: str, start: str, goal: str) -> Any:
        if start == goal:
            return []
        truck = truck_of[city_of[start]]
        return [
            ('bring', truck, start),
            ('load', package, truck, start),
            ('bring', truck, goal),
            ('unload', package, truck, goal),
        ]

    def by_plane(s: Any, package: str, start: str, goal: str) -> Any:
        there = [plane for plane in problem.planes if s.at[plane] == start]
        plane = there[0] if there else next(iter(problem.planes))
        return [
            ('bring', plane, start),
            ('load', package, plane, start),
            ('bring', plane, goal),
            ('unload', package, plane, goal),
        ]

    def bring(s: Any, vehicle: str, place: str) -> Any:
        start = s.at[vehicle]
        if start == place:
            return []
        return [('drive' if vehicle in problem.trucks else 'fly', vehicle, start, place)]

    gtpyhop.declare_actions(load, unload, drive, fly)
    for name, method in {
        'all': everything,
        'deliver': deliver,
        'by_truck': by_truck,
        'by_plane': by_plane,
        'bring': bring,
    }.items():
        gtpyhop.declare_task_methods(name, method)
    return lambda final: all(final.at[package] == goal for package, goal in goals.items())


def rovers(gtpyhop: Any, problem: Rovers, state: Any) -> Goal:
    """Samples and images; the nearest rover and place are taken."""
    fleet, ways, soil = problem.rovers, problem.ways, set(problem.soil)
    routes, bases = problem.routes, problem.bases
    wanted: list[tuple[str, ...]] = [('soil-of', place) for place in problem.samples]
    wanted += [('image-of', target, mode) for target, mode in problem.images]
    state.at = {name: rover.place for name, rover in fleet.items()}
    state.store_empty = {name: True for name, rover in fleet.items() if rover.drill}
    state.received = {}
    state.taken = {}

    def hops(start: str, goal: str) -> int:
        return 0 if start == goal else routes[start, goal][0]

    def navigate(s: Any, rover: str, start: str, goal: str) -> Any:
        if s.at[rover] == start and goal in ways[start]:
            s.at[rover] = goal
            return s
        return None

    def sample(s: Any, rover: str, place: str) -> Any:
        if s.at[rover] == place and place in soil and s.store_empty.get(rover):
            s.store_empty[rover] = False
            s.taken[rover, place] = True
            return s
        return None

    def empty_store(s: Any, rover: str) -> Any:
        if s.store_empty.get(rover) is False:
            s.store_empty[rover] = True
            return s
        return None

    def take_image(s: Any, rover: str, camera: str, objective: str, mode: str) -> Any:
        able = fleet[rover].camera == camera and mode in fleet[rover].modes
        if able and s.at[rover] in problem.seen_from[objective]:
            s.taken[rover, objective, mode] = True
            return s
        return None

    def send(s: Any, rover: str, result: Any) -> Any:
        if s.at[rover] in problem.landers:
            s.received[result] = True
            return s
        return None

    def everything(s: Any) -> Any:
        for result in wanted:
            if result not in s.received:
                return [('get', result), ('all',)]
        return []

    def get(s: Any, result: Any) -> Any:
        if result[0] == 'soil-of':
            place = result[1]
            able = [name for name in fleet if fleet[name].drill]
            rover = min(able, key=lambda name: hops(s.at[name], place))
            make_room = [] if s.store_empty[rover] else [('empty-store', rover)]
            work = [*make_room, ('sample', rover, place)]
        else:
            _, target, mode = result
            choices = [
                (hops(s.at[name], place), name, place)
                for name in fleet
                if mode in fleet[name].modes
                for place in problem.seen_from[target]
            ]
            _, rover, place = min(choices)
            work = [('take-image', rover, fleet[rover].camera, target, mode)]
        return [('go', rover, place), *work, ('report', rover, result)]

    def report(s: Any, rover: str, result: Any) -> Any:
        place = bases[s.at[rover]]
        return [('go', rover, place), ('send', rover, result)]

    def go(s: Any, rover: str, place: str) -> Any:
        here = s.at[rover]
        if here == place:
            return []
        return [('navigate', rover, here, routes[here, place][1]), ('go', rover, place)]

    gtpyhop.declare_actions(
        navigate,
        sample,
        _named('empty-store', empty_store),
        _named('take-image', take_image),
        send,
    )
    for name, method in {'all': everything, 'get': get, 'report': report, 'go': go}.items():
        gtpyhop.declare_task_methods(name, method)
    return lambda final: len(final.received) == len(wanted)


def satellites(gtpyhop: Any, problem: Satellites, state: Any) -> Goal:
    """Images; an instrument that is ready is preferred."""
    instruments = problem.instruments
    state.pointing = dict(problem.pointing)
    state.active = dict.fromkeys(problem.pointing, '')
    state.calibrated = {}
    state.images = {}

    def turn(s: Any, satellite: str, start: str, goal: str) -> Any:
        if s.pointing[satellite] == start:
            s.pointing[satellite] = goal
            return s
        return None

    def switch_on(s: Any, instrument: str, satellite: str) -> Any:
        if instruments[instrument].satellite == satellite and not s.active[satellite]:
            s.active[satellite] = instrument
            s.calibrated.pop(instrument, None)
            return s
        return None

    def switch_off(s: Any, instrument: str, satellite: str) -> Any:
        if s.active[satellite] == instrument:
            s.active[satellite] = ''
            return s
        return None

    def calibrate(s: Any, instrument: str, satellite: str) -> Any:
        target = instruments[instrument].target
        if s.active[satellite] == instrument and s.pointing[satellite] == target:
            s.calibrated[instrument] = True
            return s
        return None

    def take_image(s: Any, satellite: str, direction: str, instrument: str, mode: str) -> Any:
        able = s.active[satellite] == instrument and mode in instruments[instrument].modes
        if able and s.pointing[satellite] == direction and instrument in s.calibrated:
            s.images[direction, mode] = True
            return s
        return None

    def everything(s: Any) -> Any:
        for direction, mode in problem.images:
            if (direction, mode) not in s.images:
                return [('photograph', direction, mode), ('all',)]
        return []

    def photograph(s: Any, direction: str, mode: str) -> Any:
        able = [name for name in instruments if mode in instruments[name].modes]
        ready = [n for n in able if s.active[instruments[n].satellite] == n and n in s.calibrated]
        instrument = ready[0] if ready else able[0]
        satellite = instruments[instrument].satellite
        prepare = [] if ready else [('prepare', instrument, satellite)]
        return [
            *prepare,
            ('point', satellite, direction),
            ('take-image', satellite, direction, instrument, mode),
        ]

    def prepare(_: Any, instrument: str, satellite: str) -> Any:
        return [
            ('activate', instrument, satellite),
            ('point', satellite, instruments[instrument].target),
            ('calibrate', instrument, satellite),
        ]

    def activate(s: Any, instrument: str, satellite: str) -> Any:
        active = s.active[satellite]
        if active == instrument:
            return []
        off = [('switch-off', active, satellite)] if active else []
        return [*off, ('switch-on', instrument, satellite)]

    def point(s: Any, satellite: str, direction: str) -> Any:
        here = s.pointing[satellite]
        return [] if here == direction else [('turn', satellite, here, direction)]

    gtpyhop.declare_actions(
        turn,
        _named('switch-on', switch_on),
        _named('switch-off', switch_off),
        calibrate,
        _named('take-image', take_image),
    )
    for name, method in {
        'all': everything,
        'photograph': photograph,
        'prepare': prepare,
        'activate': activate,
        'point': point,
    }.items():
        gtpyhop.declare_task_methods(name, method)
    return lambda final: len(final.images) == len(set(problem.images))
