"""Whether a request for advice makes sense, by what it is for."""

from __future__ import annotations

from math import isfinite

from motion_planner_node.codes import Code, Purpose
from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.planning.problem import check_attitudes
from motion_planner_node.requests import AdviceRequest
from motion_planner_node.robots.commands import trouble_with
from motion_planner_node.world.model import World

#: Purposes for which an order and ends are looked for.
TOURS = frozenset({Purpose.SHORTEST_TOUR, Purpose.FIXED_ORDER})
#: Candidates of a tour for which the budget of a request is granted once, as for other advice.
PER_SHARE = 16
#: Motions of one request at most.
MOST_MOTIONS = 1000


def check_purpose(world: World, request: AdviceRequest) -> None:
    """Refuse a purpose that does not exist, and what is wrong with the fields that it needs.

    Fields of other purposes are not looked at.

    :raises MotionPlannerError: UNSUPPORTED, UNKNOWN_AGENT or INVALID_START
    """
    if request.purpose not in tuple(Purpose):
        known = ', '.join(f'{purpose.name} ({purpose.value})' for purpose in Purpose)
        raise MotionPlannerError(
            Code.UNSUPPORTED, f'there is no purpose {request.purpose} of advice; there are {known}'
        )
    if request.purpose in TOURS or request.places:
        _check_ends(world, request)
    if request.purpose == Purpose.SHORTEST_TOUR:
        _check_precedences(request)
    if request.purpose == Purpose.OPPORTUNITIES:
        _check_motions(world, request)


def shares_of_budget(request: AdviceRequest) -> float:
    """How many times the budget of an ordinary request this one is granted: at least once.

    A tour is granted more for more candidates, and twice as much for each level of effort up to 8.
    """
    if request.purpose not in TOURS:
        return 1.0
    return max(1.0, len(request.preconditions) / PER_SHARE) * 2.0 ** min(request.effort, 8)


def _check_ends(world: World, request: AdviceRequest) -> None:
    count = len(request.preconditions)
    if request.ends and len(request.ends) != count:
        raise MotionPlannerError(
            Code.UNSUPPORTED,
            f'{len(request.ends)} ends for {count} candidates: give one for each, or none',
        )
    for index, end in enumerate(request.ends):
        if end:
            check_attitudes(world, {end[0]: end[1]}, f'end of candidate {index}')


def _check_precedences(request: AdviceRequest) -> None:
    count = len(request.preconditions)
    before, after = request.before, request.after
    if len(before) != len(after):
        raise MotionPlannerError(
            Code.UNSUPPORTED,
            f'before has {len(before)} candidates and after {len(after)}: they go together in pairs',
        )
    for index in (*before, *after):
        if not 0 <= index < count:
            raise MotionPlannerError(
                Code.UNSUPPORTED,
                f'before and after name candidate {index}; there are {count}, counted from 0',
            )
    left = set(range(count))
    pairs = set(zip(before, after, strict=True))
    while left:
        waiting = {j for i, j in pairs if i in left}
        free = left - waiting
        if not free:
            names = ', '.join(str(index) for index in sorted(left)[:8])
            raise MotionPlannerError(
                Code.UNSUPPORTED,
                f'before and after contradict each other: none of the candidates {names} can '
                'come first among them',
            )
        left -= free


def _check_motions(world: World, request: AdviceRequest) -> None:
    if len(request.motions) > MOST_MOTIONS:
        raise MotionPlannerError(
            Code.UNSUPPORTED,
            f'{len(request.motions)} motions are too many: {MOST_MOTIONS} at most',
        )
    for number, motion in enumerate(request.motions):
        check_attitudes(world, {motion.agent: motion.start}, f'start of motion {number}')
        robot = world.robots[motion.agent]
        for place, segment in enumerate(motion.segments, 1):
            trouble = trouble_with(segment, robot)
            if trouble:
                raise MotionPlannerError(
                    Code.UNSUPPORTED, f'segment {place} of motion {number} {trouble}'
                )
        if not isfinite(motion.length):
            raise MotionPlannerError(Code.UNSUPPORTED, f'motion {number} has no finite length')
