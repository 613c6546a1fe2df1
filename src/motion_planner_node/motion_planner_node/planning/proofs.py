"""Proofs that a request cannot be met, each with the starts that it holds for."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.codes import Code, Scope
from motion_planner_node.planning.ground import Area, Ground
from motion_planner_node.planning.problem import Problem
from motion_planner_node.robots.body import necessary_clearance
from motion_planner_node.satisfaction import branch_and_prune


@dataclass(frozen=True, slots=True)
class Impossible:
    """Why no attitude and motion exist; ``advice`` says what would help, or is empty."""

    code: Code
    scope: Scope
    message: str
    advice: str = ''


def contradiction(problem: Problem) -> Impossible | None:
    """Whether the text alone shows that the constraints contradict each other."""
    sentences = problem.program.contradictions
    return Impossible(Code.CONTRADICTION, Scope.ANY_START, sentences[0]) if sentences else None


def blocked_start(problem: Problem, ground: Ground) -> Impossible | None:
    """Whether the robot already stands where it cannot."""
    trouble = ground.trouble(problem.start)
    if not trouble:
        return None
    return Impossible(
        Code.START_IN_OBSTACLE,
        Scope.THIS_START,
        f'{problem.agent} starts in an obstacle: {trouble}',
    )


def hopeful_cells(problem: Problem, ground: Ground) -> NDArray[np.intp]:
    """Indices of the cells of ``ground`` outside of which no attitude meets the constraints."""
    return ground.cells.select(problem.program.position_cells)


def walled_off(problem: Problem, ground: Ground, hopeful: NDArray[np.intp]) -> Impossible | None:
    """Whether no place that may meet the constraints is free and can be driven to.

    Sound: cells are left out only when no attitude in them is free, or none meets the constraints;
    and what is not connected cell by cell is not connected.
    """
    if not len(hopeful):
        return _no_free_place(problem, ground)
    here = ground.part_of(problem.start)
    parts = ground.parts[hopeful]
    if here in parts:
        return None
    there, counts = np.unique(parts, return_counts=True)
    return _enclosed(problem, ground, here, int(there[np.argmax(counts)]))


def no_attitude(problem: Problem, ground: Ground) -> Impossible | None:
    """Whether interval bounds prove that no attitude, heading included, is free and will do."""
    bounds = ground.scene.world.bounds
    if branch_and_prune(problem.program, bounds, room=ground.room).is_empty:
        return _no_free_place(problem, ground)
    return None


def lasting(problem: Problem, proof: Impossible, empty: Ground, crowded: Ground) -> Impossible:
    """A ``proof`` on the ``crowded`` ground, for as many starts as it holds.

    On the ``empty`` one there are no other robots.  What is impossible there as well stays so
    wherever they go; else it lasts as long as they stand where they do.
    """
    if empty is crowded or proof.scope is Scope.THIS_START:
        return proof
    hopeful = hopeful_cells(problem, empty)
    without = walled_off(problem, empty, hopeful) or no_attitude(problem, empty)
    if without:
        return without
    robots = listed(sorted(problem.others))
    return replace(
        proof,
        scope=Scope.THIS_START,
        message=f'{proof.message}, as long as {robots} {_stands(problem)} there',
        advice=f'move {robots} first',
    )


def _stands(problem: Problem) -> str:
    return 'stands' if len(problem.others) == 1 else 'stand'


def _no_free_place(problem: Problem, ground: Ground) -> Impossible:
    sentence = problem.program.contradiction(ground.scene.world.bounds)
    if sentence:
        return Impossible(Code.CONTRADICTION, scope_of(problem, Scope.ANY_START), sentence)
    everywhere = ground.everywhere
    places = everywhere.boxes.chosen(everywhere.select(problem.program.position_cells))
    near = [ground.scene.nearest_obstacle(x, y) for x, y in zip(*places.centres, strict=True)]
    needed = necessary_clearance(ground.robot.body)
    names = sorted({name for name, clearance in near if clearance < needed})
    # The middle of a box may have the room that nothing in it that will do has.
    names = names or sorted({name for name, _ in near})
    return Impossible(
        Code.NO_FREE_DESTINATION,
        scope_of(problem, Scope.ANY_START),
        f'every place from which {wanted(problem)} holds is blocked by {listed(names)} '
        f'for {problem.agent} with {ground.robot.extent}',
        f'move {listed(names)} or relax the constraints',
    )


def _enclosed(problem: Problem, ground: Ground, here: int, there: int) -> Impossible:
    own, other = ground.area(here), ground.area(there)
    width = 2.0 * (ground.robot.radius + ground.robot.safety_margin)
    target = ' and '.join(problem.program.objects) or 'the destination'
    sought = wanted(problem)
    if own.size < other.size:
        walls = own
        message = (
            f'{problem.agent} is walled in: it cannot leave {_described(own)}, '
            f'and no place in there lets {sought} hold'
        )
    else:
        walls = other
        message = (
            f'{target} is walled in: every place from which {sought} holds '
            f'lies in {_described(other)}'
        )
    return Impossible(
        Code.UNREACHABLE,
        scope_of(problem, Scope.CONNECTED_STARTS),
        message,
        f'open a passage wider than {width:g} m through {listed(walls.obstacles)}',
    )


def scope_of(problem: Problem, widest: Scope) -> Scope:
    """Where other agents matter, a proof holds for where they are now."""
    return widest if len(problem.program.agents) == 1 else Scope.THIS_START


def _described(area: Area) -> str:
    return f'an enclosed area of {area.size:.0f} m2 bounded by {listed(area.obstacles)}'


def wanted(problem: Problem) -> str:
    """The constraints as a part of a sentence."""
    return ' and '.join(problem.program.constraints)


def listed(names: tuple[str, ...] | list[str]) -> str:
    """The first names, and how many more there are."""
    shown = list(names[:4])
    if len(names) > len(shown):
        shown.append(f'{len(names) - len(shown)} more')
    return ', '.join(shown)
