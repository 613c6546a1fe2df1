"""Texts that were read, what is wrong with them, and their programs: for the next who asks."""

from __future__ import annotations

from motion_planner_node.errors import Diagnostic
from motion_planner_node.language import Preconditions, check, parse
from motion_planner_node.planning.cache import Cache
from motion_planner_node.planning.problem import Problem, read_problem
from motion_planner_node.robots.motion import GeometricState
from motion_planner_node.satisfaction import Program
from motion_planner_node.world.model import World


class Texts:
    """Geometric preconditions in one world; of each kind the ``size`` last ones are kept."""

    def __init__(self, world: World, size: int) -> None:
        self._world = world
        self._parsed: Cache[str, Preconditions] = Cache(size)
        self._remarks: Cache[str, tuple[Diagnostic, ...]] = Cache(size)
        self._programs: Cache[tuple[str, str], Program] = Cache(size)

    def parsed(self, text: str) -> Preconditions:
        """What ``text`` says.

        :raises MotionPlannerError: INVALID_PRECONDITIONS with a diagnostic for each error
        """
        return self._parsed.get(text, lambda: parse(text))

    def problem(self, text: str, state: GeometricState, agent: str = '') -> Problem:
        """What is asked for in ``state``, ready for searches; see `read_problem`.

        :raises MotionPlannerError: as `parsed` and `read_problem`
        """
        preconditions = self.parsed(text)
        remarks = self._remarks.get(text, lambda: check(preconditions, self._world))
        key = text, agent
        known = self._programs.known(key)
        problem = read_problem(self._world, preconditions, state, agent, remarks, known)
        self._programs.get(key, lambda: problem.program)
        return problem
