"""What the first destination costs in a new process: ``python -m experiments.constraints.cold``.

Prints one line of JSON. Run twice with the same cache of compiled code, it shows what the second
process no longer pays.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import tempfile
from time import perf_counter
from typing import Any

from experiments.constraints.sets import read_sets

#: Solved in the new process, one after the other.
SETS = ('take_photo', 'photo_with_a_heading', 'resection')
#: Repetitions of what is warm.
REPETITIONS = 50


def measure() -> dict[str, Any]:
    """Times [ms] of the import, of the first destination of each set and of later ones."""
    from numba.core import event

    compiled = event.RecordingListener()
    began = perf_counter()
    from experiments.constraints.search import Bench
    from motion_planner_node.satisfaction import descend

    imported = perf_counter() - began
    bench = Bench()
    sets = {constraints.name: constraints for constraints in read_sets()}
    starts = bench.starts(0, REPETITIONS)
    first: dict[str, float] = {}
    later: dict[str, float] = {}
    with event.install_listener('numba:compile', compiled):
        for name in SETS:
            times = []
            began = perf_counter()
            program = bench.program(sets[name])
            for start in starts:
                descend(program, start[None])
                times.append(1e3 * (perf_counter() - began))
                began = perf_counter()
            first[name], later[name] = times[0], statistics.median(times[1:])
    functions = sum(record.is_start for _, record in compiled.buffer)
    return {
        'import_ms': 1e3 * imported,
        'compiled_functions': functions,
        'first_ms': first,
        'later_ms': later,
    }


def two_processes() -> list[dict[str, Any]]:
    """``measure`` in two processes, one after the other, that begin with an empty cache."""
    with tempfile.TemporaryDirectory() as cache:
        command = [sys.executable, '-m', 'experiments.constraints.cold']
        environment = {**os.environ, 'NUMBA_CACHE_DIR': cache}
        return [
            json.loads(
                subprocess.run(
                    command, env=environment, stdout=subprocess.PIPE, check=True, text=True
                ).stdout
            )
            for _ in range(2)
        ]


if __name__ == '__main__':
    print(json.dumps(measure()))
