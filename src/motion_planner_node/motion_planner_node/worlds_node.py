"""The world that the node plans in: `set_world`, `get_world` and what stands in a file."""

from __future__ import annotations

from pathlib import Path
from threading import Lock

from geohtn_msgs import srv
from rclpy.callback_groups import CallbackGroup
from rclpy.node import Node

from motion_planner_node import conversions
from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic, MotionPlannerError, guarded
from motion_planner_node.parameters import Parameters
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.world import read_world
from motion_planner_node.world.syntax import LONGEST_TEXT


class Worlds:
    """Holds the planner of one world at a time.

    A request asks once for `current` and stays with that planner, whatever is set meanwhile.
    """

    def __init__(self, node: Node, parameters: Parameters) -> None:
        self._logger = node.get_logger()
        self._parameters = parameters
        self._planner: MotionPlanner | None = None
        self._changing = Lock()
        if parameters.world:
            self._use(_read_file(parameters.world), parameters.world)

    def serve(self, node: Node, slow: CallbackGroup, quick: CallbackGroup) -> None:
        """Offer the services: reading a world is ``slow``, telling it is ``quick``."""
        node.create_service(srv.SetWorld, 'set_world', self._set_world, callback_group=slow)
        node.create_service(srv.GetWorld, 'get_world', self._get_world, callback_group=quick)

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

    def _use(self, text: str, source: str) -> str:
        """Read a world and hold it; everything that depends on no request is worked out now."""
        world = read_world(text, source)
        with self._changing:
            if world.revision != self.revision:
                planner = MotionPlanner(world, self._parameters)
                planner.prepare()
                self._planner = planner
        self._logger.info(
            f'world {source or "without a name"}, revision {world.revision}: '
            f'{len(world.objects)} objects, {len(world.obstacles)} obstacles, '
            f'{len(world.robots)} robots'
        )
        return world.revision

    def _set_world(
        self, request: srv.SetWorld.Request, response: srv.SetWorld.Response
    ) -> srv.SetWorld.Response:
        try:
            response.revision = guarded(
                lambda: self._use(request.yaml, request.source), self._logger.error
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
