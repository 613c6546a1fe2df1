"""The parameters of the node: declared from the table in `parameters.py`, checked, adopted."""

from __future__ import annotations

from collections.abc import Callable

from rcl_interfaces.msg import SetParametersResult
from rclpy.exceptions import InvalidParameterValueException
from rclpy.node import Node
from rclpy.parameter import Parameter

from motion_planner_node import conversions
from motion_planner_node.parameters import (
    ParameterError,
    Parameters,
    read_parameters,
    specifications,
)


class Settings:
    """The parameters of ``node``; ``adopt`` hears of each consistent set of new values.

    :raises ParameterError: when a parameter has a wrong value from the start
    """

    def __init__(self, node: Node, adopt: Callable[[Parameters], None]) -> None:
        self._node = node
        self._adopt = adopt
        node.add_on_set_parameters_callback(self._check)
        try:
            for row in specifications():
                node.declare_parameter(row.name, row.default, conversions.descriptor_of(row))
        except InvalidParameterValueException as error:
            raise ParameterError(str(error)) from error
        self.current = self._read()
        node.add_post_set_parameters_callback(self._change)

    def _read(self) -> Parameters:
        names = [row.name for row in specifications()]
        return read_parameters({name: self._node.get_parameter(name).value for name in names})

    def _check(self, changed: list[Parameter]) -> SetParametersResult:
        own = {row.name: row for row in specifications()}
        try:
            for parameter in changed:
                if parameter.name in own:
                    own[parameter.name].accept(parameter.value)
        except ParameterError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _change(self, _changed: list[Parameter]) -> None:
        self.current = self._read()
        self._adopt(self.current)
