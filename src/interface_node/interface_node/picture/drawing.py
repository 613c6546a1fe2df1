"""Drawing a plan in its world: obstacles, objectives, attitudes, viewing lines and the way."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from io import BytesIO
from math import cos, hypot, sin
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgba_array
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from interface_node.driving import sample
from interface_node.footprint import robot_outline
from interface_node.picture.labels import place_labels
from interface_node.picture.legend import legend_handles
from interface_node.picture.marks import (
    Mark,
    draw_marks,
    draw_starts,
    group_marks,
    number_style,
    pill,
)
from interface_node.picture.progress import draw_progress
from interface_node.picture.robots import robot_colors, robots_in_sight, starts
from interface_node.picture.style import BETWEEN, INK, OBJECTIVE, PAIR, PROGRESS, QUIET, VIEW
from interface_node.picture.terrain import (
    OBSTACLE_EDGE,
    REGION_EDGE,
    centroid,
    draw_map,
    draw_obstacles,
    draw_regions,
)
from interface_node.plan import Plan, World

#: Pixels an inch, and inches of the longer side.
DPI, LONG_SIDE = 150, 10.67
#: Room [inches] of the axis' numbers and label.
BELOW_AXIS = 0.6
#: More objects than this are drawn without their labels.
MAX_LABELS = 100


def write_picture(plan: Plan) -> bytes:
    """The picture as a PNG file; the same plan gives the same bytes."""
    buffer = BytesIO()
    draw(plan).savefig(buffer, format='png', dpi=DPI, metadata={'Software': None})
    return buffer.getvalue()


def draw(plan: Plan) -> Figure:
    """Draw the plan in its world, or only the world when there is no plan.

    Raises ValueError when the plan has no world.
    """
    world = plan.world
    if world is None:
        raise ValueError('a plan without a world cannot be drawn')
    x_min, y_min, x_max, y_max = world.bounds
    shape = min(2.0, max(0.5, (y_max - y_min) / (x_max - x_min)))
    width = LONG_SIDE * min(1.0, 1 / shape)
    figure = Figure(figsize=(width, LONG_SIDE * min(1.0, shape)), dpi=DPI, layout='constrained')
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    axes.set_aspect('equal')
    axes.set_xlim(x_min, x_max)
    axes.set_ylim(y_min, y_max)
    axes.set_xlabel('x [m]', color=QUIET)
    axes.set_ylabel('y [m]', color=QUIET)
    axes.tick_params(colors=QUIET, labelsize=9)
    for spine in axes.spines.values():
        spine.set_color(OBSTACLE_EDGE)
    axes.set_title(_title(plan), loc='left', fontsize=13, color=INK, parse_math=False)

    draw_progress(axes, plan)
    draw_regions(axes, world)
    draw_map(axes, world)
    draw_obstacles(axes, world)
    colors = robot_colors(plan)
    way = _draw_way(axes, plan, world, colors)
    looked_at = _draw_viewing_lines(axes, plan, world)
    _draw_objects(axes, world)
    _draw_footprints(axes, plan, world)
    marks = group_marks(plan, colors, _size(world) / 80)
    draw_marks(axes, marks, _size(world) / 26)
    draw_starts(axes, starts(plan), colors)
    axes.legend(
        handles=legend_handles(plan, world, colors),
        loc='upper center',
        # Below the axis and its label, which take the same room in every picture.
        bbox_to_anchor=(0.5, -BELOW_AXIS / figure.get_figheight()),
        ncols=8,
        frameon=False,
        fontsize=9,
        labelcolor=INK,
        handletextpad=0.5,
        columnspacing=1.6,
    )
    _draw_labels(figure, axes, world, marks, np.vstack([way, looked_at]))
    return figure


def _title(plan: Plan) -> str:
    name = plan.mission or 'mission'
    if plan.outcome != 'SOLVED':
        return f'{name}: {plan.outcome}'
    actions = f'{len(plan.steps)} action{"" if len(plan.steps) == 1 else "s"}'
    return f'{name}: {actions}, {plan.length:,.0f} m'


def _draw_way(
    axes: Axes, plan: Plan, world: World, robots: Mapping[str, str]
) -> NDArray[np.float64]:
    """Draw what is driven; give the points that it passes, (n, 2) [m].

    Coloured by robot with the colours ``robots``, by progress when there are none.
    """
    spacing = _size(world) / 400
    legs, drivers = [], []
    for step in plan.steps:
        robot = world.robot(step.agent)
        if step.segments and step.start and robot:
            legs.append(sample(step.start, step.segments, robot.wheelbase, spacing)[:, :2])
            drivers += [robots.get(step.agent, BETWEEN)] * (len(legs[-1]) - 1)
    if not legs:
        return np.empty((0, 2))
    pieces = np.vstack([np.stack([leg[:-1], leg[1:]], axis=1) for leg in legs])
    lengths = np.hypot(*(pieces[:, 1] - pieces[:, 0]).T)
    driven = np.cumsum(lengths)
    progress = PROGRESS(driven / driven[-1] if driven[-1] else driven)
    colors = to_rgba_array(drivers) if robots else progress
    axes.add_collection(
        LineCollection(list(pieces), colors=colors, linewidths=2.4, capstyle='round', zorder=4)
    )
    _draw_chevrons(axes, pieces, driven, colors, _size(world) / 12)
    return np.vstack(legs)


def _draw_chevrons(
    axes: Axes,
    pieces: NDArray[np.float64],
    driven: NDArray[np.float64],
    colors: NDArray[np.float64],
    every: float,
) -> None:
    """Small arrow heads along the way, ``every`` so many metres: which way it is driven."""
    size = every / 12
    at = np.unique(np.searchsorted(driven, np.arange(every / 2, driven[-1], every)))
    for piece, color in zip(pieces[at], colors[at], strict=True):
        direction = piece[1] - piece[0]
        length = hypot(*direction)
        if not length:
            continue
        along = direction / length * size
        across = np.array([-along[1], along[0]]) * 0.75
        corners = [piece[1] + along, piece[1] - along / 2 + across, piece[1] - along / 2 - across]
        axes.add_patch(
            Polygon(corners, closed=True, facecolor=color, edgecolor='white', lw=0.5, zorder=5)
        )


def _draw_viewing_lines(axes: Axes, plan: Plan, world: World) -> NDArray[np.float64]:
    lines = [
        ((step.end.x, step.end.y), world.objects[label])
        for step in plan.steps
        if step.end and not step.assigned
        for label in step.objects
        if label in world.objects
    ]
    axes.add_collection(
        LineCollection(lines, colors=INK, linewidths=1.0, linestyles=VIEW, zorder=3)
    )
    between = [
        ((step.end.x, step.end.y), (other.x, other.y))
        for step in plan.steps
        if step.end and not step.assigned
        for other in robots_in_sight(step)
    ]
    if between:
        axes.add_collection(
            LineCollection(between, colors=INK, linewidths=1.1, linestyles=PAIR, zorder=3)
        )
        lines += between
    share = np.linspace(0, 1, 20)[:, None]
    points = [np.array(a) * (1 - share) + np.array(b) * share for a, b in lines]
    return np.vstack([np.empty((0, 2)), *points])


def _draw_objects(axes: Axes, world: World) -> None:
    for label, (x, y) in world.objects.items():
        axes.plot(
            x,
            y,
            marker='s',
            markersize=9,
            color=OBJECTIVE,
            markeredgecolor=INK,
            markeredgewidth=0.9,
            # Above the arrows of those who look at it.
            zorder=7.2,
            gid=label,
        )


def _draw_footprints(axes: Axes, plan: Plan, world: World) -> None:
    """Draw the footprints where actions end; a disc would only look like the attitude's mark."""
    for step in plan.steps:
        robot = world.robot(step.agent)
        if robot and robot.footprint and step.end:
            corners = robot_outline(robot, step.end)
            axes.add_patch(
                Polygon(corners, closed=True, fill=False, edgecolor=INK, lw=1.0, zorder=6.5)
            )


