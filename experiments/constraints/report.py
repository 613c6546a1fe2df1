"""The experiment's figures as tables of text, for people."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from datetime import datetime, timezone
from typing import Any

from experiments.constraints.search import Outcome

INTRODUCTION = """\
# How well constraints are solved

The figures of `make experiment-constraints` on one machine, written by the experiment itself
(`python -m experiments.constraints.run --page docs/solving-benchmark.md`).

- **Sets** are data: `experiments/constraints/sets.yaml`, on the map beside it. Each is tried from 1,024
  random attitudes all over the map, in batches of 64. A start counts as solved when the attitude that comes
  out is on the map and a judge that shares no code with the motion planner
  (`experiments/constraints/judge.py`) finds every constraint met within 2e-9.
- **Peers** solve hand-written residuals with analytic Jacobians, in plain math, which for three
  unknowns is faster than numpy (`experiments/constraints/formulations.py`); variables are scaled; SLSQP and IPOPT
  look for the nearest attitude. All methods get the same starts and are asked for 1e-9, and a result within
  1e-6 counts, wherever it lies. A peer's time is its median per start divided by its success; the best peer
  is the one with the least. None of the peers has batches, so batches are set against the same time, the slower
  of both sizes. Everything runs on one thread, and times are what that thread spends on its processor.
- **Compiling** is apart: two processes are started one after the other with an empty cache of compiled code.
- **The service** is asked for take_photo from attitudes that meet it, each another one, so that nothing is remembered
  and no path is planned; the bare exchange is a parameter service of the same node.
"""


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table in Markdown, its columns padded so that it also reads well as text."""
    cells = [[str(cell) for cell in row] for row in (head, *rows)]
    widths = [max(len(row[column]) for row in cells) for column in range(len(head))]

    def line(row: Sequence[str]) -> str:
        first, *others = (cell for cell in row)
        padded = [first.ljust(widths[0])]
        padded += [cell.rjust(width) for cell, width in zip(others, widths[1:], strict=True)]
        return '| ' + ' | '.join(padded) + ' |'

    rule = [
        '-' * widths[0],
        *('-' * (width - 1) + ':' for width in widths[1:]),
    ]
    return '\n'.join([line(cells[0]), line(rule), *map(line, cells[1:])])


def feasible_table(outcomes: Sequence[Outcome]) -> str:
    """How the sets with solutions were solved."""
    rows = [
        (
            outcome.name,
            f'{outcome.solved / outcome.starts:.1%}',
            f'{outcome.batches_solved}/{outcome.batches}',
            f'{outcome.steps:.0f}',
            f'{outcome.worst_violation:.1e}',
        )
        for outcome in outcomes
        if outcome.feasible
    ]
    return table(('set', 'starts solved', 'batches solved', 'steps', 'worst violation'), rows)


def infeasible_table(outcomes: Sequence[Outcome]) -> str:
    """What was said of the sets without solutions."""
    rows = [
        (outcome.name, outcome.solved + outcome.wrong, outcome.proof_by or 'none')
        for outcome in outcomes
        if not outcome.feasible
    ]
    return table(('set', '"found"', 'proven impossible by'), rows)


def alone_table(comparisons: Mapping[str, Any]) -> str:
    """Time and success of one destination, a column per method."""
    methods = list(next(iter(comparisons.values()))['methods'])
    rows = [
        (
            name,
            *(
                f'{figures["median_us"]:.1f} us {figures["success"]:.0%}'
                for figures in comparison['methods'].values()
            ),
            f'{comparison["times_faster_alone"]:.1f}',
        )
        for name, comparison in comparisons.items()
    ]
    return table(('set', *methods, 'faster than the best peer'), rows)


def batch_table(comparisons: Mapping[str, Any]) -> str:
    """Time per destination in batches."""
    sizes = list(next(iter(comparisons.values()))['batches'])
    rows = [
        (
            name,
            *(
                f'{figures["us_per_destination"]:.2f} us {figures["success"]:.0%}'
                for figures in comparison['batches'].values()
            ),
            f'{comparison["times_faster_in_batches"]:.0f}',
        )
        for name, comparison in comparisons.items()
    ]
    head = ('set', *(f'batch of {size}' for size in sizes), 'faster than the best peer')
    return table(head, rows)


def cold_table(processes: Sequence[Mapping[str, Any]]) -> str:
    """What two processes paid, one after the other, from an empty cache."""
    names = list(processes[0]['first_ms'])
    rows = [
        (
            f'process {number}',
            f'{figures["import_ms"]:.0f} ms',
            figures['compiled_functions'],
            *(f'{figures["first_ms"][name]:.1f} ms' for name in names),
            *(f'{1e3 * figures["later_ms"][name]:.0f} us' for name in names),
        )
        for number, figures in enumerate(processes, 1)
    ]
    head = (
        '',
        'imports',
        'functions compiled',
        *(f'first {name}' for name in names),
        *(f'later {name}' for name in names),
    )
    return table(head, rows)


def service_table(service: Mapping[str, Any]) -> str:
    """Median times of exchanges with the node."""
    rows = [(name, f'{value:.3f} ms') for name, value in service['median_ms'].items()]
    rows.append(('take_photo, within the node', f'{service["within_the_node_ms"]:.3f} ms'))
    return table(('exchange', 'median'), rows)


def page(sections: Iterable[tuple[str, str]], machine: Mapping[str, Any]) -> str:
    """docs/solving-benchmark.md."""
    today = datetime.now(timezone.utc).date().isoformat()
    where = f'{machine["cores"]} cores of {machine["cpu"]}, Python {machine["python"]}'
    body = '\n\n'.join(f'## {title}\n\n{text}' for title, text in sections)
    return f'{INTRODUCTION}\nMeasured on {today}, {where}.\n\n{body}\n'
