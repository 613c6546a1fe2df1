"""Figures 6 and 7: three methods on problems of growing size, and the whole hybrid as a fourth."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import asdict
from itertools import chain
from pathlib import Path

from experiments.paper.methods.graphs import Graph, literal_graph, rover_world, visibility_graph
from experiments.paper.methods.pictures import (
    draw_figure_6,
    draw_figure_7,
    draw_graphs,
    draw_length_ratios,
)
from experiments.paper.methods.summary import SLOPE_RATIO, Comparison, compare
from experiments.paper.methods.text import claims_of, text_of
from experiments.paper.methods.trials import (
    Bench,
    Sizes,
    Trial,
    run_attitudes,
    run_paper_methods,
)
from experiments.paper.part import Part, write_csv
from experiments.results import Target

Trials = dict[tuple[str, str], list[Trial]]


FULL = Sizes(tuple(range(1, 16)), (1, 8, 15), 20, 2.0)
QUICK = Sizes((2, 4), (2, 4), 1, 2.0)


def measure(sizes: Sizes, seed: int, folder: Path) -> Part:
    """Run all methods on both readings of the graph."""
    world = rover_world()
    dense = visibility_graph(world)
    graphs = dense, literal_graph(dense, world, seed)
    most = min(len(graph.goals) for graph in graphs)
    if max(sizes.goals) > most:
        raise SystemExit(f'the graphs of waypoints have no more than {most} goals')
    trials: Trials = defaultdict(list)
    for graph in graphs:
        bench = Bench(graph, seed, sizes.limit)
        for trial in chain(
            run_paper_methods(bench, sizes.goals, sizes.few_measured, sizes.sets),
            run_attitudes(bench, world, sizes.goals, sizes.sets),
        ):
            trials[trial.graph, trial.method].append(trial)
    compared = comparisons(graphs, trials)
    overall = [one.figures() for one in compared]
    lengths = [row for one in compared for row in one.lengths()]
    write_csv(folder / 'trials.csv', (asdict(t) for members in trials.values() for t in members))
    write_csv(folder / 'comparisons.csv', overall)
    write_csv(folder / 'length_ratios.csv', lengths)
    pictures = (
        draw_graphs(graphs, world, folder / 'graphs'),
        draw_figure_6(graphs, trials, folder / 'figure_6'),
        draw_figure_7(graphs, trials, folder / 'figure_7'),
        draw_length_ratios(graphs, compared, folder / 'length_ratios'),
    )
    return Part(
        'Three methods on problems of growing size (Figures 6 and 7)',
        text_of(graphs, compared, sizes),
        {
            'graphs': {
                graph.name: {
                    'vertices': len(graph.points),
                    'joined': len(graph.joined),
                    'arcs': len(graph.arcs),
                }
                for graph in graphs
            },
            'comparisons': overall,
            'without_a_plan': [
                {'graph': one.graph, 'method': one.method, 'ending': ending, 'trials': count}
                for one in compared
                for ending, count in one.endings.items()
            ],
            'length_ratios': lengths,
        },
        targets_of(compared, len(sizes.goals)),
        claims_of(compared, len(sizes.goals)),
        pictures,
    )


def comparisons(graphs: tuple[Graph, ...], trials: Trials) -> list[Comparison]:
    """Each method beside the hybrid with the same matching, on each graph."""
    found = []
    for graph in graphs:
        for (name, method), members in trials.items():
            if name == graph.name:
                matching = 'linear' if method.endswith('linear') else 'indexed'
                found.append(compare(members, trials[name, f'hybrid, {matching}']))
    return found


def targets_of(compared: list[Comparison], sizes: int) -> list[Target]:
    """At most a twelfth of the time for an added goal, and shorter ways for each number of goals.

    One number of goals tells nothing of what an added one takes.
    """
    targets = []
    for one in compared:
        if one.method in ('blind, linear', 'nearest first, linear'):
            name = f'{one.method}, {one.graph} graph'
            if sizes > 1:
                targets.append(
                    Target(
                        f"time per added goal by the hybrid's, median: {name}",
                        one.slope_ratio.median,
                        SLOPE_RATIO,
                        at_least=True,
                    )
                )
            targets.append(
                Target(
                    f'numbers of goals for which the hybrid drives less: {name}',
                    one.sizes_with_hybrid_shorter,
                    sizes,
                    at_least=True,
                )
            )
    return targets
