"""How a node is started on this machine, for those to whom it is missing."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_prefix


def start_command(node: str, namespace: str = '') -> str:
    """The command that starts one node: with ``ros2`` where there is one, else its executable."""
    remap = f' --ros-args -r __ns:=/{namespace}' if namespace else ''
    if shutil.which('ros2') is None:
        try:
            return f'{Path(get_package_prefix(node)) / "lib" / node / node}{remap}'
        except (PackageNotFoundError, OSError, ValueError):
            pass  # not installed here: it runs, or is to run, on another machine
    return f'ros2 run {node} {node}{remap}'


def how_to_start(missing: Sequence[str], namespace: str) -> str:
    """Advice for somebody to whom these nodes are missing."""
    everything = f'geohtn up{f" --namespace {namespace}" if namespace else ""}'
    if len(missing) == 1:
        single = f'start it with `{start_command(missing[0], namespace)}`'
        return f'{single}, or end the others and start all with `{everything}`'
    return f'start the nodes with `{everything}`'
