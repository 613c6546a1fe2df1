"""Computing terms: applications of functions become closures over whatever holds the variables."""

from __future__ import annotations

from collections.abc import Callable
from functools import cmp_to_key, reduce
from typing import Any, TypeVar

from task_planner_node.errors import MissionError
from task_planner_node.language.functions.function import (
    FALSE,
    TRUE,
    Function,
    FunctionFailed,
    sequence,
    truth,
)
from task_planner_node.language.functions.library import FUNCTIONS
from task_planner_node.language.model import (
    Application,
    Pattern,
    Term,
    Variable,
    chain,
    shorten,
    show,
)
from task_planner_node.language.source import Source

F = TypeVar('F')
#: The value of a term in a frame.
Compute = Callable[[F], Any]
Values = list[Compute[Any]]

#: What is written like a function but does not compute all its arguments, with how many it takes.
FORMS: dict[str, tuple[int, int | None]] = {
    'if': (2, 3),
    'and': (0, None),
    'or': (0, None),
    'when': (1, None),
    'unless': (1, None),
    'progn': (0, None),
    'variablep': (1, 1),
}
#: What takes the name of a function first, with how many arguments; readers give it as a symbol.
HIGHER: dict[str, tuple[int, int | None]] = {
    'apply': (2, None),
    'mapcar': (2, None),
    'reduce': (2, 2),
    'sort': (2, 2),
}


def compile_term(term: Term, variable: Callable[[str], Compute[F]], source: Source) -> Compute[F]:
    """How to get the value of ``term`` from a frame, which is whatever holds the variables' values.

    ``variable`` gives for a name how to read its value: a ground term, or None while it is unbound.  Reading
    the value of an unbound variable, or a function that has no value for its arguments, raises MissionError with the place in
    ``source``.
    """
    return _Compiler(variable, source).term(term, None)


def comparison_of(name: str) -> Callable[[Any, Any], int]:
    """A comparison for functools.cmp_to_key from a function that holds when its first belongs before.

    The result raises FunctionFailed where the function has no value.  Raises KeyError for an unknown function.
    """
    before = FUNCTIONS[name].value

    def compare(left: Any, right: Any) -> int:
        if before(left, right) != FALSE:
            return -1
        return 1 if before(right, left) != FALSE else 0

    return compare


