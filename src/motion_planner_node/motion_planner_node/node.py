"""The ROS 2 face of the motion planner: services in front of `planner.MotionPlanner`."""

from __future__ import annotations

import sys
import threading
import traceback
from collections.abc import Callable
from pathlib import Path
from time import perf_counter
from typing import TypeVar

import rclpy
from geohtn_msgs import msg, srv
from rcl_interfaces.msg import SetParametersResult
from rclpy.exceptions import InvalidParameterValueException
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args

from motion_planner_node import conversions
from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic, MotionPlannerError, Stopped
from motion_planner_node.functions import PluginError, load_plugins
from motion_planner_node.parameters import (
    ParameterError,
    Parameters,
    read_parameters,
    specifications,
)
from motion_planner_node.planner import MotionPlanner, warm_up
from motion_planner_node.planning.answers import refused
from motion_planner_node.planning.check import check_text
from motion_planner_node.requests import GeometricAnswer
from motion_planner_node.signals import interrupt_on_signals
from motion_planner_node.world import read_world
from motion_planner_node.world.syntax import LONGEST_TEXT

USAGE = """\
usage: motion_planner_node [--help] [--ros-args ...]

GeoHTN's motion planner: finds attitudes that meet geometric preconditions, and the way there.
It waits for a world (service set_world) and then answers satisfy_preconditions and advise.

examples:
  ros2 run motion_planner_node motion_planner_node
  ros2 run motion_planner_node motion_planner_node --ros-args -p world:=world.yaml
  ros2 run motion_planner_node motion_planner_node --ros-args -r __ns:=/team_a --log-level debug
"""
#: Exchanges that a slow subscriber of planning_events may lag behind.
EVENTS_KEPT = 1000

Result = TypeVar('Result')


