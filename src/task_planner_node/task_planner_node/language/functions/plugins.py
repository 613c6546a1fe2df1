"""Functions of other packages, which entry points bring in; see docs/htn.md."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import replace
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from task_planner_node.language.functions.evaluation import FORMS, HIGHER
from task_planner_node.language.functions.function import Function, FunctionFailed, ground
from task_planner_node.language.functions.library import FUNCTIONS

#: The group of entry points that name a ``Function``, or several.
GROUP = 'task_planner_node.functions'

_NAME = re.compile(r'[^\s()\'`,;"|#?:!A-Z][^\s()\'`,;"|#A-Z]*')


class PluginError(Exception):
    """A package's function that cannot be used, in one sentence."""


def load_plugins() -> tuple[str, ...]:
    """Add the functions of all installed packages to the library; their names, in order.

    Raises PluginError at the first one that cannot be loaded, is not a ``Function``, or has a name that is taken or
    cannot be written; then nothing is added.
    """
    found: dict[str, Function] = {}
    for entry in sorted(entry_points(group=GROUP), key=lambda entry: (entry.name, entry.value)):
        where = f'the plugin {entry.name} ({entry.value})'
        for function in _functions_of(entry, where):
            fault = fault_of(function)
            if function.name in FUNCTIONS or function.name in found:
                fault = 'its name is taken'
            if fault:
                raise PluginError(f'{where}: function {function.name}: {fault}')
            found[function.name] = guarded(function)
    FUNCTIONS.update(found)
    return tuple(found)


def _functions_of(entry: EntryPoint, where: str) -> tuple[Function, ...]:
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
    """What is wrong with ``function``; empty if nothing is."""
    if not _NAME.fullmatch(function.name):
        return 'its name cannot be written in a domain: no capitals, blanks or quotes'
    if function.name in FORMS or function.name in HIGHER:
        return 'its name is taken'
    if function.least < 0 or (function.most is not None and function.most < function.least):
        return f'it cannot take {function.least} to {function.most} arguments'
    return ''


def guarded(function: Function) -> Function:
    """The function with its faults turned into FunctionFailed, and its values into ground terms."""
    inner = function.value

    def value(*arguments: Any) -> Any:
        try:
            result = inner(*arguments)
        except FunctionFailed:
            raise
        except Exception as error:
            raise FunctionFailed(f'fails: {type(error).__name__}: {error}') from error
        return ground(result)

    guard: Callable[..., Any] = value
    return replace(function, value=guard)
