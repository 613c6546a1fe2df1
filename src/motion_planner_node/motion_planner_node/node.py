"""The ROS 2 face of the motion planner: services in front of `planner.MotionPlanner`."""

from __future__ import annotations

import gc
import sys
import threading
from time import perf_counter

import rclpy
from geohtn_msgs import msg, srv
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from rclpy.time import Time
from rclpy.utilities import remove_ros_args

from motion_planner_node import conversions
from motion_planner_node.advice.purposes import shares_of_budget
from motion_planner_node.errors import MotionPlannerError, guarded
from motion_planner_node.executor_node import AtMost, RelayExecutor
from motion_planner_node.functions import PluginError, load_plugins
from motion_planner_node.motion_conversions import motion_from_msg, path_to_msg
from motion_planner_node.parameters import ParameterError, Parameters
from motion_planner_node.planner import warm_up
from motion_planner_node.planning.answers import as_cancelled, refused
from motion_planner_node.planning.check import check_text
from motion_planner_node.planning.sampled import sampled
from motion_planner_node.requests import AdviceAnswer, GeometricAnswer
from motion_planner_node.settings_node import Settings
from motion_planner_node.signals import StopSignals
from motion_planner_node.turns import Turns
from motion_planner_node.worlds_node import Worlds, diagnostics_of

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
#: Requests that may wait or run at a time; so many more wait in the middleware.
MOST_WAITING, MOST_UNREAD = 16, 1000
#: One for each of these, for each group of other callbacks, and one to wait for messages.
THREADS = MOST_WAITING + 5


class MotionPlannerNode(Node):
    """Answers geometric requests; stateless but for its world.

    Parameters
        the table in `parameters.py` (docs/parameters.md)
    Publishers
        ``planning_events`` (geohtn_msgs/PlanningEvent): each exchange, in the order answered, while
        somebody listens
    Services
        ``satisfy_preconditions``, ``advise``, ``cancel_request``, ``check_preconditions``,
        ``sample_motion``, ``set_world``, ``get_world``

    Requests are worked on one at a time, in the order in which they come: solving takes all that a
    core has, so two at a time would only both be slower.  Who needs more at once starts replicas of
    the node.  All else is answered meanwhile, and a request stays with the world that it began with.

    :raises ParameterError: when a parameter has a wrong value
    :raises MotionPlannerError: when the world named by the parameter ``world`` cannot be used
    """

    def __init__(self, **options: object) -> None:
        super().__init__('motion_planner_node', **options)
        self.stopping = threading.Event()
        self._turns = Turns()
        try:
            self._prepare()
        except BaseException:
            self.destroy_node()
            raise

    def _prepare(self) -> None:
        self._settings = Settings(self, self._adopt)
        self._events = self.create_publisher(
            msg.PlanningEvent,
            'planning_events',
            QoSProfile(depth=EVENTS_KEPT, reliability=ReliabilityPolicy.RELIABLE),
        )
        warm_up()
        self._worlds = Worlds(self, self._settings.current)
        requests, quick = AtMost(MOST_WAITING), MutuallyExclusiveCallbackGroup()
        unread = QoSProfile(depth=MOST_UNREAD, reliability=ReliabilityPolicy.RELIABLE)
        for kind, name, answer, group in (
            (srv.SatisfyPreconditions, 'satisfy_preconditions', self._satisfy, requests),
            (srv.Advise, 'advise', self._advise, requests),
            (srv.CancelRequest, 'cancel_request', self._cancel, MutuallyExclusiveCallbackGroup()),
            (srv.CheckPreconditions, 'check_preconditions', self._check, quick),
            (srv.SampleMotion, 'sample_motion', self._sample, quick),
        ):
            self.create_service(kind, name, answer, qos_profile=unread, callback_group=group)
        self._worlds.serve(self, MutuallyExclusiveCallbackGroup(), quick)

    def _adopt(self, parameters: Parameters) -> None:
        self._worlds.adopt(parameters)

    def finish(self) -> None:
        """Break off all requests, and take no more."""
        self.stopping.set()
        self._turns.close()

    # ---- services

    def _satisfy(
        self, request: srv.SatisfyPreconditions.Request, response: srv.SatisfyPreconditions.Response
    ) -> srv.SatisfyPreconditions.Response:
        received, started = self.get_clock().now(), perf_counter()
        asked = request.request
        try:
            answer = self._answer(asked)
        except MotionPlannerError as error:
            answer = refused(error, self._worlds.revision)
        response.answer = conversions.answer_to_msg(answer, asked, perf_counter() - started)
        self._tell(msg.PlanningEvent.REQUEST, received, request=[asked], answer=[response.answer])
        self._log_answer(asked, answer)
        return response

    def _advise(
        self, request: srv.Advise.Request, response: srv.Advise.Response
    ) -> srv.Advise.Response:
        received, started = self.get_clock().now(), perf_counter()
        asked = request.request
        try:
            advice = self._advice(asked)
            response.answer = conversions.advice_to_msg(advice, asked, perf_counter() - started)
        except MotionPlannerError as error:
            response.answer = conversions.advice_error_to_msg(
                error, asked, self._worlds.revision, perf_counter() - started
            )
        self._tell(
            msg.PlanningEvent.ADVICE,
            received,
            advice_request=[asked],
            advice_answer=[response.answer],
        )
        return response

    def _tell(self, kind: int, received: Time, **exchange: object) -> None:
        """Publish an exchange, if anybody listens: making the event takes time in which the answer waits."""
        if self._events.get_subscription_count():
            answered = self.get_clock().now().to_msg()
            self._events.publish(
                msg.PlanningEvent(
                    kind=kind, received=received.to_msg(), answered=answered, **exchange
                )
            )

    def _answer(self, asked: msg.GeometricRequest) -> GeometricAnswer:
        planner = self._worlds.current()
        request = conversions.request_from_msg(asked)
        with self._turns.take(asked.request_id, self._budget(request.time_budget)) as turn:
            answer = guarded(lambda: planner.satisfy(request, turn), self.get_logger().error)
        return as_cancelled(answer) if turn.cancelled else answer

    def _advice(self, asked: msg.AdviceRequest) -> AdviceAnswer:
        planner = self._worlds.current()
        request = conversions.advice_request_from_msg(asked)
        budget = self._budget(0.0) * shares_of_budget(request)
        with self._turns.take(asked.request_id, budget) as turn:
            return guarded(lambda: planner.advise(request, turn), self.get_logger().error)

    def _cancel(
        self, request: srv.CancelRequest.Request, response: srv.CancelRequest.Response
    ) -> srv.CancelRequest.Response:
        response.cancelled = self._turns.cancel(request.request_id)
        return response

    def _check(
        self, request: srv.CheckPreconditions.Request, response: srv.CheckPreconditions.Response
    ) -> srv.CheckPreconditions.Response:
        planner = self._worlds.planner
        world = planner.world if planner else None
        try:
            result = guarded(
                lambda: check_text(
                    request.preconditions, world, request.source, request.line, request.column
                ),
                self.get_logger().error,
            )
            response.valid, response.assigns = result.valid, result.assigns
            diagnostics = result.diagnostics
        except MotionPlannerError as error:
            diagnostics = diagnostics_of(error, request.source)
        response.diagnostics = conversions.diagnostics_to_msg(diagnostics)
        return response

    def _sample(
        self, request: srv.SampleMotion.Request, response: srv.SampleMotion.Response
    ) -> srv.SampleMotion.Response:
        try:
            world = self._worlds.current().world
            motion = motion_from_msg(request.motion)
            rows = guarded(
                lambda: sampled(world, motion, request.world_revision, request.spacing),
                self.get_logger().error,
            )
            response.path = path_to_msg(rows)
        except MotionPlannerError as error:
            response.code, response.message = int(error.code), error.message
        return response

    def _budget(self, wanted: float) -> float:
        return wanted or self._settings.current.time_budget

    def _log_answer(self, asked: msg.GeometricRequest, answer: GeometricAnswer) -> None:
        self.get_logger().debug(
            f'{" ".join(asked.action)} alternative {asked.alternative}: {answer.status.name} '
            f'{answer.code.name} {answer.message}'
        )


