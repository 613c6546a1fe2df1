"""The motion planner: stateless but for its world, and the same answer to the same question."""

from __future__ import annotations

from motion_planner_node.advice.advisor import Advisor
from motion_planner_node.codes import Purpose
from motion_planner_node.errors import MotionPlannerError, Stopped
from motion_planner_node.parameters import PAPER_MODE, Parameters
from motion_planner_node.planning import answers
from motion_planner_node.planning.cache import Cache
from motion_planner_node.planning.check import CheckResult, check_text
from motion_planner_node.planning.ground import Ground
from motion_planner_node.planning.paper_ways import PaperWays
from motion_planner_node.planning.problem import (
    Problem,
    check_request,
    checked_state,
    preferred_end,
)
from motion_planner_node.planning.proofs import blocked_start, contradiction, lasting
from motion_planner_node.planning.stream import Stream
from motion_planner_node.planning.texts import Texts
from motion_planner_node.planning.tried import Tried
from motion_planner_node.planning.ways import Ways
from motion_planner_node.requests import (
    AdviceAnswer,
    AdviceRequest,
    GeometricAnswer,
    GeometricRequest,
)
from motion_planner_node.robots.motion import Attitude, Motion
from motion_planner_node.robots.robot import Robot
from motion_planner_node.stopping import ShouldStop, go_on, never
from motion_planner_node.tours.exact import MOST_EXACT
from motion_planner_node.world import Scene
from motion_planner_node.world.model import (
    Bounds,
    Circle,
    Polygon,
    World,
    WorldObject,
)
from motion_planner_node.world.standing import outlines_of

#: Robots whose free space is kept.
MOST_GROUNDS = 8


class MotionPlanner:
    """Answers requests about one world.

    What it keeps between requests only saves work: a planner that was asked nothing before gives
    the same answers, bit for bit.  Not for several threads at once.
    """

    def __init__(self, world: World, parameters: Parameters | None = None):
        self.world = world
        self._parameters = parameters or Parameters()
        self._scene = Scene(world)
        self._grounds: Cache[Robot, Ground] = Cache(MOST_GROUNDS, self._forget)
        self._crowded: Cache[tuple[Robot, tuple[tuple[str, Attitude], ...]], Ground]
        self._crowded = Cache(MOST_GROUNDS, self._forget)
        size = self._parameters.cache_size
        self._texts = Texts(world, size)
        self._streams: Cache[object, Stream] = Cache(size)
        self._advisor = Advisor(world, self._parameters, self._texts, self._ground)

    def prepare(self) -> None:
        """Work out what depends on no request, so that none has to wait for it."""
        for robot in list(self.world.robots.values())[:MOST_GROUNDS]:
            self._ground(robot)

    def with_parameters(self, parameters: Parameters) -> MotionPlanner:
        """A planner of the same world with other parameters."""
        planner = MotionPlanner(self.world, parameters)
        planner.prepare()
        return planner

    def satisfy(
        self, request: GeometricRequest, should_stop: ShouldStop = never
    ) -> GeometricAnswer:
        """Find an attitude that meets the preconditions, and a motion to it (Algorithm 1).

        Whatever is wrong is in the answer's code and message; nothing is raised.
        """
        try:
            check_request(self.world, request)
            state = checked_state(self.world, request.start)
            problem = self._texts.problem(request.preconditions, state, request.agent)
            if problem.program.assigns:
                return answers.assigned(problem, self._ground, request.alternative)
            preferred = preferred_end(problem, request)
        except MotionPlannerError as error:
            return answers.refused(error, self.world.revision)
        try:
            ground = self._crowded_ground(problem, should_stop)
        except Stopped:
            return answers.out_of_time(problem, self._ground(problem.robot), Tried(problem.agent))
        proof = contradiction(problem) or blocked_start(problem, ground)
        if proof:
            return answers.impossible(problem, ground, proof)
        return self._search(request, problem, preferred, ground, should_stop)

    def _search(
        self,
        request: GeometricRequest,
        problem: Problem,
        preferred: Attitude | None,
        ground: Ground,
        should_stop: ShouldStop,
    ) -> GeometricAnswer:
        state = tuple(problem.state.items())
        mode = request.mode or self._parameters.mode
        planner = request.planner or self._parameters.planner
        key = (request.preconditions, problem.agent, state, request.seed, mode, planner, preferred)
        ways_of = PaperWays if mode == PAPER_MODE else Ways
        stream = self._streams.get(
            key,
            lambda: Stream(
                ways_of(problem, ground, self._parameters, request.seed, planner, preferred)
            ),
        )
        try:
            with problem.program.broken_off_by(should_stop):
                found = stream.find(request.alternative, should_stop)
                if found:
                    return answers.found(problem, ground, found)
                if stream.proof:
                    proof = lasting(problem, stream.proof, self._ground(problem.robot), ground)
                    return answers.impossible(problem, ground, proof)
                return answers.exhausted(problem, ground, stream.tried, request.alternative)
        except Stopped:
            return answers.out_of_time(problem, ground, stream.tried)

    def advise(self, request: AdviceRequest, should_stop: ShouldStop = never) -> AdviceAnswer:
        """Say what each candidate would cost from here, and which to try first.

        :raises MotionPlannerError: when there can be no advice at all, as for `satisfy`
        :raises Stopped: when ``should_stop`` said so
        """
        return self._advisor.advise(request, should_stop)

    def check(self, text: str, source: str = '', line: int = 0, column: int = 0) -> CheckResult:
        """Check a text against this world; see `check_text`."""
        return check_text(text, self.world, source, line, column)

    def _forget(self, _ground: Ground) -> None:
        """Drop what was worked out on some ground, so that no forgotten one is kept by it."""
        self._streams.clear()
        self._advisor.forget()

    def _ground(self, robot: Robot) -> Ground:
        return self._grounds.get(robot, lambda: Ground(self._scene, robot))

    def _crowded_ground(self, problem: Problem, should_stop: ShouldStop) -> Ground:
        """The ground on which the robot of ``problem`` drives while all others stand still."""
        robot, others = problem.robot, problem.others
        if not others:
            return self._ground(robot)

        def ground() -> Ground:
            scene = self._scene.with_more(outlines_of(self.world, others))
            go_on(should_stop)
            return Ground(scene, robot)

        return self._crowded.get((robot, tuple(others.items())), ground)


