"""The ROS 2 face of the interface: the action `plan_mission` and the topics people look at."""

from __future__ import annotations

import sys
import threading
import traceback
import uuid

import rclpy
from builtin_interfaces.msg import Time
from geohtn_msgs.action import PlanMission
from geohtn_msgs.msg import GlobalPlan, Outcome, PlanningEvent, PlanningProgress
from nav_msgs.msg import OccupancyGrid, Path
from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args
from visualization_msgs.msg import MarkerArray

from interface_node.display_conversions import map_message, marker_array, path_message
from interface_node.mission_node import Mission, Surroundings
from interface_node.outputs_node import Outputs
from interface_node.parameters import PARAMETERS, Parameters, checked, table
from interface_node.peers_node import Peers
from interface_node.plan import Plan
from interface_node.signals import StopSignals

USAGE = f"""\
usage: interface_node [--help] [--ros-args ...]

GeoHTN's interface: takes missions (action plan_mission), has them planned by
task_planner_node and motion_planner_node, and publishes, draws and records the global plan.

examples:
  ros2 run interface_node interface_node
  ros2 run interface_node interface_node --ros-args -p map_resolution:=0.5
  ros2 run interface_node interface_node --ros-args -r __ns:=/team_a --log-level debug

parameters:
{table()}"""
#: Events that may wait to be recorded while the machine is busy.
EVENTS_KEPT = 1000