def _draw_labels(
    figure: Figure,
    axes: Axes,
    world: World,
    marks: Sequence[Mark],
    lines: NDArray[np.float64],
) -> None:
    """Write names, and numbers that fit no mark, where they cover least in the settled layout."""
    halo = [withStroke(linewidth=3, foreground='white')]
    name: dict[str, Any] = {'fontsize': 9.5, 'color': INK, 'path_effects': halo}
    region = {**name, 'fontsize': 8.5, 'color': REGION_EDGE, 'fontstyle': 'italic'}
    labels: list[tuple[str, tuple[float, float], dict[str, Any]]] = [
        *(
            (
                mark.text,
                (mark.place.x, mark.place.y),
                number_style(mark) | {'bbox': pill(mark.color)},
            )
            for mark in marks
            if mark.crowded
        ),
        *((shape.name, centroid(shape), region) for shape in world.regions),
    ]
    if len(world.objects) <= MAX_LABELS:
        labels = [*((label, place, name) for label, place in world.objects.items()), *labels]
    if not labels:
        return
    texts = [
        axes.annotate(
            label,
            place,
            xytext=(0, 0),
            textcoords='offset pixels',
            ha='center',
            va='center',
            parse_math=False,
            # What lies outside of the map, as the middle of a region may, has no label.
            annotation_clip=True,
            zorder=10,
            **style,
        )
        for label, place, style in labels
    ]
    figure.draw_without_rendering()
    extents = [text.get_window_extent() for text in texts]
    pixels = axes.transData.transform
    anchors = [tuple(point) for point in pixels([place for _, place, _ in labels])]
    crowd = np.vstack(
        [
            pixels(lines.reshape(-1, 2)),
            # Markers have an extent: five points each, weighed like a piece of the way.
            *(_block(pixels(mark), 8) for mark in world.objects.values()),
            *(
                _block(pixels((mark.place.x, mark.place.y)) + np.array([shift, 0.0]), 16)
                for mark in marks
                # Two numbers lie side by side.
                for shift in ((-8.0, 8.0) if len(mark.numbers) == 2 else (0.0,))
            ),
            *(
                _arrow_points(pixels((mark.place.x, mark.place.y)), heading)
                for mark in marks
                for heading in mark.headings
            ),
        ]
    )
    frame = axes.get_window_extent()
    centers = place_labels(
        anchors,
        [(extent.width + 4, extent.height + 2) for extent in extents],
        14.0,
        crowd,
        (frame.x0, frame.y0, frame.x1, frame.y1),
    )
    for text, anchor, center in zip(texts, anchors, centers, strict=True):
        text.set_position((center[0] - anchor[0], center[1] - anchor[1]))


def _block(center: NDArray[np.float64], half: float) -> NDArray[np.float64]:
    offsets = np.linspace(-half, half, 5)
    return np.array([(center[0] + dx, center[1] + dy) for dx in offsets for dy in offsets])


def _arrow_points(origin: NDArray[np.float64], heading: float) -> NDArray[np.float64]:
    reach = np.linspace(16, 64, 9)[:, None]
    direction = np.array([cos(heading), sin(heading)])
    points: NDArray[np.float64] = origin + reach * direction
    return points


def _size(world: World) -> float:
    """The longer side of the map [m]."""
    x_min, y_min, x_max, y_max = world.bounds
    return max(x_max - x_min, y_max - y_min)
