"""The task planner as a ROS 2 node."""

from __future__ import annotations

import argparse
import sys
import threading
import time
import traceback
from collections import OrderedDict
from collections.abc import Callable, Sequence
from typing import TypeVar

import rclpy
from geohtn_msgs.action import PlanTasks
from geohtn_msgs.srv import Explain
from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args

from task_planner_node.conversions import (
    mission_text,
    progress_to_message,
    result_to_message,
    token_from_states,
)
from task_planner_node.errors import Diagnostic
from task_planner_node.explanation import FORMATS, written
from task_planner_node.language.functions import PluginError, load_plugins
from task_planner_node.motion_planner_client_node import MotionPlannerClient, RemoteOracle
from task_planner_node.outcomes import Options, Outcome, Progress, Result
from task_planner_node.parameters import (
    PARAMETERS,
    Parameters,
    read_guidance,
    read_parameters,
    read_time_budget,
)
from task_planner_node.planner import Planner
from task_planner_node.search.plans import Plan
from task_planner_node.search.repair import Interrupted
from task_planner_node.signals import StopSignals

T = TypeVar('T')
NAME = 'task_planner_node'
REMEMBERED = 10
HELP = f"""\
The HTN task planner of GeoHTN: plans missions whose operators carry geometric preconditions.

examples:
  ros2 run {NAME} {NAME}
  ros2 run {NAME} {NAME} --ros-args -r __ns:=/team1 -p time_budget:=120.0 --log-level debug

It serves the action plan_tasks and the service explain, and needs the services of the motion planner.
Parameters: {', '.join(parameter.name for parameter in PARAMETERS)} (docs/parameters.md)."""


class TaskPlannerNode(Node):
    """Plans missions on request, one at a time: a second goal waits until the first has ended.

    Action server: plan_tasks (geohtn_msgs/PlanTasks).
    Service server: explain (geohtn_msgs/Explain), for the last REMEMBERED missions.
    Service clients: satisfy_preconditions, advise, check_preconditions (of the motion planner).
    Parameters: PARAMETERS, changeable between missions.
    """

    def __init__(self, context: Context) -> None:
        super().__init__(NAME, context=context)
        for parameter in PARAMETERS:
            unit = f' [{parameter.unit}]' if parameter.unit else ''
            descriptor = ParameterDescriptor(
                description=parameter.description + unit, dynamic_typing=True
            )
            self.declare_parameter(parameter.name, parameter.default, descriptor)
        self._settings = read_parameters(
            {p.name: self.get_parameter(p.name).value for p in PARAMETERS}
        )
        self.add_on_set_parameters_callback(self._set_parameters)
        self.stopping = threading.Event()
        self._turn = threading.Lock()
        self._details: OrderedDict[str, str] = OrderedDict()
        self._plans: OrderedDict[str, Plan] = OrderedDict()
        self._motion_planner = MotionPlannerClient(context)
        group = ReentrantCallbackGroup()
        self._server = ActionServer(
            self,
            PlanTasks,
            'plan_tasks',
            execute_callback=self._execute,
            goal_callback=lambda _: GoalResponse.ACCEPT,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
            callback_group=group,
        )
        self.create_service(Explain, 'explain', self._explain, callback_group=group)

    def finish(self) -> None:
        """End the search that is running, and let none begin."""
        self.stopping.set()
        with self._turn:
            pass

    def close(self) -> None:
        """End the searches, then destroy everything."""
        self.finish()
        self._motion_planner.close()
        self._server.destroy()
        self.destroy_node()

    def _set_parameters(self, changes: list[Parameter]) -> SetParametersResult:
        values = {p.name: getattr(self._settings, p.name) for p in PARAMETERS}
        values.update({change.name: change.value for change in changes})
        try:
            self._settings = read_parameters(values)
        except ValueError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _execute(self, goal: ServerGoalHandle) -> PlanTasks.Result:
        def should_stop() -> bool:
            return bool(goal.is_cancel_requested) or self.stopping.is_set()

        while not self._turn.acquire(timeout=0.05):
            if should_stop():
                return self._finish(goal, Result(Outcome.CANCELLED, 'cancelled while it waited'))
        try:
            try:
                result = self._plan(goal, should_stop)
            except Exception as error:
                # An empty result would read as SOLVED.
                self.get_logger().error(traceback.format_exc())
                result = Result(
                    Outcome.FAILED, f'a fault of the task planner, please report: {error!r}'
                )
            return self._finish(goal, result)
        finally:
            self._turn.release()

    def _plan(self, goal: ServerGoalHandle, should_stop: Callable[[], bool]) -> Result:
        request = goal.request
        parameters = self._settings
        try:
            options = _options(request, parameters)
        except ValueError as error:
            return Result(Outcome.INVALID, str(error), (Diagnostic(str(error)),))

        def report(progress: Progress) -> None:
            goal.publish_feedback(PlanTasks.Feedback(progress=progress_to_message(progress)))

        oracle = RemoteOracle(
            self._motion_planner,
            parameters,
            request.mission,
            request.world_revision,
            request.options.seed,
            time.monotonic() + options.time_budget,
            should_stop,
        )
        interrupted = None
        if request.resumes:
            plan = self._plans.get(request.resumes)
            if plan is None:
                message = (
                    f'no plan of a mission {request.resumes} to go on with: the node remembers the last '
                    f'{REMEMBERED} missions that it solved'
                )
                return Result(Outcome.INVALID, message, (Diagnostic(message),))
            interrupted = Interrupted(plan, request.executed)
        planner = Planner(oracle, options, should_stop, report)
        result = planner.plan(
            mission_text(request.domain),
            mission_text(request.problem),
            token_from_states(request.start),
            interrupted,
        )
        if result.plans:
            _remember(self._plans, request.mission, result.plans[0])
        return result

    def _finish(self, goal: ServerGoalHandle, result: Result) -> PlanTasks.Result:
        mission = goal.request.mission
        _remember(self._details, mission, result.details or result.explanation)
        self.get_logger().info(f'mission {mission}: {result.outcome.name}: {result.explanation}')
        if goal.is_cancel_requested:
            goal.canceled()
        elif result.outcome == Outcome.SOLVED:
            goal.succeed()
        else:
            goal.abort()
        return result_to_message(result)

    def _explain(self, request: Explain.Request, response: Explain.Response) -> Explain.Response:
        mission = request.mission or next(reversed(self._details), '')
        plan = self._plans.get(mission)
        if not request.format:
            response.available = mission in self._details
            response.text = self._details.get(mission, '')
        elif plan is not None and request.format in FORMATS:
            response.available = True
            response.text = written(plan.tree, request.format)
        return response


