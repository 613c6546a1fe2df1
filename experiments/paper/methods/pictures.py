"""The graphs, and Figures 6 and 7 with the spread over sets of goals."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import matplotlib

matplotlib.use('Agg')

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle as Disc
from matplotlib.patches import Polygon as Outline

from experiments.paper.methods.graphs import START, Graph
from experiments.paper.methods.summary import Comparison, Spread, by_size, spread
from experiments.paper.methods.trials import ATTITUDES_NAME, Trial
from experiments.pictures.scales import plain_logarithms
from motion_planner_node.world.model import Polygon, World

COLOURS = {'blind': 'tab:blue', 'nearest first': 'tab:orange', 'hybrid': 'tab:green'}
TITLES = {
    'swapped': 'swapped reading: {} vertices, {} arcs',
    'literal': 'literal reading: {} vertices, {} arcs',
}
Trials = Mapping[tuple[str, str], Sequence[Trial]]
#: The spread of a figure by the number of goals, by graph and method.
Curves = Mapping[tuple[str, str], Mapping[int, Spread]]


def save(figure: Figure, stem: Path) -> Path:
    """Write a figure as SVG and PNG, and return the latter's path."""
    png = stem.with_suffix('.png')
    figure.savefig(stem.with_suffix('.svg'))
    figure.savefig(png, dpi=110)
    plt.close(figure)
    return png


def title_of(graph: Graph) -> str:
    """Which reading, and its numbers."""
    return TITLES[graph.name].format(len(graph.points), len(graph.arcs))


def draw_graphs(graphs: Sequence[Graph], world: World, stem: Path) -> Path:
    """Both graphs among the obstacles."""
    figure, panels = plt.subplots(1, len(graphs), figsize=(12.0, 5.0), layout='constrained')
    for axes, graph in zip(panels, graphs, strict=True):
        for obstacle in world.obstacles:
            if isinstance(obstacle, Polygon):
                axes.add_patch(Outline(obstacle.corners, color='0.35'))
            else:
                axes.add_patch(Disc(obstacle.center, obstacle.radius, color='0.35'))
        lines = [(graph.points[a], graph.points[b]) for a, b in graph.arcs if a < b]
        axes.add_collection(LineCollection(lines, colors='tab:blue', lw=0.4))
        joined = set(graph.joined)
        alone = [place for label, place in graph.points.items() if label not in joined]
        if alone:
            axes.plot(*zip(*alone, strict=True), '.', color='0.7', ms=2)
        axes.plot(*zip(*(graph.points[label] for label in joined), strict=True), 'C0o', ms=4)
        axes.plot(*graph.points[START], 'o', color='tab:green', ms=7)
        bounds = world.bounds
        axes.set(xlim=(bounds.x_min, bounds.x_max), ylim=(bounds.y_min, bounds.y_max))
        axes.set(aspect='equal', xlabel='x [m]', ylabel='y [m]')
        axes.set_title(title_of(graph), fontsize=10)
    return save(figure, stem)


def draw_figure_6(graphs: Sequence[Graph], trials: Trials, stem: Path) -> Path:
    """Processor time by the number of goals."""
    curves = _curves(trials, lambda trial: trial.seconds)
    return save(_drawn(graphs, curves, 'processor time of the search [s]'), stem)


def draw_figure_7(graphs: Sequence[Graph], trials: Trials, stem: Path) -> Path:
    """Distance by the number of goals."""
    curves = _without_indexed(_curves(trials, lambda trial: trial.length))
    return save(_drawn(graphs, curves, 'distance [m]'), stem)


def draw_length_ratios(graphs: Sequence[Graph], compared: Sequence[Comparison], stem: Path) -> Path:
    """Distance over the hybrid's, set by set, by the number of goals."""
    curves = _without_indexed({(one.graph, one.method): one.length_ratios for one in compared})
    figure = _drawn(graphs, curves, "distance over the hybrid's", shared=False)
    for axes in figure.axes:
        plain_logarithms(axes)
    return save(figure, stem)


def _curves(trials: Trials, value: Callable[[Trial], float]) -> Curves:
    """The spread over the trials with a plan."""
    return {
        key: {
            goals: spread(value(trial) for trial in group)
            for goals, group in by_size(trial for trial in members if trial.solved).items()
        }
        for key, members in trials.items()
    }


def _without_indexed(curves: Curves) -> Curves:
    """Matching does not change lengths."""
    return {key: curve for key, curve in curves.items() if not key[1].endswith('indexed')}


def _drawn(graphs: Sequence[Graph], curves: Curves, label: str, *, shared: bool = True) -> Figure:
    """A panel for each graph, with the paper's three methods and the whole hybrid."""
    figure, panels = plt.subplots(
        1, len(graphs), figsize=(12.0, 5.4), layout='constrained', sharey=shared
    )
    for axes, graph in zip(panels, graphs, strict=True):
        for (name, method), curve in curves.items():
            base = method.partition(', ')[0]
            everywhere = base in COLOURS and method.count(',') == 1
            if name == graph.name and (everywhere or method == ATTITUDES_NAME):
                _band(axes, method, curve)
        axes.set(xlabel='goals', yscale='log')
        axes.set_title(title_of(graph), fontsize=10)
        axes.grid(alpha=0.3)
    panels[0].set_ylabel(label)
    figure.legend(
        *panels[0].get_legend_handles_labels(), loc='outside lower center', ncols=4, fontsize=8
    )
    return figure


def _band(axes: Axes, method: str, curve: Mapping[int, Spread]) -> None:
    """The medians, and a band between the quartiles."""
    colour = COLOURS.get(method.partition(', ')[0], 'tab:red')
    dashed = method.endswith('indexed')
    axes.plot(
        list(curve),
        [each.median for each in curve.values()],
        '--' if dashed else '-',
        color=colour,
        label=method,
    )
    axes.fill_between(
        list(curve),
        [each.lower for each in curve.values()],
        [each.upper for each in curve.values()],
        color=colour,
        alpha=0.1 if dashed else 0.25,
        lw=0,
    )
