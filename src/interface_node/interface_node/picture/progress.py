"""The length of the best plan over the time of the search, as a small curve above the map."""

from __future__ import annotations

from matplotlib.axes import Axes

from interface_node.history import Improvement
from interface_node.picture.terrain import OBSTACLE_EDGE
from interface_node.plan import Plan

#: Left, bottom, width and height of the curve in those of the map.
PLACE = (0.72, 1.015, 0.28, 0.075)
LINE, INK = '#2c7fb8', '#6b7480'


def draw_progress(axes: Axes, plan: Plan) -> None:
    """Draw how the plan was improved, when there was more than one."""
    told = plan.improvements
    if len(told) < 2:
        return
    inset = axes.inset_axes(PLACE)
    end = Improvement(max(plan.planning_time, told[-1].elapsed), told[-1].length)
    times = [point.elapsed for point in (*told, end)]
    lengths = [point.length for point in (*told, end)]
    inset.step(times, lengths, where='post', color=LINE, lw=1.6)
    inset.plot(times[:-1], lengths[:-1], ls='', marker='o', ms=3, color=LINE)
    inset.set_xlim(0, times[-1] * 1.02)
    inset.set_yticks([min(lengths), max(lengths)])
    inset.set_xticks([times[0], times[-1]])
    inset.yaxis.set_major_formatter('{x:,.0f} m')
    inset.xaxis.set_major_formatter('{x:.1f} s')
    inset.xaxis.tick_top()
    inset.tick_params(colors=INK, labelsize=7, length=2, pad=1)
    inset.patch.set_alpha(0.0)
    for name, spine in inset.spines.items():
        spine.set_visible(name in ('left', 'top'))
        spine.set_color(OBSTACLE_EDGE)