def _remember(memory: OrderedDict[str, T], mission: str, value: T) -> None:
    memory.pop(mission, None)
    memory[mission] = value
    while len(memory) > REMEMBERED:
        memory.popitem(last=False)


def _options(request: PlanTasks.Goal, parameters: Parameters) -> Options:
    wanted = request.options
    return Options(
        read_time_budget(wanted.time_budget) or parameters.time_budget,
        wanted.max_alternatives or parameters.max_alternatives,
        parameters.max_depth,
        wanted.optimise,
        wanted.use_advice,
        wanted.plans or 1,
        parameters.memory_limit,
        read_guidance(wanted.guidance or parameters.guidance),
    )


def run(arguments: Sequence[str], signals: StopSignals) -> int:
    """Run the node until a signal comes; 0 then, 1 when it ends by itself, 2 when it was started wrongly."""
    parser = argparse.ArgumentParser(
        prog=NAME, description=HELP, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    try:
        own = remove_ros_args(arguments)[1:]
    except RuntimeError as error:
        return _refuse(f'wrong ROS arguments: {error}')
    parser.parse_args(own)
    context = Context()
    try:
        rclpy.init(args=arguments, context=context, signal_handler_options=SignalHandlerOptions.NO)
    except RuntimeError as error:
        return _refuse(f'ROS does not start: {error}')
    try:
        with signals.interrupting():
            load_plugins()
        node = TaskPlannerNode(context)
    except KeyboardInterrupt:
        return 0
    except (PluginError, ValueError) as error:
        return _refuse(error)
    else:
        return _serve(node, signals)
    finally:
        rclpy.shutdown(context=context)


def _serve(node: TaskPlannerNode, signals: StopSignals) -> int:
    executor = MultiThreadedExecutor(num_threads=4, context=node.context)
    executor.add_node(node)

    stopped = threading.Event()

    def spin() -> None:
        while not stopped.is_set():
            executor.spin_once(timeout_sec=0.5)

    thread = threading.Thread(target=spin)
    thread.start()
    try:
        node.get_logger().info('ready')
        return signals.exit_code(thread.is_alive)
    finally:
        node.finish()
        stopped.set()
        executor.wake()
        thread.join()
        executor.shutdown(timeout_sec=2.0)
        node.close()


def _refuse(reason: object) -> int:
    print(f'{NAME}: {reason}', file=sys.stderr)
    return 2