def warm_up() -> None:
    """Compile the numerical kernels, or load them, so that the first request need not.

    Takes a minute or so the first time and about one when the kernels are cached on disk.
    """
    agent, here = 'robot', Attitude(20.0, 10.0, 0.0)
    car = Robot(agent, wheelbase=1.0, max_steering_angle=0.5, radius=1.0, speed=1.0)
    wall = Polygon('wall', ((40.0, 0.0), (44.0, 0.0), (44.0, 40.0), (40.0, 40.0)))
    tree = Circle('tree', (60.0, 50.0), 3.0)
    goal = WorldObject('goal', {'x': 60.0, 'y': 10.0})
    corner = WorldObject('corner', {'x': 1.2, 'y': 1.2})
    bounds = Bounds(0.0, 0.0, 80.0, 80.0)
    objects = {'goal': goal, 'corner': corner}
    planner = MotionPlanner(World('', '', bounds, objects, (wall, tree), {agent: car}))
    text = '((agent robot)(object goal)(distance(robot, goal) <= 5))'
    planner.satisfy(GeometricRequest(text, {agent: here}))
    planner.advise(AdviceRequest((text,), {agent: here}, pairwise=True))
    for count in (1, MOST_EXACT + 1):
        tour = AdviceRequest((text,) * count, {agent: here}, purpose=Purpose.SHORTEST_TOUR)
        planner.advise(tour)
    met = AdviceRequest(
        (text,), {agent: here}, purpose=Purpose.OPPORTUNITIES, motions=(Motion(agent, here),)
    )
    planner.advise(met)
    seen = f'{text[:-1]}(visible(robot, goal))(clearance(robot) >= 2))'
    planner.satisfy(GeometricRequest(seen, {agent: here}))
    # Two requests in vain: no attitude, and one that is hard to drive to.
    beyond = '((agent robot)(robot.x * robot.y = 1e6))'
    planner.satisfy(GeometricRequest(beyond, {agent: here}))
    cramped = '((agent robot)(object corner)(distance(robot, corner) <= 0.1)(robot.heading = -0.8))'
    planner.satisfy(GeometricRequest(cramped, {agent: here}))
