"""Which candidates of a request are met on the way of its motions, and where at first."""

from __future__ import annotations

from motion_planner_node.advice.opportunities import Track, first_places
from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.planning.texts import Texts
from motion_planner_node.requests import AdviceRequest, Opportunity
from motion_planner_node.robots.driving import end_of
from motion_planner_node.robots.motion import GeometricState, Motion
from motion_planner_node.satisfaction import Program
from motion_planner_node.stopping import ShouldStop, go_on
from motion_planner_node.world.model import World


def met_on_the_way(
    world: World,
    texts: Texts,
    request: AdviceRequest,
    state: GeometricState,
    should_stop: ShouldStop,
) -> list[Opportunity]:
    """The first place on each motion at which each candidate is met, in the order of the way.

    :raises Stopped: when ``should_stop`` said so
    """
    found: list[Opportunity] = []
    states = _states_before(world, request.motions, state)
    for mover in dict.fromkeys(motion.agent for motion in request.motions):
        numbers = [k for k, motion in enumerate(request.motions) if motion.agent == mover]
        together = _track(world, request.motions, numbers)
        for index, text in enumerate(request.preconditions):
            go_on(should_stop)
            program = _program(texts, text, states[numbers[0]], mover)
            if program is None:
                continue
            if len(program.agents) == 1:
                found += _met(index, program, numbers, together, should_stop)
                continue
            # Others stand elsewhere during each of the motions.
            for number in numbers:
                go_on(should_stop)
                program = _program(texts, text, states[number], mover)
                if program is not None:
                    track = _track(world, request.motions, [number])
                    found += _met(index, program, [number], track, should_stop)
    return sorted(found, key=lambda item: (item.motion, item.distance, item.candidate))


def _met(
    candidate: int, program: Program, numbers: list[int], track: Track, should_stop: ShouldStop
) -> list[Opportunity]:
    with program.broken_off_by(should_stop):
        places = first_places(program, track)
    return [
        Opportunity(
            candidate,
            numbers[int(motion)],
            track.distance(float(place)),
            (program.agent, track.attitude(float(place))),
        )
        for place, motion in zip(places, track.motion_of(places), strict=True)
    ]


def _track(world: World, motions: tuple[Motion, ...], numbers: list[int]) -> Track:
    chosen = [motions[number] for number in numbers]
    return Track(chosen, world.robots[chosen[0].agent])


def _states_before(
    world: World, motions: tuple[Motion, ...], state: GeometricState
) -> list[GeometricState]:
    """Where everybody stands at the beginning of each motion."""
    states: list[GeometricState] = []
    for motion in motions:
        state = {**state, motion.agent: motion.start}
        states.append(state)
        state = {**state, motion.agent: end_of(motion, world.robots[motion.agent])}
    return states


def _program(texts: Texts, text: str, state: GeometricState, mover: str) -> Program | None:
    """The constraints that robot ``mover`` has to meet; None where there are none for it."""
    try:
        preconditions = texts.parsed(text)
        if preconditions.assigns or preconditions.agents[:1] != (mover,):
            return None
        program = texts.problem(text, state).program
    except MotionPlannerError:
        # The advice on the candidate itself says what is wrong with it.
        return None
    return None if program.contradictions else program
