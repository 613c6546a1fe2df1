"""Whatever happens to a child or to the supervisor itself, no process is left behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from queue import Queue

import pytest

from interface_node.command_line.guard import MARK, end_marked, marked_processes
from interface_node.command_line.supervisor import Supervisor

PATIENCE = 20.0
Starter = Callable[..., tuple[Supervisor, 'Queue[tuple[str, str]]']]

SLEEPER = """
import signal, sys, time
{handlers}
try:
    print('up', flush=True)
    while True:
        time.sleep(1000)
except KeyboardInterrupt:
    print('interrupted', flush=True)
"""
# Also where the tests themselves were started with SIGINT ignored, as background jobs of scripts are.
POLITE = SLEEPER.format(handlers='signal.signal(signal.SIGINT, signal.default_int_handler)')
IGNORES_SIGINT = SLEEPER.format(handlers='signal.signal(signal.SIGINT, signal.SIG_IGN)')
IGNORES_ALL = SLEEPER.format(
    handlers='signal.signal(signal.SIGINT, signal.SIG_IGN)\n'
    'signal.signal(signal.SIGTERM, signal.SIG_IGN)'
)
#: Its child ignores signals; with a session of its own it is in no group that the parent knows.
PARENT = """
import subprocess, sys
subprocess.Popen([sys.executable, '-c', sys.argv[1]], start_new_session={session})
import time
time.sleep(1000)
"""


@pytest.fixture
def supervised(tmp_path: Path) -> Iterator[Starter]:
    """Starts scripts under a supervisor; whatever is left of them at the end is killed."""
    supervisors = []

    def start(*scripts: tuple[str, ...]) -> tuple[Supervisor, Queue[tuple[str, str]]]:
        lines: Queue[tuple[str, str]] = Queue()
        supervisor = Supervisor(
            tmp_path,
            lambda name, line: lines.put((name, line)),
            os.environ,
            interrupt_patience=0.3,
            terminate_patience=0.3,
        )
        supervisors.append(supervisor)
        supervisor.__enter__()
        for k, script in enumerate(scripts):
            supervisor.start(f'child{k}', [sys.executable, '-c', *script])
        return supervisor, lines

    yield start
    for supervisor in supervisors:
        supervisor.stop()
        end_marked(supervisor.token)


def wait_until(condition: Callable[[], bool]) -> bool:
    deadline = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.01)
    return True


def test_children_live_until_they_are_stopped(supervised: Starter, tmp_path: Path) -> None:
    supervisor, lines = supervised((POLITE,), (POLITE,))
    assert {lines.get(timeout=PATIENCE) for _ in range(2)} == {('child0', 'up'), ('child1', 'up')}
    assert supervisor.death() is None
    assert len(marked_processes(supervisor.token)) == 2
    supervisor.stop()
    assert marked_processes(supervisor.token) == []
    assert lines.empty()
    for name in ('child0', 'child1'):
        assert (tmp_path / f'{name}.log').read_text() == 'up\ninterrupted\n'


@pytest.mark.parametrize('script', [IGNORES_SIGINT, IGNORES_ALL], ids=['SIGINT', 'SIGTERM too'])
def test_a_child_that_ignores_signals_is_ended(supervised: Starter, script: str) -> None:
    supervisor, lines = supervised((script,))
    assert lines.get(timeout=PATIENCE) == ('child0', 'up')
    supervisor.stop()
    assert marked_processes(supervisor.token) == []


@pytest.mark.parametrize('session', [False, True], ids=['same session', 'own session'])
@pytest.mark.parametrize('script', [POLITE, IGNORES_ALL], ids=['polite', 'ignores signals'])
def test_grandchildren_are_ended(supervised: Starter, script: str, *, session: bool) -> None:
    supervisor, lines = supervised((PARENT.format(session=session), script))
    assert lines.get(timeout=PATIENCE) == ('child0', 'up')
    assert len(marked_processes(supervisor.token)) == 2
    supervisor.stop()
    assert marked_processes(supervisor.token) == []


def test_grandchildren_of_a_dead_child_are_ended(supervised: Starter) -> None:
    parent = PARENT.format(session=False).replace('time.sleep(1000)', 'sys.exit(4)')
    supervisor, lines = supervised((parent, IGNORES_ALL))
    assert lines.get(timeout=PATIENCE) == ('child0', 'up')
    assert wait_until(lambda: supervisor.death() is not None)
    supervisor.stop()
    assert marked_processes(supervisor.token) == []


def test_a_death_is_noticed_with_its_cause_and_last_words(supervised: Starter) -> None:
    script = "import sys\nfor k in range(100): print('line', k, flush=True)\nsys.exit('the end')"
    supervisor, _ = supervised((POLITE,), (script,))
    assert wait_until(lambda: supervisor.death() is not None)
    death = supervisor.death()
    assert death is not None
    assert death.name == 'child1'
    assert death.reason == 'ended with exit code 1'
    assert 'the end' in death.last_lines
    assert 1 < len(death.last_lines) < 50
    supervisor.stop()
    assert marked_processes(supervisor.token) == []
    assert death.log.read_text().splitlines()[:2] == ['line 0', 'line 1']


def test_the_signal_that_killed_a_child_is_named(supervised: Starter) -> None:
    supervisor, _ = supervised(('import os\nos.abort()',))
    assert wait_until(lambda: supervisor.death() is not None)
    death = supervisor.death()
    assert death is not None
    assert death.reason == 'was ended by SIGABRT'


def test_output_may_be_anything(supervised: Starter, tmp_path: Path) -> None:
    script = (
        'import sys\n'
        "sys.stdout.buffer.write(b'\\xff\\x00 no text\\n' + b'x' * 300000 + b'\\n' + b'no newline')"
    )
    supervisor, lines = supervised((script,))
    assert wait_until(lambda: supervisor.death() is not None)
    supervisor.stop()
    received = [line for _, line in list(lines.queue)]
    assert received[0].endswith('no text')
    assert received[-1].endswith('no newline')
    assert max(map(len, received)) <= 65536
    assert (tmp_path / 'child0.log').stat().st_size == 11 + 300001 + 10


def test_an_error_stops_the_children(tmp_path: Path) -> None:
    lines: Queue[str] = Queue()
    supervisor = Supervisor(tmp_path, lambda name, line: lines.put(line), os.environ)

    def fail() -> None:
        with supervisor:
            supervisor.start('child', [sys.executable, '-c', POLITE])
            assert lines.get(timeout=PATIENCE) == 'up'
            raise RuntimeError

    with pytest.raises(RuntimeError):
        fail()
    assert marked_processes(supervisor.token) == []


def test_what_cannot_be_executed_is_refused(supervised: Starter, tmp_path: Path) -> None:
    supervisor, _ = supervised()
    with pytest.raises(FileNotFoundError):
        supervisor.start('nobody', [str(tmp_path / 'nothing')])
    supervisor.stop()


def test_stopping_twice_is_harmless(supervised: Starter) -> None:
    supervisor, _ = supervised((POLITE,))
    supervisor.stop()
    supervisor.stop()
    assert marked_processes(supervisor.token) == []


SUPERVISING = """
import os, sys, time
from pathlib import Path
from interface_node.command_line.supervisor import Supervisor
with Supervisor(Path(sys.argv[1]), lambda name, line: print(line, flush=True), os.environ) as s:
    print(s.token, flush=True)
    s.start('child', [sys.executable, '-c', sys.argv[2], *sys.argv[3:]])
    time.sleep(1000)
