"""Status, cause and scope of an answer: the same numbers as in geohtn_msgs/GeometricAnswer."""

from __future__ import annotations

from enum import IntEnum


class Status(IntEnum):
    """What an answer says about its request."""

    FOUND = 0
    IMPOSSIBLE = 1
    UNKNOWN = 2
    ERROR = 3


class Code(IntEnum):
    """Why a request was not answered FOUND: one number per cause, the hundreds being the status."""

    NONE = 0
    CONTRADICTION = 100
    STATE_IN_OBSTACLE = 101
    NO_FREE_DESTINATION = 102
    UNREACHABLE = 103
    START_IN_OBSTACLE = 104
    NOT_SATISFIED = 200
    IN_OBSTACLE = 201
    NO_PATH = 202
    NO_MORE_ALTERNATIVES = 203
    OUT_OF_TIME = 204
    CANCELLED = 205
    INVALID_PRECONDITIONS = 300
    UNKNOWN_AGENT = 301
    UNKNOWN_OBJECT = 302
    UNKNOWN_FUNCTION = 303
    UNKNOWN_PROPERTY = 304
    INVALID_START = 305
    NO_START = 306
    NO_WORLD = 307
    WORLD_CHANGED = 308
    UNSUPPORTED = 309
    INTERNAL = 399

    @property
    def status(self) -> Status:
        """The status that an answer with this code has."""
        return Status(self // 100)


class Scope(IntEnum):
    """The starts from which an IMPOSSIBLE holds."""

    THIS_START = 0
    CONNECTED_STARTS = 1
    ANY_START = 2


class Purpose(IntEnum):
    """What advice is for: the same numbers as in geohtn_msgs/AdviceRequest."""

    NEAREST_FIRST = 0
    SHORTEST_TOUR = 1
    FIXED_ORDER = 2
    OPPORTUNITIES = 3


class AttemptResult(IntEnum):
    """What came of one destination."""

    FOUND = 0
    NOT_SATISFIED = 1
    IN_OBSTACLE = 2
    NO_PATH = 3
