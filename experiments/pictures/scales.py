"""Scales that can be read without powers of ten."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator


def plain_logarithms(axes: Axes) -> None:
    """Ticks of a logarithmic vertical axis at 1, 2, 5 and their decades; closer ones within a decade."""
    axes.set_yscale('log')
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.yaxis.set_major_formatter('{x:g}')
    axes.minorticks_off()
