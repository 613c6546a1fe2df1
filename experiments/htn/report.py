"""The figures as tables of text, for people."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from datetime import datetime, timezone
from importlib.metadata import version
from typing import Any

from experiments.constraints.report import table
from experiments.htn.comparison import Hddl, Speed

INTRODUCTION = """\
# How fast the task planner is

The figures of `make experiment-htn` on one machine, written by the experiment itself
(`python -m experiments.htn.run --page docs/htn-benchmark.md`).

- **Problems** are random, from a seed, and written out from the same data for every planner
  (`experiments/htn/problems.py`). The SHOP domains are those of `src/task_planner_node/domains`, for blocks and rovers
  with facts that are kept up to date or looked up instead of derived (`experiments/htn/shop`).
- **Times** are processor times, the least of several searches. Reading, checking and compiling the texts is apart:
  GTPyhop's domains are Python already. A decomposition is a task that was decomposed or an operator that was
  applied; GTPyhop's nodes are calls of its actions and methods.
- **GTPyhop** plans blocks with its own packaged example `blocks_htn`; the other domains are written for it method for
  method (`experiments/htn/gtpyhop_domains.py`), with everything that never changes outside of the state that it
  copies. Its two strategies with an explicit stack are tried, and the faster one counts. Every plan of either
  planner is executed by GTPyhop's actions.
- **Aries** gets HDDL files in the manner of the total-order track of the planning competition of 2020
  (`experiments/htn/hddl`), as we do; its time is that of the wall, with reading and starting its server. Plans of
  ours are judged by unified-planning's simulator and validator.
- **Keeping track** is measured by what is noted beyond the plan itself: an entry in the log for each task that was
  decomposed, and the dead ends of a search that has to try everything.
- **Public domains** are not shipped. `python -m experiments.htn.public_domains FOLDER --solve 5` reads and solves those of the
  planning competition (HDDL) in a clone of its repository and has the plans judged;
  `python -m experiments.htn.public_shop FOLDER` does the same with SHOP3's examples.
"""


def speed_table(speeds: Sequence[Speed]) -> str:
    """Ours beside GTPyhop."""
    rows = [
        (
            speed.name,
            speed.actions,
            speed.peer_actions,
            f'{1e3 * speed.reading:.0f} ms',
            f'{1e3 * speed.searching:.1f} ms',
            f'{speed.rate:,.0f}',
            f'{1e3 * speed.peer_searching:.1f} ms',
            f'{speed.peer_rate:,.0f}',
            f'{speed.times_faster:.1f}',
        )
        for speed in speeds
    ]
    head = (
        'problem',
        'actions',
        'of GTPyhop',
        'reading',
        'search',
        'decompositions/s',
        'GTPyhop',
        'nodes/s',
        'times faster',
    )
    return table(head, rows)


def lengths_table(lengths: Sequence[tuple[int, int]]) -> str:
    """Plan lengths of blocks problems."""
    rows: list[tuple[object, ...]] = [(number, *pair) for number, pair in enumerate(lengths, 1)]
    rows.append(('all', sum(a for a, _ in lengths), sum(b for _, b in lengths)))
    return table(('300 blocks', 'actions', 'of GTPyhop'), rows)


def hddl_table(runs: Sequence[Hddl]) -> str:
    """Ours beside Aries."""
    rows = [
        (
            run.name,
            run.actions,
            f'{1e3 * run.seconds:.0f} ms',
            run.fault or 'valid',
            run.peer.outcome.lower().replace('_', ' ') if run.peer else '',
            run.peer.actions or '' if run.peer else '',
            f'{run.peer.seconds:.1f} s' if run.peer else '',
        )
        for run in runs
    ]
    head = ('problem', 'actions', 'all', 'simulator', 'Aries', 'its actions', 'its time')
    return table(head, rows)


def facts_table(facts: Mapping[str, str]) -> str:
    """Single figures."""
    return table(('what', 'figure'), facts.items())


def page(sections: Iterable[tuple[str, str]], machine: Mapping[str, Any]) -> str:
    """docs/htn-benchmark.md."""
    today = datetime.now(timezone.utc).date().isoformat()
    where = f'{machine["cores"]} cores of {machine["cpu"]}, Python {machine["python"]}'
    peers = ', '.join(f'{name} {number}' for name, number in peer_versions().items())
    body = '\n\n'.join(f'## {title}\n\n{text}' for title, text in sections)
    return f'{INTRODUCTION}\nMeasured on {today}, {where}; {peers}.\n\n{body}\n'


def peer_versions() -> Mapping[str, str]:
    """Which versions of the peers are there."""
    return {name: version(name) for name in ('gtpyhop', 'unified_planning', 'up_aries')}