class _Compiler:
    def __init__(self, variable: Callable[[str], Compute[Any]], source: Source) -> None:
        self._variable = variable
        self._source = source

    def term(self, term: Term, application: Application | None) -> Compute[Any]:
        if isinstance(term, Variable):
            return self._read(term, application)
        if isinstance(term, Pattern):
            return self._list(term, application)
        if isinstance(term, Application):
            return self._application(term)
        return lambda _: term

    def _read(self, variable: Variable, application: Application | None) -> Compute[Any]:
        read = self._variable(variable.name)

        def value(frame: Any) -> Any:
            found = read(frame)
            if found is None:
                raise self._failed(application, f'{variable.name} has no value here')
            return found

        return value

    def _list(self, pattern: Pattern, application: Application | None) -> Compute[Any]:
        items = [self.term(item, application) for item in pattern.items]
        tail = FALSE if pattern.tail is None else pattern.tail
        end = self.term(tail, application)
        return lambda frame: chain(tuple([item(frame) for item in items]), end(frame))

    def _application(self, application: Application) -> Compute[Any]:
        name = application.function
        if name in FORMS:
            return self._form(application)
        arguments, function = application.arguments, None
        if name in HIGHER:
            function = _HIGHER_VALUES[name](FUNCTIONS[str(arguments[0])])
            arguments = arguments[1:]
        values = [self.term(argument, application) for argument in arguments]
        return self._call(application, function or FUNCTIONS[name].value, values)

    def _call(
        self, application: Application, function: Callable[..., Any], values: Values
    ) -> Compute[Any]:
        if len(values) == 2:
            left, right = values

            def value_of_two(frame: Any) -> Any:
                arguments = left(frame), right(frame)
                try:
                    return function(*arguments)
                except FunctionFailed as failure:
                    raise self._failed(application, failure, arguments) from failure

            return value_of_two

        def value(frame: Any) -> Any:
            arguments = [argument(frame) for argument in values]
            try:
                return function(*arguments)
            except FunctionFailed as failure:
                raise self._failed(application, failure, arguments) from failure

        return value

    def _form(self, application: Application) -> Compute[Any]:
        name = application.function
        if name == 'variablep':
            return self._unbound(application.arguments[0])
        parts = [self.term(argument, application) for argument in application.arguments]
        if name == 'if':
            return _if(parts[0], parts[1], parts[2] if len(parts) == 3 else _nil)
        if name == 'when':
            return _if(parts[0], _in_turn(parts[1:]), _nil)
        if name == 'unless':
            return _if(parts[0], _nil, _in_turn(parts[1:]))
        if name == 'progn':
            return _in_turn(parts)
        return _and(parts) if name == 'and' else _or(parts)

    def _unbound(self, argument: Term) -> Compute[Any]:
        if not isinstance(argument, Variable):
            return _nil
        read = self._variable(argument.name)
        return lambda frame: truth(read(frame) is None)

    def _failed(
        self,
        application: Application | None,
        failure: FunctionFailed | str,
        arguments: Any = (),
    ) -> MissionError:
        if application is None:
            return MissionError([self._source.diagnostic(0, 0, str(failure))])
        message = str(failure)
        if isinstance(failure, FunctionFailed):
            shown = ' '.join([application.function, *(show(argument) for argument in arguments)])
            message = f'({shorten(shown)}) {failure}'
        node = application.node
        return MissionError([self._source.diagnostic(node.start, node.end, message)])


def _nil(_: object) -> Any:
    return FALSE


def _if(condition: Compute[Any], then: Compute[Any], otherwise: Compute[Any]) -> Compute[Any]:
    return lambda frame: then(frame) if condition(frame) != FALSE else otherwise(frame)


def _in_turn(parts: Values) -> Compute[Any]:
    """Lisp's progn: the value of the last part, nil without parts."""

    def value(frame: Any) -> Any:
        result: Any = FALSE
        for part in parts:
            result = part(frame)
        return result

    return value


def _and(parts: Values) -> Compute[Any]:
    def value(frame: Any) -> Any:
        result: Any = TRUE
        for part in parts:
            result = part(frame)
            if result == FALSE:
                break
        return result

    return value


def _or(parts: Values) -> Compute[Any]:
    def value(frame: Any) -> Any:
        for part in parts:
            result = part(frame)
            if result != FALSE:
                return result
        return FALSE

    return value


def _apply(function: Function) -> Callable[..., Any]:
    def value(*arguments: Any) -> Any:
        values = (*arguments[:-1], *sequence(arguments[-1]))
        return _checked(function, len(values))(*values)

    return value


def _mapcar(function: Function) -> Callable[..., Any]:
    def value(*lists: Any) -> Any:
        mapped = _checked(function, len(lists))
        return tuple(mapped(*items) for items in zip(*map(sequence, lists), strict=False))

    return value


def _reduce(function: Function) -> Callable[..., Any]:
    def value(items: Any) -> Any:
        if sequence(items) == FALSE:
            return _checked(function, 0)()
        return reduce(_checked(function, 2), items)

    return value


def _sort(function: Function) -> Callable[..., Any]:
    def value(items: Any) -> Any:
        return tuple(sorted(sequence(items), key=cmp_to_key(comparison_of(function.name))))

    return value


def _checked(function: Function, count: int) -> Callable[..., Any]:
    if function.takes(count):
        return function.value
    raise FunctionFailed(f'calls {function.name} with {count} arguments: it takes {function.arity}')


_HIGHER_VALUES = {'apply': _apply, 'mapcar': _mapcar, 'reduce': _reduce, 'sort': _sort}