class InterfaceNode(Node):
    """Takes one mission at a time; another one is rejected until it has ended.

    Parameters
        the table in `parameters.py` (docs/parameters.md)
    Publishers, all latched
        ``global_plan`` (geohtn_msgs/GlobalPlan), ``path`` (nav_msgs/Path),
        ``map`` (nav_msgs/OccupancyGrid), ``markers`` (visualization_msgs/MarkerArray)
    Subscriptions
        ``planning_events`` (geohtn_msgs/PlanningEvent), recorded while a mission runs
    Actions
        ``plan_mission`` (geohtn_msgs/PlanMission)
    Clients
        ``set_world``, ``get_world`` of the motion planner, ``plan_tasks`` of the task planner

    Raises ValueError with a sentence when a parameter has a wrong value.
    """

    def __init__(self, **options: object) -> None:
        super().__init__('interface_node', **options)
        self._settings = self._declare()
        self._peers = Peers(self)
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self._publish_plan = self.create_publisher(GlobalPlan, 'global_plan', latched).publish
        self._publish_path = self.create_publisher(Path, 'path', latched).publish
        self._publish_map = self.create_publisher(OccupancyGrid, 'map', latched).publish
        self._publish_markers = self.create_publisher(MarkerArray, 'markers', latched).publish
        self._busy = threading.Lock()
        self._stopping = threading.Event()
        self._outputs: Outputs | None = None
        self.create_subscription(
            PlanningEvent,
            'planning_events',
            self._record_event,
            QoSProfile(depth=EVENTS_KEPT, reliability=ReliabilityPolicy.RELIABLE),
            callback_group=MutuallyExclusiveCallbackGroup(),
            raw=True,
        )
        self._server = ActionServer(
            self,
            PlanMission,
            'plan_mission',
            self._execute,
            goal_callback=self._accept,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
            callback_group=ReentrantCallbackGroup(),
        )

    def finish(self, patience: float) -> None:
        """Cancel the mission that is being planned, and wait at most ``patience`` [s] for its end."""
        self._stopping.set()
        if self._busy.acquire(timeout=patience):
            self._busy.release()

    def destroy_node(self) -> None:
        """Close the action's server as well."""
        self._server.destroy()
        super().destroy_node()

    # ---- parameters

    def _declare(self) -> Parameters:
        values = {
            spec.name: self.declare_parameter(
                spec.name,
                spec.default,
                ParameterDescriptor(
                    description=spec.description,
                    additional_constraints=spec.range_text,
                    dynamic_typing=True,
                ),
            ).value
            for spec in PARAMETERS
        }
        self.add_on_set_parameters_callback(self._check_parameters)
        self.add_post_set_parameters_callback(self._adopt_parameters)
        return checked(values)

    def _check_parameters(self, changed: list[Parameter]) -> SetParametersResult:
        try:
            checked({parameter.name: parameter.value for parameter in changed})
        except ValueError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _adopt_parameters(self, _changed: list[Parameter]) -> None:
        self._settings = checked(
            {spec.name: self.get_parameter(spec.name).value for spec in PARAMETERS}
        )

    # ---- missions

    def _accept(self, goal: PlanMission.Goal) -> GoalResponse:
        if not self._busy.acquire(blocking=False):
            self.get_logger().warning(
                f'mission {goal.mission!r} is rejected: another one is being planned'
            )
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def _execute(self, handle: ServerGoalHandle) -> PlanMission.Result:
        try:
            result = self._run(handle)
        except Exception:  # the node outlives any mission
            self.get_logger().error(traceback.format_exc())
            result = PlanMission.Result(
                outcome=Outcome(
                    value=Outcome.FAILED,
                    explanation='a fault of the interface, please report it with its log: '
                    + traceback.format_exc(limit=0).strip(),
                )
            )
        finally:
            self._outputs = None
            self._busy.release()
        if result.outcome.value == Outcome.CANCELLED and handle.is_cancel_requested:
            handle.canceled()
        elif result.outcome.value == Outcome.SOLVED:
            handle.succeed()
        else:
            handle.abort()
        return result

    def _run(self, handle: ServerGoalHandle) -> PlanMission.Result:
        goal = handle.request
        mission_id = f'{goal.mission or "mission"}-{uuid.UUID(bytes=bytes(handle.goal_id.uuid))}'
        self.get_logger().info(f'mission {mission_id}')
        parameters = self._settings
        outputs = Outputs(goal.output_directory or parameters.output_directory, mission_id)
        self._outputs = outputs
        for remark in outputs.trouble:
            self.get_logger().warning(f'mission {mission_id}: {remark}')
        try:
            result = Mission(
                goal,
                mission_id,
                outputs,
                Surroundings(
                    peers=self._peers,
                    parameters=parameters,
                    now=lambda: self.get_clock().now().to_msg(),
                    report=lambda progress: self._report(handle, progress),
                    show=self._show,
                    should_stop=lambda: handle.is_cancel_requested or self._stopping.is_set(),
                ),
            ).run()
        finally:
            outputs.abandon()
        explanation = result.outcome.explanation or 'planned'
        self.get_logger().info(f'mission {mission_id}: {explanation}')
        return result

    def _report(self, handle: ServerGoalHandle, progress: PlanningProgress) -> None:
        if handle.is_active:
            handle.publish_feedback(PlanMission.Feedback(progress=progress))

    def _show(self, plan: Plan, message: GlobalPlan | None, stamp: Time) -> dict[str, object]:
        """Publish what there is to see; give it by the topic that it is recorded under."""
        shown: dict[str, object] = {}
        spacing = self._settings.path_spacing
        if plan.world and message is None:
            shown['/map'] = map_message(plan.world, self._settings.map_resolution, stamp)
            self._publish_map(shown['/map'])
        shown['/markers'] = marker_array(plan, spacing, stamp)
        self._publish_markers(shown['/markers'])
        shown['/path'] = path_message(plan, spacing, stamp)
        self._publish_path(shown['/path'])
        if message is not None:
            shown['/global_plan'] = message
            self._publish_plan(message)
        return shown

    def _record_event(self, data: bytes) -> None:
        outputs = self._outputs
        if outputs:
            outputs.record_event(data)


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
        node = InterfaceNode()
    except ValueError as error:
        return _refuse(error)
    else:
        return _serve(node, signals)
    finally:
        rclpy.shutdown()


def _serve(node: InterfaceNode, signals: StopSignals) -> int:
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    stopped = threading.Event()

    def spin() -> None:
        while not stopped.is_set():
            executor.spin_once(timeout_sec=0.5)

    spinning = threading.Thread(target=spin)
    spinning.start()
    try:
        node.get_logger().info('ready')
        return signals.exit_code(spinning.is_alive)
    finally:
        node.finish(2.0)
        stopped.set()
        executor.wake()
        spinning.join()
        executor.shutdown(timeout_sec=2.0)
        node.destroy_node()


def _usage(arguments: list[str]) -> int:
    if arguments[0] in {'--help', '-h'}:
        print(USAGE, end='')
        return 0
    print(f'interface_node: unknown argument {arguments[0]}\n\n{USAGE}', file=sys.stderr)
    return 2


def _refuse(reason: object) -> int:
    print(f'interface_node: {reason}', file=sys.stderr)
    return 2
