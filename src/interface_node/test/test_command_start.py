"""The first moments of the command: signals while it is being imported."""

from __future__ import annotations

import os
import subprocess
import sys

INTERRUPTED_IMPORT = """
import os, signal, sys

class Interrupter:
    def find_spec(self, name, path=None, target=None):
        if name == 'interface_node.command_line.verbs.plan':
            os.kill(os.getpid(), signal.SIGINT)

sys.meta_path.insert(0, Interrupter())
from interface_node.command_line.main import main
sys.exit(main(['missions']))
"""


def run(script: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, '-c', script],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, 'PYTHONPATH': os.pathsep.join(sys.path)},
    )


def test_a_signal_in_the_middle_of_the_imports_stops_the_command_in_one_line() -> None:
    ended = run(INTERRUPTED_IMPORT)
    assert (ended.returncode, ended.stdout, ended.stderr) == (130, '', 'geohtn: stopped\n')
