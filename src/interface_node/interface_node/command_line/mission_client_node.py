"""Client of the three nodes: which of them answer, and missions through ``plan_mission``."""

from __future__ import annotations

import os
from threading import Event
from types import TracebackType
from typing import Any

import rclpy
from geohtn_msgs.action import PlanMission
from geohtn_msgs.msg import PlanningOptions, SourceText
from geohtn_msgs.srv import Explain, SatisfyPreconditions
from rclpy.context import Context
from rclpy.signals import SignalHandlerOptions

from interface_node.background_node import BackgroundExecutor
from interface_node.command_line.goals import MissionGoal
from interface_node.command_line.missions import Source
from interface_node.command_line.results import MissionResult, Progress
from interface_node.conversions import plan_from_messages
from interface_node.goal_client_node import GoalClient


class MissionClient:
    """Context manager; plans one mission at a time with the nodes of one namespace.

    Messages are handled in a thread of its own, so no method blocks except :meth:`wait`.

    Action clients: ``plan_mission``.
    Service clients, only to see whether their nodes are there: ``explain``,
    ``satisfy_preconditions``.
    """

    def __init__(self, namespace: str):
        self.progress = Progress()
        self.result: MissionResult | None = None
        self.heard = 0
        self._finished = Event()
        self._goal: MissionGoal | None = None
        self._handle: Any = None
        self._cancelled = False
        self._context = Context()
        rclpy.init(args=[], context=self._context, signal_handler_options=SignalHandlerOptions.NO)
        self._node = rclpy.create_node(
            f'geohtn_{os.getpid()}',
            namespace=namespace,
            context=self._context,
            start_parameter_services=False,
            enable_rosout=False,
        )
        self._missions = GoalClient(self._node, PlanMission, 'plan_mission')
        explain = self._node.create_client(Explain, 'explain')
        satisfy = self._node.create_client(SatisfyPreconditions, 'satisfy_preconditions')
        self._servers = {
            'motion_planner_node': satisfy.service_is_ready,
            'task_planner_node': explain.service_is_ready,
            'interface_node': self._missions.server_is_ready,
        }
        self._executor = BackgroundExecutor(self._node)

    def __enter__(self) -> MissionClient:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._executor.close()
        self._missions.destroy()
        self._node.destroy_node()
        rclpy.shutdown(context=self._context)

    def missing(self) -> tuple[str, ...]:
        """Names of the nodes that are not to be seen."""
        return tuple(name for name, is_ready in self._servers.items() if not is_ready())

    def start(self, goal: MissionGoal) -> None:
        """Send a mission; from now on :attr:`progress` moves, and in the end :meth:`wait` is true."""
        self._goal = goal
        message = PlanMission.Goal(
            mission=goal.mission.name,
            domain=_text(goal.mission.sources['domain']),
            problem=_text(goal.mission.sources['problem']),
            world=_text(goal.mission.sources['world']),
            options=PlanningOptions(
                time_budget=goal.time_budget,
                seed=goal.seed,
                optimise=goal.optimise,
                use_advice=goal.use_advice,
                max_alternatives=goal.max_alternatives,
                guidance=goal.guidance,
            ),
            output_directory=goal.output_directory,
        )
        sent = self._missions.send_goal_async(message, feedback_callback=self._on_feedback)
        sent.add_done_callback(self._on_accepted)

    def wait(self, seconds: float) -> bool:
        """Whether the mission has ended, after at most ``seconds``."""
        return self._finished.wait(seconds)

    def cancel(self) -> None:
        """Ask the interface node to stop; the mission ends soon after."""
        self._cancelled = True
        if self._handle is not None:
            self._handle.cancel_goal_async()

    def _on_feedback(self, message: Any) -> None:
        progress = message.feedback.progress
        self.heard += 1
        self.progress = Progress(
            progress.phase,
            progress.goals_reached,
            progress.goals_total,
            progress.requests,
            progress.backtracks,
            progress.best_length,
            progress.elapsed,
            progress.best_cost,
        )

    def _on_accepted(self, future: Any) -> None:
        self._handle = future.result()
        self.heard += 1
        if not self._handle.accepted:
            self._finished.set()
            return
        self._handle.get_result_async().add_done_callback(self._on_result)
        if self._cancelled:
            self._handle.cancel_goal_async()

    def _on_result(self, future: Any) -> None:
        result = future.result().result
        assert self._goal is not None
        plan = plan_from_messages(
            result.plan,
            result.outcome,
            result.statistics,
            world_path=self._goal.mission.sources['world'].path,
            seed=self._goal.seed,
        )
        self.result = MissionResult(plan, tuple(result.files))
        self._finished.set()


def _text(source: Source) -> SourceText:
    return SourceText(path=source.path, text=source.text)
