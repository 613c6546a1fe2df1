"""The world that the node plans in: `set_world`, `get_world`, a file, and a map on a topic."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from threading import Lock

from geohtn_msgs import srv
from nav_msgs.msg import OccupancyGrid
from rclpy.callback_groups import CallbackGroup
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from motion_planner_node import conversions
from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic, MotionPlannerError, guarded
from motion_planner_node.map_conversions import map_from_msg, map_of_request
from motion_planner_node.parameters import Parameters
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.world import read_world
from motion_planner_node.world.model import OccupancyMap, World
from motion_planner_node.world.syntax import LONGEST_TEXT

#: How a map is published that waits for those who come later.
LATCHED = QoSProfile(
    depth=1, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL
)


@dataclass(frozen=True, slots=True)
class _Given:
    """A world as somebody gave it."""

    text: str
    source: str
    directory: str = ''
    grid: OccupancyMap | None = None


class Worlds:
    """Holds the planner of one world at a time.

    A request asks once for `current` and stays with that planner, whatever is set meanwhile.  With
    a topic for the map, each map that comes makes a new world out of it and the last text.
    """

    def __init__(self, node: Node, parameters: Parameters) -> None:
        self._logger = node.get_logger()
        self._parameters = parameters
        self._planner: MotionPlanner | None = None
        self._changing = Lock()
        self._reading = Lock()
        self._given: _Given | None = None
        self._grid: OccupancyMap | None = None
        if parameters.world:
            self._given = _Given(_read_file(parameters.world), parameters.world)
            if not parameters.map_topic:
                self._use(self._given)

    def serve(self, node: Node, slow: CallbackGroup, quick: CallbackGroup) -> None:
        """Offer the services: reading a world or map is ``slow``, telling it is ``quick``."""
        node.create_service(srv.SetWorld, 'set_world', self._set_world, callback_group=slow)
        node.create_service(srv.GetWorld, 'get_world', self._get_world, callback_group=quick)
        if self._parameters.map_topic:
            topic = self._parameters.map_topic
            node.create_subscription(
                OccupancyGrid, topic, self._take_map, LATCHED, callback_group=slow
            )

    @property
    def planner(self) -> MotionPlanner | None:
        """The planner of the world that is held, if any."""
        return self._planner

    @property
    def revision(self) -> str:
        """Revision of the world that is held; empty without one."""
        planner = self._planner
        return planner.world.revision if planner else ''

    def current(self) -> MotionPlanner:
        """The planner of the world that is held.

        :raises MotionPlannerError: NO_WORLD
        """
        planner = self._planner
        if planner is None:
            raise MotionPlannerError(
                Code.NO_WORLD, 'the motion planner has no world yet: call set_world first'
            )
        return planner

    def adopt(self, parameters: Parameters) -> None:
        """Plan with ``parameters`` from the next request on."""
        with self._changing:
            self._parameters = parameters
            if self._planner is not None:
                self._planner = self._planner.with_parameters(parameters)

    def _use(self, given: _Given) -> str:
        """Read a world and hold it; everything that depends on no request is worked out now."""
        with self._reading:
            return self._read(given)

    def _read(self, given: _Given) -> str:
        topic, grid = self._parameters.map_topic, given.grid
        if topic and grid is None:
            grid = self._grid
            if grid is None:
                message = f'no map has come on the topic {topic} yet'
                raise MotionPlannerError(Code.NO_WORLD, message)
        world = read_world(given.text, given.source, given.directory, grid)
        self._given = given
        with self._changing:
            if world.revision != self.revision:
                planner = MotionPlanner(world, self._parameters)
                planner.prepare()
                self._planner = planner
        self._logger.info(_summary(world))
        return world.revision

    def _take_map(self, message: OccupancyGrid) -> None:
        """Plan with a new map from the next request on; without, when it cannot be used."""
        try:
            guarded(lambda: self._use_map(message), self._logger.error)
        except MotionPlannerError as error:
            refusal = f'the map on the topic is not used: {error.message}'
            self._logger.error(refusal)

    def _use_map(self, message: OccupancyGrid) -> None:
        grid = map_from_msg(message)
        with self._reading:
            before, self._grid = self._grid, grid
            if self._given is None or self._given.grid is not None:
                return
            try:
                self._read(self._given)
            except MotionPlannerError:
                self._grid = before
                raise

    def _set_world(
        self, request: srv.SetWorld.Request, response: srv.SetWorld.Response
    ) -> srv.SetWorld.Response:
        try:
            response.revision = guarded(
                lambda: self._use(
                    _Given(
                        request.yaml,
                        request.source,
                        request.directory,
                        map_of_request(request.map),
                    )
                ),
                self._logger.error,
            )
            response.accepted = True
        except MotionPlannerError as error:
            response.diagnostics = conversions.diagnostics_to_msg(
                diagnostics_of(error, request.source)
            )
        return response

    def _get_world(
        self, _request: srv.GetWorld.Request, response: srv.GetWorld.Response
    ) -> srv.GetWorld.Response:
        planner = self._planner
        if planner is not None:
            response.available = True
            response.world = conversions.world_to_msg(planner.world)
        return response


def _summary(world: World) -> str:
    grid = f', a map of {world.map.columns} x {world.map.rows} cells' if world.map else ''
    return (
        f'world {world.source or "without a name"}, revision {world.revision}: '
        f'{len(world.objects)} objects, {len(world.obstacles)} obstacles, '
        f'{len(world.robots)} robots{grid}'
    )


def diagnostics_of(error: MotionPlannerError, source: str) -> tuple[Diagnostic, ...]:
    """The remarks that came with ``error``, or one of its own."""
    remark = Diagnostic(error.message, source=source, code=error.code)
    return error.diagnostics or (remark,)


def _read_file(path: str) -> str:
    try:
        with Path(path).open('rb') as file:
            content = file.read(4 * LONGEST_TEXT + 4)
    except OSError as error:
        raise MotionPlannerError(Code.NO_WORLD, f'{path}: {error.strerror}') from error
    return content.decode('utf-8', errors='replace')
