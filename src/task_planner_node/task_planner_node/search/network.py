"""Task networks: persistent linked lists of tasks and of partially ordered parts (SHOP2's PSTT).

A network is None when nothing is left to do, or a cell ``(first, rest, parent, place, key)``.  The first element is a
ground task ``(name, argument, ...)``, or Parallel: networks that may be interleaved and all precede the rest.
``parent`` is the expansion that brought the task in, and ``place`` its place among the tasks of that, in the order
of the text.  ``key`` is a hash of the tasks and their order.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterator, Mapping, Sequence
from typing import Any

Task = tuple[Any, ...]
# For the label of a branch the labels of those that have to be done before.
Before = Mapping[int, frozenset[int]]


class Immediate(tuple[Any, ...]):
    """A task that comes before all others once it may come next."""

    __slots__ = ()


class Kept(tuple[Any, ...]):
    """A task of an operator that is to do what it did before: make ``added`` facts true and ``removed`` ones false."""

    added: tuple[Any, ...] = ()
    removed: tuple[Any, ...] = ()

    def done(self, facts: Container[Any]) -> bool:
        """Whether it did, if ``facts`` hold after it."""
        return all(fact in facts for fact in self.added) and not any(
            fact in facts for fact in self.removed
        )


class Parallel:
    """At least two networks, none of them empty, without an order among them.

    With ``before`` a branch waits for those with the labels that it names, as long as they are there.  ``urgent``
    counts the immediate tasks that may come next, if no branch waited.
    """

    __slots__ = ('before', 'branches', 'key', 'labels', 'urgent')

    def __init__(
        self,
        branches: tuple[Any, ...],
        key: int,
        urgent: int,
        labels: tuple[int, ...] = (),
        before: Before | None = None,
    ) -> None:
        self.branches = branches
        self.key = key
        self.urgent = urgent
        self.labels = labels
        self.before = before

    def open(self) -> Sequence[int]:
        """The indices of the branches that wait for none."""
        before = self.before
        if before is None:
            return range(len(self.branches))
        here = set(self.labels)
        return [i for i, label in enumerate(self.labels) if here.isdisjoint(before[label])]


Cell = tuple[Any, Any, Any, int, int]
Network = Cell | None
Path = tuple[int, ...]


def cell(first: Task | Parallel, rest: Network, parent: object = None, place: int = 0) -> Cell:
    """One element before the rest."""
    key = first.key if isinstance(first, Parallel) else first
    return (first, rest, parent, place, hash((key, rest[4] if rest is not None else 0)))


def _urgent(branch: Cell) -> int:
    first = branch[0]
    return first.urgent if isinstance(first, Parallel) else isinstance(first, Immediate)


def parallel(branches: Sequence[Network], rest: Network) -> Network:
    """The branches in any interleaving, then the rest; nested ones are flattened."""
    flat: list[Cell] = []
    for branch in branches:
        if branch is None:
            continue
        if _is_flat(branch):
            flat.append(branch)
        else:
            flat.extend(branch[0].branches)
    if not flat:
        return rest
    if len(flat) == 1:
        return sequence(flat[0], rest)
    urgent = sum(map(_urgent, flat))
    return cell(Parallel(tuple(flat), sum([branch[4] for branch in flat]), urgent), rest)


def _is_flat(branch: Cell) -> bool:
    """Whether a branch is not just branches that belong among its siblings."""
    first = branch[0]
    return not isinstance(first, Parallel) or branch[1] is not None or first.before is not None


def constrained(
    branches: Sequence[Network], labels: Sequence[int], before: Before, rest: Network
) -> Network:
    """The branches in any interleaving that ``before`` allows, then the rest."""
    left: list[tuple[int, Cell]] = [
        (label, branch)
        for label, branch in zip(labels, branches, strict=True)
        if branch is not None
    ]
    here = {label for label, _ in left}
    if all(here.isdisjoint(before[label]) for label in here):
        return parallel([branch for _, branch in left], rest)
    left_branches = tuple([branch for _, branch in left])
    left_labels = tuple([label for label, _ in left])
    key = sum([hash((label, branch[4])) for label, branch in left])
    urgent = sum(map(_urgent, left_branches))
    return cell(Parallel(left_branches, key, urgent, left_labels, before), rest)


def sequence(network: Network, rest: Network) -> Network:
    """The network, then the rest."""
    if rest is None:
        return network
    elements = []
    while network is not None:
        elements.append(network)
        network = network[1]
    for first, _, parent, place, _ in reversed(elements):
        rest = cell(first, rest, parent, place)
    return rest


def first_cells(network: Network) -> list[tuple[Cell, Path]]:
    """The cells of the tasks that may come next, in order, each with its path through the parallel branches."""
    if network is None:
        return []
    found: list[tuple[Cell, Path]] = []
    agenda: list[tuple[Cell, Path]] = [(network, ())]
    while agenda:
        part, path = agenda.pop()
        first = part[0]
        if isinstance(first, Parallel):
            branches = first.branches
            agenda += [(branches[i], (*path, i)) for i in reversed(first.open())]
        else:
            found.append((part, path))
    return found


def urgent(candidates: list[tuple[Cell, Path]]) -> list[tuple[Cell, Path]]:
    """The immediate ones among tasks that may come next, or all when none is."""
    return [c for c in candidates if isinstance(c[0][0], Immediate)] or candidates


def replace(network: Network, path: Path, branch: Network, to_front: bool) -> Network:
    """The network with ``branch`` in place of the innermost branch at ``path``.

    ``to_front`` moves what was replaced in front of its siblings, so that it is continued first.
    """
    outer: list[tuple[Parallel, int, Network]] = []
    part: Any = network
    for index in path:
        first = part[0]
        outer.append((first, index, part[1]))
        part = first.branches[index]
    for first, index, rest in reversed(outer):
        branches, labels = first.branches, first.labels
        before, after = branches[:index], branches[index + 1 :]
        if first.before is not None:
            order = (labels[index], *labels[:index], *labels[index + 1 :])
            branch = constrained((branch, *before, *after), order, first.before, rest)
            continue
        if branch is None and len(branches) > 2:
            siblings = before + after
        elif branch is not None and _is_flat(branch):
            siblings = (branch, *before, *after) if to_front else (*before, branch, *after)
        else:
            fresh = (branch, *before, *after) if to_front else (*before, branch, *after)
            branch = parallel(fresh, rest)
            continue
        # The sums change by what was replaced.
        old = branches[index]
        key, urgent = first.key - old[4], first.urgent - _urgent(old)
        if branch is not None:
            key, urgent = key + branch[4], urgent + _urgent(branch)
        branch = cell(Parallel(siblings, key, urgent), rest)
    return branch


def all_tasks(network: Network) -> Iterator[Task]:
    """Every task of the network, in no particular order."""
    agenda = [network]
    while agenda:
        part = agenda.pop()
        while part is not None:
            first = part[0]
            if isinstance(first, Parallel):
                agenda.extend(first.branches)
            else:
                yield first
            part = part[1]


def same(one: Network, other: Network, most: int) -> bool:
    """Whether two networks differ in the order of parallel branches at most.

    Raises TooLarge beyond ``most`` tasks in parallel branches.
    """
    while one is not other:
        if one is None or other is None or one[4] != other[4]:
            return False
        first, second = one[0], other[0]
        if isinstance(first, Parallel) or isinstance(second, Parallel):
            return canonical(one, most) == canonical(other, most)
        if first != second:
            return False
        one, other = one[1], other[1]
    return True


class TooLarge(Exception):
    """The network has more tasks than are worth looking at."""


def canonical(network: Network, most: int) -> tuple[Any, ...]:
    """A hashable value that is equal for networks that differ in the order of parallel branches only.

    Raises TooLarge beyond ``most`` tasks.
    """
    elements: list[Any] = []
    while network is not None:
        first, network = network[0], network[1]
        if isinstance(first, Parallel):
            parts: list[Any] = [canonical(branch, most) for branch in first.branches]
            most -= sum(len(part) for part in parts)
            if first.before is not None:
                parts = list(zip(first.labels, parts, strict=True))
            elements.append(frozenset(Counter(parts).items()))
        else:
            elements.append(first)
        if len(elements) > most:
            raise TooLarge
    return tuple(elements)
