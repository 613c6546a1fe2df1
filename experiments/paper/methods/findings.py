"""What the figures of the three methods say of the target, of the cause, and of drivable motions."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from experiments.paper.methods.summary import SLOPE_RATIO, Comparison
from experiments.paper.methods.trials import ATTITUDES_NAME

#: What the readings are called beside their figures.
SIZES = {'swapped': 'large', 'literal': 'small'}
LINEAR = ('blind, linear', 'nearest first, linear')
INDEXED = ('blind, indexed', 'nearest first, indexed')
VARIANTS = (
    'blind, objective in sight first, linear',
    'blind, circles left to the search, linear',
)
#: Of what is left with an index: above it the steps count for more than the matching.
HALF = 0.5
#: Methods by graph and name.
Methods = Mapping[tuple[str, str], Comparison]


def ratios(at: Methods, graph: str, methods: Iterable[str]) -> str:
    """Times per added goal by the hybrid's."""
    return ' and '.join(f'{at[graph, method].slope_ratio.median:.1f}' for method in methods)


def times_symbolic(at: Methods, graph: str, methods: Iterable[str]) -> str:
    """The whole hybrid's time per added goal by that of blind and of nearest-first search."""
    whole = at[graph, ATTITUDES_NAME].slope.median
    return ' and '.join(f'{whole / at[graph, method].slope.median:.1f}' for method in methods)


def target_text(at: Methods) -> str:
    """What the target is for, and which searches are below it."""
    below = [
        f'{method} ({graph}) {one.slope_ratio.median:.1f}'
        for (graph, method), one in at.items()
        if one.slope_ratio.median < SLOPE_RATIO and not method.startswith('hybrid')
    ]
    return f"""**The target** of {SLOPE_RATIO:g} times the hybrid's time for an added goal is for the rule and the order that the paper's text describes as we
read it: the first waypoint of the facts, or the nearest one, with linear matching. The two variants of blind search
take {ratios(at, 'swapped', VARIANTS)} times the hybrid's time on the large graph, {ratios(at, 'literal', VARIANTS)} times on the small one.
Below {SLOPE_RATIO:g} times are: {', '.join(below) or 'none'}.
"""


def causes(at: Methods) -> str:
    """What is left of the ratios with an index, and what their cause is by that."""
    return (
        "With an index, for the same plans, the times for an added goal by the hybrid's become "
        + '; '.join(
            f'{ratios(at, graph, INDEXED)} instead of {ratios(at, graph, LINEAR)} on the {size} graph: {_cause(at, graph)}'
            for graph, size in SIZES.items()
        )
        + '.'
    )


def _cause(at: Methods, graph: str) -> str:
    left = [
        at[graph, indexed].slope_ratio.median / at[graph, linear].slope_ratio.median
        for indexed, linear in zip(INDEXED, LINEAR, strict=True)
    ]
    if max(left) < HALF:
        return 'there matching is most of the cause, the number of HTN steps the smaller part'
    if min(left) > HALF:
        return 'there the number of HTN steps is most of the cause, matching the smaller part'
    return 'there both matching and the number of HTN steps count'


def cause_text(at: Methods) -> str:
    """How much of the time an index saves, and how many steps there are."""
    saved, steps = [], []
    for graph, size in SIZES.items():
        pairs = zip(INDEXED, LINEAR, strict=True)
        shares = [1.0 - at[graph, a].slope.median / at[graph, b].slope.median for a, b in pairs]
        saved.append(f'{shares[0]:.0%} and {shares[1]:.0%} on the {size} graph')
        counts = [at[graph, method].steps_per_goal.median for method in LINEAR]
        steps.append(f'{counts[0]:.0f} and {counts[1]:.0f} on the {size} graph')
    hybrid = at['swapped', 'hybrid, linear'], at['swapped', 'hybrid, indexed']
    nearest = at['swapped', 'nearest first, linear']
    return f"""**The cause** has two parts, and an index tells them apart: it makes matching cheap and changes no plan. Of the time that blind and
nearest-first search take for an added goal it saves {', '.join(saved)}, and of the hybrid's
{1.0 - hybrid[1].slope.median / hybrid[0].slope.median:.0%}. {causes(at)} HTN steps are those of driving from each waypoint to the
next, decomposed, tried and sometimes taken back, where the hybrid sends one request: for a goal blind and nearest-first search
decompose and apply {', '.join(steps)}, the hybrid {hybrid[0].steps_per_goal.median:.0f}. A comparison
takes {1e9 * nearest.slope.median / nearest.work_per_goal.median:.0f} ns, and a request has a price of its own, {1e3 * hybrid[1].slope.median:.2f} ms.
"""


def attitudes_text(at: Methods) -> str:
    """What the whole hybrid takes beside the symbolic searches."""
    told = [
        f'{1e3 * at[graph, ATTITUDES_NAME].slope.median:.0f} ms for an added goal on the {size} graph, '
        f'{times_symbolic(at, graph, LINEAR)} times as long as blind and nearest-first search with linear matching, '
        f'{times_symbolic(at, graph, INDEXED)} times as long as with an index'
        for graph, size in SIZES.items()
    ]
    return f"""**Drivable motions** have their price: {ATTITUDES_NAME} takes {'; '.join(told)}.
It looks for attitudes, for motions between the obstacles that a car can drive, and for an order; all others take ways along arcs whose
lengths are known, in the order of the text, with turns at waypoints that no car can drive.
"""


def endings_text(compared: Sequence[Comparison], limit: float) -> str:
    """Why there is no plan, where there is none."""
    ended = [
        f'{one.method} ({one.graph}): {count} {ending}'
        for one in compared
        for ending, count in one.endings.items()
    ]
    if not ended:
        return 'All searches found a plan.\n'
    return f"""Without a plan, by outcome and reason (CANCELLED are those that reached {limit:g} s): {'; '.join(ended)}.
"""
