"""Functions of other packages, which entry points bring in; see docs/functions.md."""

from __future__ import annotations

import re
from collections.abc import Iterable
from importlib.metadata import EntryPoint, entry_points
from math import nan
from typing import Any

import numpy as np

from motion_planner_node.functions.dual import Dual
from motion_planner_node.functions.function import Function, Kind
from motion_planner_node.functions.interval import Interval
from motion_planner_node.functions.library import FUNCTIONS
from motion_planner_node.functions.scalar import Place
from motion_planner_node.functions.surroundings import Surroundings
from motion_planner_node.robots.motion import COMPONENTS

#: The group of entry points that name a ``Function``, or several.
GROUP = 'motion_planner_node.functions'

_NAME = re.compile(r'[^\W\d]\w*(-[^\W\d_]\w*)*')
_RESERVED = frozenset({'setProperty', 'setProprety', 'not', 'pi', 'agent', 'object', 'region'})


class PluginError(Exception):
    """A package's function that cannot be used, in one sentence."""


def load_plugins() -> tuple[str, ...]:
    """Add the functions of all installed packages to the library; their names, in order.

    Raises PluginError at the first one that cannot be loaded, is not a ``Function``, has a name that
    is taken, or fails when it is tried; then nothing is added.
    """
    found: dict[str, Function] = {}
    for entry in sorted(entry_points(group=GROUP), key=lambda entry: (entry.name, entry.value)):
        for function in _functions_of(entry):
            where = f'the plugin {entry.name} ({entry.value})'
            fault = fault_of(function)
            if function.name in FUNCTIONS or function.name in found:
                fault = 'its name is taken'
            if fault:
                raise PluginError(f'{where}: function {function.name}: {fault}')
            found[function.name] = function
    FUNCTIONS.update(found)
    return tuple(found)


def _functions_of(entry: EntryPoint) -> tuple[Function, ...]:
    where = f'the plugin {entry.name} ({entry.value})'
    try:
        loaded = entry.load()
    except Exception as error:
        raise PluginError(f'{where} cannot be loaded: {type(error).__name__}: {error}') from error
    functions = tuple(loaded) if isinstance(loaded, Iterable) else (loaded,)
    for function in functions:
        if not isinstance(function, Function):
            raise PluginError(f'{where} is not a Function, nor several, but {loaded!r}')
    return functions


def fault_of(function: Function) -> str:
    """What is wrong with ``function`` as far as a trial shows; empty if nothing is."""
    if not _NAME.fullmatch(function.name) or function.name in _RESERVED:
        return 'its name cannot be written in a constraint'
    if function.result not in {Kind.NUMBER, Kind.ANGLE}:
        return 'its result has to be NUMBER or ANGLE'
    allowed = {'', '=', '<=', '>='} if function.result is Kind.NUMBER else {'', '='}
    if function.condition not in allowed:
        return f'its condition has to be one of {", ".join(map(repr, sorted(allowed)))}'
    if not function.arguments or Kind.CONDITION in function.arguments:
        return 'it has to take arguments, and none of them can be a condition'
    unknown = set(function.derived_codes) - set(COMPONENTS)
    if unknown:
        return f'derived_codes names {", ".join(sorted(unknown))}; known: {", ".join(COMPONENTS)}'
    column = np.array([3.0, nan])
    try:
        for number in (Dual(column, np.ones((3, 2))), Interval(column, column + 1.0)):
            _try(function, number)
    except PluginError as error:
        return str(error)
    return ''


def _try(function: Function, number: Dual | Interval) -> None:
    kind = type(number).__name__
    try:
        with np.errstate(all='ignore'):
            result = function.value(*_trial(function, number))
    except Exception as error:
        raise PluginError(f'it fails on {kind}: {type(error).__name__}: {error}') from error
    if type(result) is not type(number):
        raise PluginError(f'it gives {type(result).__name__} for {kind}')


def _trial(function: Function, number: Any) -> list[Any]:
    surroundings = Surroundings()
    arguments: list[Any] = [surroundings] if function.sees_world else []
    for kind in function.arguments:
        if kind is Kind.REGION:
            arguments.append(surroundings.region(''))
        elif kind in {Kind.NUMBER, Kind.ANGLE}:
            arguments.append(number)
        else:
            arguments.append(Place(number, number, number))
    return arguments
