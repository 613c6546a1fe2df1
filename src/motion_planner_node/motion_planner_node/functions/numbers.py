"""Functions of numbers and angles."""

from __future__ import annotations

from functools import reduce
from math import pi

from motion_planner_node.functions.function import Function, Kind
from motion_planner_node.functions.scalar import S


def degrees(angle: S) -> S:
    """An angle given in degrees [rad]."""
    return angle.scaled(pi / 180.0)


def angle_of(radians: S) -> S:
    """The angle [rad] modulo 2 pi whose cosine and sine a constraint is about."""
    return radians


def angle_between(first: S, second: S) -> S:
    """The angle [rad] between two directions, from 0 to pi."""
    turn = first - second
    return turn.sin().__abs__().arctan2(turn.cos())


def least(*numbers: S) -> S:
    """The smallest number."""
    return reduce(lambda first, second: first.minimum(second), numbers)


def greatest(*numbers: S) -> S:
    """The largest number."""
    return reduce(lambda first, second: first.maximum(second), numbers)


def absolute(number: S) -> S:
    """The number without its sign."""
    return number.__abs__()


NUMBERS = (
    Function(
        name='cos-and-sin',
        arguments=(Kind.NUMBER,),
        result=Kind.ANGLE,
        value=angle_of,
        description='The angle that has this many radians, for comparison with an angle.',
    ),
    Function(
        name='deg',
        arguments=(Kind.NUMBER,),
        result=Kind.NUMBER,
        value=degrees,
        description='Radians of an angle given in degrees.',
    ),
    Function(
        name='angle_between',
        arguments=(Kind.ANGLE, Kind.ANGLE),
        result=Kind.NUMBER,
        value=angle_between,
        symmetric=True,
        description='The angle between two directions, from 0 to pi.',
    ),
    Function(
        name='min',
        arguments=(Kind.NUMBER, Kind.NUMBER),
        result=Kind.NUMBER,
        value=least,
        symmetric=True,
        repeats=True,
        description='The smallest of two or more numbers.',
    ),
    Function(
        name='max',
        arguments=(Kind.NUMBER, Kind.NUMBER),
        result=Kind.NUMBER,
        value=greatest,
        symmetric=True,
        repeats=True,
        description='The largest of two or more numbers.',
    ),
    Function(
        name='abs',
        arguments=(Kind.NUMBER,),
        result=Kind.NUMBER,
        value=absolute,
        description='The number without its sign.',
    ),
)
