"""The experiment's figures as tables of text, for people."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from datetime import datetime, timezone
from typing import Any

from experiments.constraints.report import table
from experiments.motion.curve import NO_PATH

INTRODUCTION = """\
# How short, how fast and how safe motions are

The figures of `make experiment-motion` on one machine, written by the experiment itself
(`python -m experiments.motion.run --page docs/motion-benchmark.md`).

- **Worlds**: the paper's (`rover`), a maze with gates half as wide again as the car (`maze`), an open field with
  200 round obstacles (`field`), an office on a map image (`office`) and a map of 4,000 by 4,000 cells (`park`). All are
  made by `experiments/motion/worlds.py` and `maps.py`.
- **Requests** are drawn at random: a free start attitude, and constraints on the attitude to drive to: a photo under an
  angle, a place near an object, a place and heading for docking, a ring from which an object is in view, an angle to an
  object and a distance from two, a ring with a heading. The motion planner chooses the destination and the path.
- **The reference** (`python -m experiments.motion.reference`) is an exhaustive search of its own over x, y and heading:
  the car's three commands, 32 headings, each step a 32nd of a full turn, cells of three quarters of a step, where all was
  looked at in vain once more with 48 headings; words of Dubins from the states near the goal to attitudes of the goal; then local moves of the
  whole way and of its end within the goal, until nothing gets shorter. It shares no code with the motion planner. Its lengths
  are upper bounds of the shortest; where the motion planner is shorter, ratios are below 1. Requests
  that it searched in vain have no length to compare with: they are asked apart from the others. Goals that are walled off
  from the start, for a disc that may turn as it likes, are known from cells of a 32nd of a turning radius and not searched
  for.
- **The judge** of motions integrates the car's equations of motion and measures with shapely
  (`tests/support/vehicle.py`); ends are judged by `experiments/constraints/judge.py`.
- **The usual way** is OMPL's RRTConnect in a Dubins space with its path simplifier, again and again until the time is
  up, the best path counting; points along motions are looked up in a map of distances. Paths that the simplifier
  broke count as they were before.
- **All planners** get the same legs between two attitudes; legs that none of them solves are left out. How many
  iterations it takes depends on the planner and the world: each that samples begins with few and gets twice as many
  until it has a path, for 3 s at most.
- **Searches that are told to stop** are told so by a deadline or by another thread, 0 to 100 ms after they began. Beside
  another robot, which stands at a new place each time, the free space is worked out anew within the request.
- **Through the service** all requests are asked in several rounds, each of a node that has just been started, spread over
  the run. Of the times of a request the least counts, as others use the machine, too; the medians of the fastest and of
  the slowest round stand beside it.