def run(arguments: list[str], signals: StopSignals) -> int:
    """Run the node until a signal comes; 0 then, 1 when it ends by itself, 2 when it was started wrongly."""
    try:
        own = remove_ros_args(arguments)[1:]
    except RuntimeError as error:
        return _refuse(f'wrong ROS arguments: {error}')
    if own:
        return _usage(own)
    try:
        rclpy.init(args=arguments, signal_handler_options=SignalHandlerOptions.NO)
    except RuntimeError as error:
        return _refuse(f'ROS does not start: {error}')
    try:
        with signals.interrupting():
            load_plugins()
            node = MotionPlannerNode()
    except KeyboardInterrupt:
        return 0
    except (ParameterError, PluginError, MotionPlannerError) as error:
        return _refuse(error)
    else:
        return _serve(node, signals)
    finally:
        rclpy.shutdown()


def _serve(node: MotionPlannerNode, signals: StopSignals) -> int:
    executor = RelayExecutor()
    executor.add_node(node)
    # What is there by now stays: to look at it again and again takes a tenth of a second each time.
    gc.collect()
    gc.freeze()

    def spin() -> None:
        while not node.stopping.is_set():
            executor.spin_once(timeout_sec=0.5)

    spinning = [threading.Thread(target=spin) for _ in range(THREADS)]
    try:
        for thread in spinning:
            thread.start()
        node.get_logger().info('ready')
        return signals.exit_code(lambda: all(thread.is_alive() for thread in spinning))
    finally:
        node.finish()
        executor.wake()
        for thread in spinning:
            if thread.ident is not None:
                thread.join()
        executor.shutdown()
        node.destroy_node()


def _usage(arguments: list[str]) -> int:
    if arguments[0] in {'--help', '-h'}:
        print(USAGE, end='')
        return 0
    print(f'motion_planner_node: unknown argument {arguments[0]}\n\n{USAGE}', file=sys.stderr)
    return 2


def _refuse(reason: object) -> int:
    print(f'motion_planner_node: {reason}', file=sys.stderr)
    return 2
