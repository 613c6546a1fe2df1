"""Functions of lists and of terms of any kind, as in Lisp; none changes its arguments."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

from task_planner_node.language.functions.function import (
    FALSE,
    MAX_ITEMS,
    MAX_NESTING,
    TRUE,
    Function,
    FunctionFailed,
    integer,
    sequence,
    truth,
)
from task_planner_node.language.model import Dotted, Ground, chain, show


def _first(value: object) -> Any:
    if isinstance(value, Dotted):
        return value.items[0]
    items = sequence(value)
    return items[0] if items else FALSE


def _rest(value: object) -> Ground:
    if isinstance(value, Dotted):
        return chain(value.items[1:], value.tail)
    return sequence(value)[1:]


def _element(position: int) -> Callable[[object], Any]:
    return lambda value: _nth(position, value)


def _nth(position: object, value: object) -> Any:
    index, items = integer(position), sequence(value)
    if index < 0:
        raise FunctionFailed('counts from 0')
    return items[index] if index < len(items) else FALSE


def _nthcdr(count: object, value: object) -> Ground:
    if integer(count) < 0:
        raise FunctionFailed('counts from 0')
    return sequence(value)[integer(count) :]


def _cons(item: Any, tail: Any) -> Ground:
    return _shallow(chain((item,), tail))


def _list_of(*items: Any) -> Ground:
    return _shallow(items)


def _list_before(*items: Any) -> Ground:
    return _shallow(chain(items[:-1], items[-1]))


def _append(*lists: Any) -> Ground:
    if not lists:
        return FALSE
    items = tuple(item for part in lists[:-1] for item in sequence(part))
    return _shallow(chain(items, lists[-1]))


def _shallow(value: Ground) -> Ground:
    """The list itself if it is neither too long nor too deep, or FunctionFailed."""
    layer: list[Any] = [value]
    for _ in range(MAX_NESTING + 1):
        layer = [
            part
            for whole in layer
            if isinstance(whole, (tuple, Dotted))
            for part in (whole.items if isinstance(whole, Dotted) else whole)
        ]
        if not layer:
            return value
        if len(layer) > MAX_ITEMS:
            break
    raise FunctionFailed(f'makes a list of more than {MAX_NESTING} levels or {MAX_ITEMS} items')


def _last(value: object) -> Ground:
    return sequence(value)[-1:]


def _length(value: object) -> int:
    return len(sequence(value))


def _member(item: Any, value: object) -> Ground:
    """The list from the first occurrence of ``item`` on."""
    items = sequence(value)
    return items[items.index(item) :] if item in items else FALSE


def _position(item: Any, value: object) -> Ground:
    items = sequence(value)
    return items.index(item) if item in items else FALSE


def _remove(item: Any, value: object) -> Ground:
    return tuple(part for part in sequence(value) if part != item)


def _remove_duplicates(value: object) -> Ground:
    """Of equal items the last one stays, as in Lisp."""
    return tuple(dict.fromkeys(reversed(sequence(value))))[::-1]


def _subseq(value: object, start: object, end: object = FALSE) -> Ground:
    items = sequence(value)
    stop = len(items) if end == FALSE else integer(end)
    if not 0 <= integer(start) <= stop <= len(items):
        raise FunctionFailed('has no such part')
    return items[integer(start) : stop]


def _union(left: object, right: object) -> Ground:
    return tuple(dict.fromkeys((*sequence(left), *sequence(right))))


def _intersection(left: object, right: object) -> Ground:
    common = set(sequence(right))
    return tuple(item for item in sequence(left) if item in common)


def _difference(left: object, right: object) -> Ground:
    gone = set(sequence(right))
    return tuple(item for item in sequence(left) if item not in gone)


def _subset(left: object, right: object) -> Ground:
    return truth(set(sequence(left)) <= set(sequence(right)))


def _assoc(key: Any, value: object) -> Any:
    for pair in sequence(value):
        if isinstance(pair, (tuple, Dotted)) and pair != FALSE and _first(pair) == key:
            return pair
    return FALSE


def _equal(*values: Any) -> Ground:
    return truth(all(left == right for left, right in pairwise(values)))


def _string_before(left: object, right: object) -> Ground:
    if isinstance(left, str) and isinstance(right, str):
        return truth(left.strip('"') < right.strip('"'))
    raise FunctionFailed('expects symbols or strings')


def _fail(*words: Any) -> Ground:
    """Lisp's ``error``: a domain says that something should not be so."""
    raise FunctionFailed('is called with ' + ' '.join(map(show, words)))