class MotionPlannerNode(Node):
    """Answers geometric requests; stateless but for its world.

    Parameters
        the table in `parameters.py` (docs/parameters.md)
    Publishers
        ``planning_events`` (geohtn_msgs/PlanningEvent): each exchange, in the order answered
    Services
        ``satisfy_preconditions``, ``advise``, ``check_preconditions``, ``set_world``, ``get_world``

    All services share one thread.  Solving holds Python's interpreter lock, so a second thread
    would not answer sooner, and it makes every exchange slower (1.1 ms against 0.4 ms); requests
    take milliseconds and have a deadline.  Who needs more at once starts replicas of the node.

    :raises ParameterError: when a parameter has a wrong value
    :raises MotionPlannerError: when the world named by the parameter ``world`` cannot be used
    """

    def __init__(self, **options: object) -> None:
        super().__init__('motion_planner_node', **options)
        self._planner: MotionPlanner | None = None
        self.stopping = threading.Event()
        try:
            self._prepare()
        except BaseException:
            self.destroy_node()
            raise

    def _prepare(self) -> None:
        self._settings = self._declare()
        self._events = self.create_publisher(
            msg.PlanningEvent,
            'planning_events',
            QoSProfile(depth=EVENTS_KEPT, reliability=ReliabilityPolicy.RELIABLE),
        )
        if self._settings.world:
            self._use_world(_read_file(self._settings.world), self._settings.world)
        warm_up()
        self.create_service(srv.SatisfyPreconditions, 'satisfy_preconditions', self._satisfy)
        self.create_service(srv.Advise, 'advise', self._advise)
        self.create_service(srv.CheckPreconditions, 'check_preconditions', self._check)
        self.create_service(srv.SetWorld, 'set_world', self._set_world)
        self.create_service(srv.GetWorld, 'get_world', self._get_world)

    # ---- parameters

    def _declare(self) -> Parameters:
        table = specifications()
        self.add_on_set_parameters_callback(self._check_parameters)
        try:
            for row in table:
                self.declare_parameter(row.name, row.default, conversions.descriptor_of(row))
        except InvalidParameterValueException as error:
            raise ParameterError(str(error)) from error
        self.add_post_set_parameters_callback(self._adopt_parameters)
        return read_parameters({row.name: self.get_parameter(row.name).value for row in table})

    def _check_parameters(self, changed: list[Parameter]) -> SetParametersResult:
        own = {row.name: row for row in specifications()}
        try:
            for parameter in changed:
                if parameter.name in own:
                    own[parameter.name].accept(parameter.value)
        except ParameterError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _adopt_parameters(self, _changed: list[Parameter]) -> None:
        names = [row.name for row in specifications()]
        self._settings = read_parameters({name: self.get_parameter(name).value for name in names})
        if self._planner is not None:
            self._planner = MotionPlanner(self._planner.world, self._settings)

    # ---- services

    def _satisfy(
        self, request: srv.SatisfyPreconditions.Request, response: srv.SatisfyPreconditions.Response
    ) -> srv.SatisfyPreconditions.Response:
        received, started = self.get_clock().now(), perf_counter()
        asked = request.request
        try:
            pure = conversions.request_from_msg(asked)
            stop = self._deadline(started, pure.time_budget)
            answer = self._guarded(lambda: self._current().satisfy(pure, stop))
        except MotionPlannerError as error:
            answer = refused(error, self._revision)
        response.answer = conversions.answer_to_msg(answer, asked, perf_counter() - started)
        self._events.publish(
            msg.PlanningEvent(
                kind=msg.PlanningEvent.REQUEST,
                received=received.to_msg(),
                answered=self.get_clock().now().to_msg(),
                request=[asked],
                answer=[response.answer],
            )
        )
        self._log_answer(asked, answer)
        return response

    def _advise(
        self, request: srv.Advise.Request, response: srv.Advise.Response
    ) -> srv.Advise.Response:
        received, started = self.get_clock().now(), perf_counter()
        asked = request.request
        try:
            pure = conversions.advice_request_from_msg(asked)
            stop = self._deadline(started, 0.0)
            advice = self._guarded(lambda: self._current().advise(pure, stop))
            response.answer = conversions.advice_to_msg(advice, asked, perf_counter() - started)
        except MotionPlannerError as error:
            response.answer = conversions.advice_error_to_msg(
                error, asked, self._revision, perf_counter() - started
            )
        self._events.publish(
            msg.PlanningEvent(
                kind=msg.PlanningEvent.ADVICE,
                received=received.to_msg(),
                answered=self.get_clock().now().to_msg(),
                advice_request=[asked],
                advice_answer=[response.answer],
            )
        )
        return response

    def _check(
        self, request: srv.CheckPreconditions.Request, response: srv.CheckPreconditions.Response
    ) -> srv.CheckPreconditions.Response:
        world = self._planner.world if self._planner else None
        try:
            result = self._guarded(
                lambda: check_text(
                    request.preconditions, world, request.source, request.line, request.column
                )
            )
            response.valid, response.assigns = result.valid, result.assigns
            diagnostics = result.diagnostics
        except MotionPlannerError as error:
            diagnostics = _diagnostics_of(error, request.source)
        response.diagnostics = conversions.diagnostics_to_msg(diagnostics)
        return response

    def _set_world(
        self, request: srv.SetWorld.Request, response: srv.SetWorld.Response
    ) -> srv.SetWorld.Response:
        try:
            response.revision = self._guarded(lambda: self._use_world(request.yaml, request.source))
            response.accepted = True
        except MotionPlannerError as error:
            response.diagnostics = conversions.diagnostics_to_msg(
                _diagnostics_of(error, request.source)
            )
        return response

    def _get_world(
        self, _request: srv.GetWorld.Request, response: srv.GetWorld.Response
    ) -> srv.GetWorld.Response:
        if self._planner is not None:
            response.available = True
            response.world = conversions.world_to_msg(self._planner.world)
        return response

    # ---- what the services share

    @property
    def _revision(self) -> str:
        return self._planner.world.revision if self._planner else ''

    def _current(self) -> MotionPlanner:
        if self._planner is None:
            raise MotionPlannerError(
                Code.NO_WORLD, 'the motion planner has no world yet: call set_world first'
            )
        return self._planner

    def _use_world(self, text: str, source: str) -> str:
        world = read_world(text, source)
        if world.revision != self._revision:
            self._planner = MotionPlanner(world, self._settings)
        self.get_logger().info(
            f'world {source or "without a name"}, revision {world.revision}: '
            f'{len(world.objects)} objects, {len(world.obstacles)} obstacles, '
            f'{len(world.robots)} robots'
        )
        return world.revision

    def _deadline(self, started: float, budget: float) -> Callable[[], bool]:
        end = started + (budget or self._settings.time_budget)
        return lambda: perf_counter() > end or self.stopping.is_set()

    def _guarded(self, work: Callable[[], Result]) -> Result:
        """Do ``work``; whatever goes wrong becomes a MotionPlannerError, so the node outlives it."""
        try:
            return work()
        except MotionPlannerError:
            raise
        except Stopped as stopped:
            raise MotionPlannerError(Code.OUT_OF_TIME, 'the time budget ran out') from stopped
        except Exception as error:
            self.get_logger().error(traceback.format_exc())
            raise MotionPlannerError(
                Code.INTERNAL,
                f'a fault of the motion planner, please report it with its log: '
                f'{type(error).__name__}: {error}',
            ) from error

    def _log_answer(self, asked: msg.GeometricRequest, answer: GeometricAnswer) -> None:
        self.get_logger().debug(
            f'{" ".join(asked.action)} alternative {asked.alternative}: {answer.status.name} '
            f'{answer.code.name} {answer.message}'
        )


