"""An action client for threads beside the one that spins it."""

from __future__ import annotations

from threading import RLock
from typing import Any

from rclpy.action import ActionClient


class GoalClient(ActionClient):
    """Takes no response before the request that it answers is noted.

    rclpy's own client sends a request and notes it afterwards. When another thread takes the response in
    between, it is ignored as an unexpected one, and whoever asked waits for ever.
    """

    def __init__(self, *arguments: Any, **options: Any) -> None:
        self._sending = RLock()
        super().__init__(*arguments, **options)

    def send_goal_async(self, *arguments: Any, **options: Any) -> Any:
        """As ActionClient.send_goal_async."""
        with self._sending:
            return super().send_goal_async(*arguments, **options)

    def _cancel_goal_async(self, goal_handle: Any) -> Any:
        with self._sending:
            return super()._cancel_goal_async(goal_handle)

    def _get_result_async(self, goal_handle: Any) -> Any:
        with self._sending:
            return super()._get_result_async(goal_handle)

    def take_data(self) -> Any:
        """As ActionClient.take_data."""
        with self._sending:
            return super().take_data()