"""


@pytest.mark.parametrize(
    'arguments',
    [(POLITE,), (PARENT.format(session=True), IGNORES_SIGINT)],
    ids=['child', 'grandchild in a session of its own'],
)
def test_children_end_when_the_supervisor_is_killed(
    tmp_path: Path, arguments: tuple[str, ...]
) -> None:
    environment = {**os.environ, 'PYTHONPATH': os.pathsep.join(sys.path)}
    with subprocess.Popen(
        [sys.executable, '-c', SUPERVISING, str(tmp_path), *arguments],
        stdout=subprocess.PIPE,
        text=True,
        env=environment,
        start_new_session=True,
    ) as process:
        assert process.stdout is not None
        token = process.stdout.readline().strip()
        try:
            assert process.stdout.readline().strip() == 'up'
            assert len(marked_processes(token)) == len(arguments)
            process.kill()
            process.wait()
            assert wait_until(lambda: not marked_processes(token))
        finally:
            end_marked(token)


def test_only_marked_processes_are_found() -> None:
    token = 'a' * 32
    with subprocess.Popen(
        [sys.executable, '-c', POLITE],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, MARK: token},
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == 'up\n'
        assert marked_processes(token) == [process.pid]
        assert marked_processes('b' * 32) == []
        end_marked(token)
        with suppress(ProcessLookupError):
            process.send_signal(signal.SIGKILL)
    assert marked_processes(token) == []
