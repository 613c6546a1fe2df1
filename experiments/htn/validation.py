"""Plans of HDDL missions judged by unified-planning, which shares no code with the planner."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from unified_planning.model import Problem


class NotJudged(Exception):
    """A mission that unified-planning cannot read; the message is its own."""


def fault_of(domain: Path, problem: Path, actions: Sequence[Sequence[str]]) -> str:
    """Why the actions are no plan of the mission; empty when they are one.

    An action is the name of an operator, with or without ``!``, and its arguments.  Actions are applied one after the
    other by unified-planning's simulator, the goal is tested, and its validator has to agree.  The decomposition
    is not judged: unified-planning has no validator of hierarchical plans.  Raises NotJudged.
    """
    # Here, so that what only runs the missions needs no unified-planning.
    from unified_planning import shortcuts
    from unified_planning.exceptions import UPException
    from unified_planning.io import PDDLReader
    from unified_planning.plans import ActionInstance, SequentialPlan

    environment = shortcuts.get_environment()
    environment.credits_stream = None
    environment.error_used_name = False
    try:
        hierarchical = PDDLReader().parse_problem(str(domain), str(problem))
    except (UPException, SyntaxError, AssertionError) as error:
        raise NotJudged(f'{type(error).__name__}: {error}') from error
    flat = _without_tasks(hierarchical)
    known = {action.name.lower(): action for action in flat.actions}
    objects = {each.name.lower(): each for each in flat.all_objects}
    steps = []
    for name, *arguments in actions:
        terms = tuple(shortcuts.ObjectExp(objects[argument.lower()]) for argument in arguments)
        steps.append(ActionInstance(known[name.lstrip('!').lower()], terms))
    with shortcuts.SequentialSimulator(flat) as simulator:
        state = simulator.get_initial_state()
        for number, step in enumerate(steps):
            state = simulator.apply(state, step)
            if state is None:
                return f'step {number}, {step}, is not applicable'
        if not simulator.is_goal(state):
            return 'the goal does not hold at the end'
    with shortcuts.PlanValidator(problem_kind=flat.kind) as validator:
        verdict = validator.validate(flat, SequentialPlan(steps))
    return '' if verdict else str(verdict)


def _without_tasks(problem: Problem) -> Problem:
    """The same actions, objects, facts and goal, without tasks and methods."""
    from unified_planning.model import Problem

    flat = Problem('flat', problem.environment)
    for fluent in problem.fluents:
        flat.add_fluent(fluent, default_initial_value=problem.fluents_defaults.get(fluent))
    flat.add_objects(problem.all_objects)
    flat.add_actions(problem.actions)
    for fluent, value in problem.explicit_initial_values.items():
        flat.set_initial_value(fluent, value)
    for goal in problem.goals:
        flat.add_goal(goal)
    return flat