"""

VAIN = """\
What is impossible has a proof; what is found the reference missed, as a search at one grain proves nothing; what is left open
(UNKNOWN) may be possible or not, and that two searches found nothing is all that is known of it."""


def request_table(worlds: Mapping[str, Mapping[str, Any]]) -> str:
    """How the requests were met."""
    rows = [
        (
            name,
            figures['requests'],
            f'{figures["success"]:.1%}',
            f'{figures["ratio_p50"]:.3f}',
            f'{figures["ratio_p95"]:.3f}',
            f'{figures["ratio_max"]:.2f}',
            f'{figures["ms_p50"]:.1f}',
            f'{figures["ms_p95"]:.1f}',
            f'{figures["motions"]}',
            figures['refused_motions'],
        )
        for name, figures in worlds.items()
    ]
    head = (
        'world', 'requests', 'success', 'length p50', 'p95', 'worst', 'ms p50', 'p95', 'motions',
        'refused',
    )  # fmt: skip
    return table(head, rows)


def reference_table(references: Mapping[str, Mapping[str, int]]) -> str:
    """What the reference covers."""
    rows = [
        (name, figures['solved'], figures['searched_in_vain'], figures['broken_off'])
        for name, figures in references.items()
    ]
    return table(('world', 'solved', 'searched exhaustively in vain', 'broken off'), rows)


def vain_table(worlds: Mapping[str, Mapping[str, Any]]) -> str:
    """What the motion planner says where the reference has no way."""
    rows = [
        (
            name,
            figures['requests'],
            *(f'{figures[key]:.1%}' for key in ('impossible', 'unknown', 'found')),
            figures['refused_motions'],
            *(f'{figures[key]:.1f}' for key in ('ms_p50', 'ms_p95', 'ms_max')),
        )
        for name, figures in worlds.items()
    ]
    head = (
        'world', 'requests', 'impossible, proven', 'left open', 'found', 'refused', 'ms p50', 'p95',
        'worst',
    )  # fmt: skip
    return f'{table(head, rows)}\n\n{VAIN}'


def curve_table(curve: Mapping[str, Any]) -> str:
    """Ours at several budgets beside the usual way in the same time."""
    rows = [
        (
            name,
            f'{point["milliseconds"]:.1f} ms',
            f'{point["ratio"]:.3f}',
            f'{point["success"]:.1%}',
            _factor(curve['shorter_at_equal_time'][name]),
            f'{curve["faster_at_equal_length"][name]:.1f}',
        )
        for name, point in curve['ours'].items()
    ]
    head = (
        'budget', 'time p50', 'length p50', 'success', 'usual way, same time: times longer',
        'usual way, same length: times slower',
    )  # fmt: skip
    return table(head, rows)


def planner_table(worlds: Mapping[str, Mapping[str, Any]]) -> str:
    """All planners on the same legs."""
    rows = [
        (
            world,
            measured['legs'],
            name,
            f'{figures["success"]:.0%}',
            f'{figures["ms_p50"]:.1f}',
            f'{figures["ms_p95"]:.1f}',
            *(
                '' if figures[key] is None else f'{figures[key]:.3f}'
                for key in ('ratio_p50', 'ratio_p95')
            ),
        )
        for world, measured in worlds.items()
        for name, figures in measured['planners'].items()
    ]
    head = ('world', 'legs', 'planner', 'success', 'ms p50', 'p95', 'length p50', 'p95')
    return table(head, rows)


def stopping_table(worlds: Mapping[str, Iterable[Mapping[str, Any]]]) -> str:
    """How late answers were that were told to stop, of those that were not there by then."""
    rows = [
        (
            world,
            'yes' if row['beside_another'] else 'no',
            row['told_by'],
            f'{row["stopped"]} of {row["requests"]}',
            *(f'{row[key]:.1f}' for key in ('late_ms_p50', 'late_ms_p99', 'late_ms_max')),
        )
        for world, told in worlds.items()
        for row in told
    ]
    head = (
        'world', 'beside another robot', 'told by', 'not answered by then', 'late ms p50', 'p99',
        'worst',
    )  # fmt: skip
    return table(head, rows)


def figure_table(figures: Mapping[str, Any]) -> str:
    """Names and figures, one in a row."""
    rows = [
        (name.replace('_', ' '), f'{value:.4g}' if isinstance(value, float) else value)
        for name, value in figures.items()
        if isinstance(value, int | float)
    ]
    return table(('', ''), rows)


def _factor(value: float) -> str:
    return 'no path' if value >= NO_PATH else f'{value:.2f}'


def page(
    sections: Iterable[tuple[str, str]],
    machine: Mapping[str, Any],
    images: Iterable[str],
    is_quick: bool,
) -> str:
    """docs/motion-benchmark.md; of a quick run it says so."""
    today = datetime.now(timezone.utc).date().isoformat()
    where = f'{machine["cores"]} cores of {machine["cpu"]}, Python {machine["python"]}'
    extent = ' with `--quick`: a few of everything, to see the form and no more' if is_quick else ''
    body = '\n\n'.join(f'## {title}\n\n{text}' for title, text in sections)
    pictures = '\n\n'.join(f'![{name}](images/{name}.png)' for name in images)
    return f'{INTRODUCTION}\nMeasured on {today}, {where}{extent}.\n\n{body}\n\n{pictures}\n'