def _diagnostics_of(error: MotionPlannerError, source: str) -> tuple[Diagnostic, ...]:
    remark = Diagnostic(error.message, source=source, code=error.code)
    return error.diagnostics or (remark,)


def _read_file(path: str) -> str:
    try:
        with Path(path).open('rb') as file:
            content = file.read(4 * LONGEST_TEXT + 4)
    except OSError as error:
        raise MotionPlannerError(Code.NO_WORLD, f'{path}: {error.strerror}') from error
    return content.decode('utf-8', errors='replace')


def main(arguments: list[str] | None = None) -> int:
    """Run the node until it is told to stop; 0 then, 2 when it was started wrongly."""
    arguments = sys.argv if arguments is None else arguments
    try:
        own = remove_ros_args(arguments)[1:]
        if own:
            return _usage(own)
        rclpy.init(args=arguments, signal_handler_options=SignalHandlerOptions.NO)
    except RuntimeError as error:  # how rcl refuses its arguments
        return _refuse(error)
    interrupt_on_signals()
    try:
        load_plugins()
        _serve()
    except KeyboardInterrupt:
        pass
    except (ParameterError, PluginError, MotionPlannerError) as error:
        return _refuse(error)
    finally:
        rclpy.shutdown()
    return 0


def _serve() -> None:
    node = MotionPlannerNode()
    executor = SingleThreadedExecutor()
    executor.add_node(node)

    def spin() -> None:
        while not node.stopping.is_set():
            executor.spin_once(timeout_sec=0.5)

    spinning = threading.Thread(target=spin)
    try:
        spinning.start()
        node.get_logger().info('ready')
        while spinning.is_alive():
            node.stopping.wait(0.5)
    finally:
        node.stopping.set()
        executor.wake()
        spinning.join()
        executor.shutdown()
        node.destroy_node()


def _usage(arguments: list[str]) -> int:
    if arguments[0] in {'--help', '-h'}:
        print(USAGE, end='')
        return 0
    print(f'motion_planner_node: unknown argument {arguments[0]}\n\n{USAGE}', file=sys.stderr)
    return 2


def _refuse(error: Exception) -> int:
    print(f'motion_planner_node: {error}', file=sys.stderr)
    return 2


if __name__ == '__main__':
    sys.exit(main())
