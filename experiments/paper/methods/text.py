"""The part's section: how the graphs and the methods were made, and the table of figures."""

from __future__ import annotations

from collections.abc import Sequence

from experiments.paper.methods.findings import (
    LINEAR,
    VARIANTS,
    attitudes_text,
    cause_text,
    causes,
    endings_text,
    ratios,
    target_text,
    times_symbolic,
)
from experiments.paper.methods.graphs import Graph
from experiments.paper.methods.summary import Comparison, spread
from experiments.paper.methods.trials import ATTITUDES_NAME, Sizes
from experiments.paper.part import Claim
from experiments.paper.report import table

HEAD = (
    'method, matching',
    'ms for an added goal',
    'times the hybrid',
    'tried and compared for a goal',
    'decomposed and applied for a goal',
    "length by the hybrid's, all sizes",
    'hybrid shorter',
    'without a plan',
)


def text_of(graphs: Sequence[Graph], compared: Sequence[Comparison], sizes: Sizes) -> str:
    """The section in Markdown."""
    dense, sparse = graphs
    few = ', '.join(map(str, sizes.few_measured))
    only = (
        'Indexed symbolic searches and the two variants of blind search are tried with few numbers of goals '
        f'only: {few}.'
    )
    parts = [
        f"""The waypoints are the objects of the rover's world and the corners of its obstacles, grown by the rover's radius, with
heptagons for the round ones; two waypoints that see each other have an arc in each direction, which is a fact
`(can_traverse a b)`. The paper's graph has "70 edges and 1126 vertices". **Swapped reading**: the whole visibility graph, which
has {len(dense.points)} vertices and {len(dense.arcs)} arcs here. **Literal reading**: {len(sparse.arcs)} arcs (shortest spanning tree and
the shortest others) between {len(sparse.joined)} of these waypoints, far from each other; random places without an arc make it
{len(sparse.points)} vertices.

Photos are taken at waypoints, in the order of the text, from one start. **Blind** drives to the first waypoint of the
facts that can be reached, **nearest first** to the one nearest to the rover. **Hybrid** knows no waypoint: each photo's
geometric precondition is a request, answered by one run of Dijkstra's algorithm (rustworkx) on the same graph. Matching is
**linear** where each literal is compared with one fact of its predicate after the other, and no further than is asked
for, as in the paper, and **indexed** where the task planner looks facts up, as it does by default. The
fourth method is **{ATTITUDES_NAME}**: the paper's photos, advice, and motions that the rover can drive, on the same goals.
Of a graph it is told only where the goals are: the tables of the two readings have it with different sets of goals.

The rule for dead ends: a waypoint passed on the way to the present goal is a fact and is not passed again; where no
other is left, the search takes steps back. Without any such rule a blind search drives between two waypoints for ever. With it,
a dead end may be run into again on every other way that leads there: those searches end at {sizes.limit:g} s of
processor time. Left to the search, which remembers what failed, no waypoint has to be noted ("circles left to the search").

For each of {len(sizes.goals)} numbers of goals {sizes.sets} random sets. Time is processor time of the search, without reading. Its slope is that
of a straight line through the sizes of one series of sets; the tables give the median over {sizes.sets} series, and quartiles in brackets.
Searches without a plan are left out of slopes and lengths, in favour of the method that failed.
{only if sizes.few_measured != sizes.goals else ''}
"""
    ]
    for graph in graphs:
        rows = [_row(one) for one in compared if one.graph == graph.name]
        parts.append(f'{graph.name.capitalize()} reading:\n\n{table(HEAD, rows)}\n')
    at = {(one.graph, one.method): one for one in compared}
    # One number of goals tells nothing of what an added one takes.
    if len(sizes.goals) > 1:
        parts += [target_text(at), cause_text(at), attitudes_text(at)]
    parts.append(endings_text(compared, sizes.limit))
    parts.append(
        'The pictures show medians, and bands between the quartiles; the last one shows the distances '
        "set by set over the hybrid's, which `length_ratios.csv` has in figures.\n"
    )
    return '\n'.join(parts)


def _row(one: Comparison) -> list[object]:
    medians = spread(ratio.median for ratio in one.length_ratios.values())
    itself = one.method.startswith('hybrid,')
    return [
        one.method,
        one.slope.shown(2, 1e3),
        '' if itself else one.slope_ratio.shown(1),
        one.work_per_goal.shown(0),
        one.steps_per_goal.shown(0),
        '' if itself else f'{medians.least:.2f} to {medians.greatest:.2f}',
        '' if itself else f'{one.hybrid_shorter} of {one.compared}',
        f'{one.unsolved} of {one.trials}',
    ]


def claims_of(compared: Sequence[Comparison], sizes: int) -> list[Claim]:
    """The paper's three sentences on Figures 6 and 7."""
    at = {(one.graph, one.method): one for one in compared}
    blind, nearest = at['swapped', 'blind, linear'], at['swapped', 'nearest first, linear']
    sparse = at['literal', 'blind, linear'], at['literal', 'nearest first, linear']
    # One number of goals tells nothing of what an added one takes.
    several = sizes > 1
    variants = [ratios(at, graph, VARIANTS) for graph in ('swapped', 'literal')]
    added = [
        Claim(
            'An added goal costs 50 s with a symbolic search against 4 s with the hybrid (Figure 6).',
            f'{blind.slope_ratio.median:.0f} (blind) and {nearest.slope_ratio.median:.0f} (nearest first) '
            f'times as much with linear matching on the large graph, '
            f'{sparse[0].slope_ratio.median:.1f} and {sparse[1].slope_ratio.median:.1f} times on the small one; '
            f'two variants of blind search that the paper does not describe take {variants[0]} times as much on the large '
            f'graph, {variants[1]} times on the small one. '
            f'The whole hybrid plans drivable motions besides: it takes {times_symbolic(at, "swapped", LINEAR)} times '
            f'as long as blind and nearest-first search on the large graph, '
            f'{times_symbolic(at, "literal", LINEAR)} times on the small one.',
        ),
    ]
    return [
        *(added if several else []),
        Claim(
            'The cause is the search for a predicate to unify with; nearest-first costs more, as it looks for all of them.',
            f'For each goal the blind search tries and compares {blind.work_per_goal.median:.0f} times '
            f"({blind.work_ratio.median:.0f} times the hybrid's figure), nearest-first "
            f'{nearest.work_per_goal.median:.0f} times ({nearest.work_ratio.median:.0f}), on the small graph '
            f'{sparse[0].work_ratio.median:.0f} and {sparse[1].work_ratio.median:.0f} times as often as the hybrid.'
            + (f' {causes(at)}' if several else ''),
        ),
        Claim(
            'The hybrid drives less than either symbolic search (Figure 7).',
            '; '.join(
                f'{one.method.partition(",")[0]}, {one.graph} graph: in {one.hybrid_shorter} of {one.compared} sets, '
                f'in the median for {one.sizes_with_hybrid_shorter} of {sizes} numbers of goals'
                for one in (blind, nearest, *sparse)
            )
            + '. A shortest way between the same goals in the same order cannot be longer.',
        ),
    ]