def _is_symbol(value: object) -> Ground:
    return truth(value == FALSE or (isinstance(value, str) and not value.startswith('"')))


def _is_list(value: object) -> bool:
    return isinstance(value, (tuple, Dotted))


LISTS = (
    Function('list', _list_of, 0, None, 'the list of the arguments'),
    Function('list*', _list_before, 1, None, 'the list of the arguments, the last one its tail'),
    Function('cons', _cons, 2, 2, 'the list of the first argument before the second'),
    Function('append', _append, 0, None, 'the lists, joined'),
    Function('car', _first, 1, 1, 'the first element, nil of an empty list'),
    Function('cdr', _rest, 1, 1, 'the list without its first element'),
    Function('first', _first, 1, 1, 'the first element'),
    Function('rest', _rest, 1, 1, 'the list without its first element'),
    Function('second', _element(1), 1, 1, 'the second element, or nil'),
    Function('third', _element(2), 1, 1, 'the third element, or nil'),
    Function('fourth', _element(3), 1, 1, 'the fourth element, or nil'),
    Function('fifth', _element(4), 1, 1, 'the fifth element, or nil'),
    Function('cadr', _element(1), 1, 1, 'the second element, or nil'),
    Function('cddr', lambda value: _rest(_rest(value)), 1, 1, 'the list from the third element on'),
    Function('nth', _nth, 2, 2, 'the element at an index from 0, or nil'),
    Function('nthcdr', _nthcdr, 2, 2, 'the list from an index on'),
    Function('last', _last, 1, 1, 'the list of the last element'),
    Function('length', _length, 1, 1, 'the number of elements'),
    Function('reverse', lambda value: sequence(value)[::-1], 1, 1, 'backwards'),
    Function('member', _member, 2, 2, 'the list from an element on, nil without it'),
    Function('position', _position, 2, 2, 'the index of an element, nil without it'),
    Function('remove', _remove, 2, 2, 'the list without an element'),
    Function('remove-duplicates', _remove_duplicates, 1, 1, 'the list without repetitions'),
    Function('subseq', _subseq, 2, 3, 'a part of the list, from an index to another'),
    Function('union', _union, 2, 2, 'the elements of either list'),
    Function('intersection', _intersection, 2, 2, 'the elements of both lists'),
    Function('set-difference', _difference, 2, 2, 'the elements of the first list only'),
    Function('subsetp', _subset, 2, 2, 'whether the second list has all of the first'),
    Function('assoc', _assoc, 2, 2, 'the first list in a list that begins with a key'),
    Function('=', _equal, 1, None, 'whether all are equal'),
    Function('eq', _equal, 2, 2, 'whether both are equal'),
    Function('eql', _equal, 2, 2, 'whether both are equal'),
    Function('equal', _equal, 2, 2, 'whether both are equal'),
    Function('equalp', _equal, 2, 2, 'whether both are equal'),
    Function('not', lambda value: truth(value == FALSE), 1, 1, 'whether it is nil'),
    Function('null', lambda value: truth(value == FALSE), 1, 1, 'whether it is nil'),
    Function('atom', lambda v: truth(v == FALSE or not _is_list(v)), 1, 1, 'whether it is no list'),
    Function('consp', lambda v: truth(v != FALSE and _is_list(v)), 1, 1, 'whether it is a list'),
    Function('listp', lambda value: truth(_is_list(value)), 1, 1, 'whether it is a list or nil'),
    Function(
        'numberp', lambda v: truth(isinstance(v, (int, float))), 1, 1, 'whether it is a number'
    ),
    Function(
        'integerp', lambda value: truth(isinstance(value, int)), 1, 1, 'whether it is an integer'
    ),
    Function('symbolp', _is_symbol, 1, 1, 'whether it is a symbol'),
    Function('string<', _string_before, 2, 2, 'whether the first comes before the second'),
    Function('identity', lambda value: value, 1, 1, 'the argument itself'),
    Function('error', _fail, 0, None, 'ends the search with the arguments as the reason'),
    Function('format', lambda *_: FALSE, 1, None, 'nil; nothing is printed'),
    Function('print', lambda value: value, 1, 1, 'the argument; nothing is printed'),
    Function('pprint', lambda value: value, 1, 1, 'the argument; nothing is printed'),
    *(
        Function(name, lambda *_: TRUE, 0, None, 't; nothing is printed')
        for name in ('print-current-state', 'print-current-plan', 'print-last-action')
    ),
)
