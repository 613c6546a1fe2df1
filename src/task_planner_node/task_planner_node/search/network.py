"""Task networks: persistent linked lists of tasks and of partially ordered parts (SHOP2's PSTT).

A network is None when nothing is left to do, or a pair (first, rest).  The first element is a ground task,
``(name, argument, ...)``, or Parallel: networks that may be interleaved and all precede the rest.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import Any

Task = tuple[Any, ...]


class Parallel:
    """At least two networks, none of them empty, without an order among them."""

    __slots__ = ('branches',)

    def __init__(self, branches: tuple[Network, ...]) -> None:
        self.branches = branches


Network = tuple[Task | Parallel, Any] | None
Path = tuple[int, ...]


def parallel(branches: list[Network], rest: Network) -> Network:
    """The branches in any interleaving, then the rest; nested ones are flattened."""
    flat: list[Network] = []
    for branch in branches:
        if branch is None:
            continue
        first, after = branch
        if isinstance(first, Parallel) and after is None:
            flat.extend(first.branches)
        else:
            flat.append(branch)
    if not flat:
        return rest
    if len(flat) == 1:
        return sequence(flat[0], rest)
    return (Parallel(tuple(flat)), rest)


def sequence(network: Network, rest: Network) -> Network:
    """The network, then the rest."""
    if rest is None:
        return network
    elements = []
    while network is not None:
        first, network = network
        elements.append(first)
    for first in reversed(elements):
        rest = (first, rest)
    return rest


def first_tasks(network: Network) -> list[tuple[Task, Path]]:
    """The tasks that may come next, in order, each with its path through the parallel branches."""
    if network is None:
        return []
    found: list[tuple[Task, Path]] = []
    agenda: list[tuple[Network, Path]] = [(network, ())]
    while agenda:
        part, path = agenda.pop()
        if part is None:
            continue
        first = part[0]
        if isinstance(first, Parallel):
            branches = first.branches
            agenda.extend((branches[i], (*path, i)) for i in range(len(branches) - 1, -1, -1))
        else:
            found.append((first, path))
    return found


def rest_after(network: Network, path: Path) -> Network:
    """What follows the first task at ``path`` inside its own branch."""
    part = network
    for index in path:
        part = _branches(part)[index]
    return part[1] if part is not None else None


def replace(network: Network, path: Path, branch: Network, to_front: bool) -> Network:
    """The network with ``branch`` in place of the innermost branch at ``path``.

    ``to_front`` moves what was replaced in front of its siblings, so that it is continued first.
    """
    outer: list[tuple[tuple[Network, ...], int, Network]] = []
    part = network
    for index in path:
        branches = _branches(part)
        outer.append((branches, index, part[1] if part is not None else None))
        part = branches[index]
    for branches, index, rest in reversed(outer):
        if to_front:
            siblings = [branch, *branches[:index], *branches[index + 1 :]]
        else:
            siblings = [*branches[:index], branch, *branches[index + 1 :]]
        branch = parallel(siblings, rest)
    return branch


def _branches(part: Network) -> tuple[Network, ...]:
    first = part[0] if part is not None else None
    if not isinstance(first, Parallel):
        raise LookupError('the path leads to no parallel branch')
    return first.branches


def all_tasks(network: Network) -> Iterator[Task]:
    """Every task of the network, in no particular order."""
    agenda = [network]
    while agenda:
        part = agenda.pop()
        while part is not None:
            first, part = part
            if isinstance(first, Parallel):
                agenda.extend(first.branches)
            else:
                yield first


class TooLarge(Exception):
    """The network has more tasks than are worth looking at."""


def canonical(network: Network, most: int) -> tuple[Any, ...]:
    """A hashable value that is equal for networks that differ in the order of parallel branches only.

    Raises TooLarge beyond ``most`` tasks.
    """
    elements: list[Any] = []
    while network is not None:
        first, network = network
        if isinstance(first, Parallel):
            parts = [canonical(branch, most) for branch in first.branches]
            most -= sum(len(part) for part in parts)
            elements.append(frozenset(Counter(parts).items()))
        else:
            elements.append(first)
        if len(elements) > most:
            raise TooLarge
    return tuple(elements)
