"""Starting the installed executables, with fake nodes in an ament prefix of their own."""

from __future__ import annotations

import io
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
import yaml

from interface_node.command_line.console import Console
from interface_node.command_line.errors import CommandError
from interface_node.command_line.main import main
from interface_node.command_line.nodes import (
    NODES,
    NodeSettings,
    node_command,
    unique_namespace,
)
from interface_node.command_line.running_nodes import running_nodes
from interface_node.parameters import PARAMETERS as INTERFACE_PARAMETERS
from interface_node.starting import how_to_start
from motion_planner_node.parameters import specifications
from task_planner_node.parameters import PARAMETERS as TASK_PLANNER_PARAMETERS

PATIENCE = 20.0
SLEEP = 'time.sleep(1000)'
FAKE_NODE = f"""#!{sys.executable}
import os, sys, time
print('[INFO] [1.0] [node]: chatter', flush=True)
print('[WARN] [1.1] [node]: careful', flush=True)
"""
Install = Callable[[str, str], None]


@pytest.fixture
def install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Install:
    """Installs scripts as nodes where AMENT_PREFIX_PATH points."""
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    monkeypatch.chdir(tmp_path)

    def install_script(node: str, script: str) -> None:
        marker = tmp_path / 'share' / 'ament_index' / 'resource_index' / 'packages' / node
        marker.parent.mkdir(parents=True, exist_ok=True)
        marker.touch()
        executable = tmp_path / 'lib' / node / node
        executable.parent.mkdir(parents=True)
        executable.write_text(FAKE_NODE + script)
        executable.chmod(0o755)

    return install_script


def wait_until(condition: Callable[[], bool]) -> None:
    deadline = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def test_a_node_is_started_with_its_settings(install: Install, tmp_path: Path) -> None:
    install('interface_node', SLEEP)
    settings = NodeSettings(
        namespace='team/a',
        log_level='debug',
        parameters=[('interface_node', 'path_spacing', '2.0'), ('task_planner_node', 'x', '1')],
        parameters_file=Path('p.yaml'),
    )
    executable, *arguments = node_command('interface_node', settings)
    assert executable == str(tmp_path / 'lib' / 'interface_node' / 'interface_node')
    assert arguments[0] == '--ros-args'
    text = ' '.join(arguments)
    assert '--log-level debug' in text
    assert '-r __ns:=/team/a' in text
    # What the user sets comes after, and so wins over, what nodes that start together need.
    assert '-p peer_timeout:=15.0 --params-file p.yaml' in text
    assert text.endswith('-p path_spacing:=2.0')


def test_a_node_that_is_not_installed_is_named(
    install: Install, capsys: pytest.CaptureFixture[str]
) -> None:
    install('motion_planner_node', SLEEP)
    assert main(['up']) == 1
    assert 'geohtn: task_planner_node is not installed' in capsys.readouterr().err


def test_without_a_sourced_workspace_that_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv('AMENT_PREFIX_PATH', raising=False)
    with pytest.raises(CommandError, match='source the local_setup file') as caught:
        node_command('interface_node', NodeSettings())
    assert caught.value.exit_code == 3


def test_a_package_without_its_executable_is_said(install: Install, tmp_path: Path) -> None:
    install('interface_node', SLEEP)
    (tmp_path / 'lib' / 'interface_node' / 'interface_node').unlink()
    with pytest.raises(CommandError, match=r'there is no .*lib/interface_node/interface_node'):
        node_command('interface_node', NodeSettings())


@pytest.mark.parametrize('verbose', [False, True])
def test_warnings_reach_the_user_and_everything_the_log(
    install: Install, tmp_path: Path, *, verbose: bool
) -> None:
    for node in NODES:
        install(node, SLEEP)
    err = io.StringIO()
    console = Console(io.StringIO(), err, {})
    logs = tmp_path / 'logs'
    with running_nodes(NodeSettings(), console, logs, verbose=verbose) as check:
        wait_until(lambda: err.getvalue().count('careful') == len(NODES))
        check()
    assert err.getvalue().count('chatter') == (len(NODES) if verbose else 0)
    for node in NODES:
        assert f'{node}: [WARN] [1.1] [node]: careful' in err.getvalue()
        assert (logs / f'{node}.log').read_text().startswith('[INFO] [1.0] [node]: chatter\n')


def test_a_node_that_dies_is_named_with_its_last_words(install: Install, tmp_path: Path) -> None:
    install('motion_planner_node', SLEEP)
    install('task_planner_node', "sys.exit('no more')")
    install('interface_node', SLEEP)
    console = Console(io.StringIO(), io.StringIO(), {})
    with running_nodes(NodeSettings(), console, tmp_path / 'logs') as check:
        caught: list[CommandError] = []

        def died() -> bool:
            try:
                check()
            except CommandError as error:
                caught.append(error)
            return bool(caught)

        wait_until(died)
    assert caught[0].message.startswith('task_planner_node ended with exit code 1')
    assert caught[0].exit_code == 3
    assert caught[0].details[-1] == 'no more'


def test_logs_that_cannot_be_written_are_the_inputs_fault(install: Install, tmp_path: Path) -> None:
    for node in NODES:
        install(node, SLEEP)
    (tmp_path / 'file').touch()
    console = Console(io.StringIO(), io.StringIO(), {})
    with (
        pytest.raises(CommandError, match='cannot be written') as caught,
        running_nodes(NodeSettings(), console, tmp_path / 'file' / 'logs'),
    ):
        pass
    assert caught.value.exit_code == 2


def test_advice_on_starting_nodes_is_a_command_of_this_machine(
    install: Install, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    install('a_node', SLEEP)
    monkeypatch.setenv('PATH', str(tmp_path))
    executable = tmp_path / 'lib' / 'a_node' / 'a_node'
    assert f'`{executable} --ros-args -r __ns:=/team`' in how_to_start(['a_node'], 'team')
    assert f'`{executable}`' in how_to_start(['a_node'], '')
    assert '`ros2 run elsewhere elsewhere`' in how_to_start(['elsewhere'], '')
    (tmp_path / 'ros2').write_text('#!/bin/sh')
    (tmp_path / 'ros2').chmod(0o755)
    assert '`ros2 run a_node a_node --ros-args -r __ns:=/team`' in how_to_start(['a_node'], 'team')
    assert '`ros2 run a_node a_node`' in how_to_start(['a_node'], '')
    assert 'or end the others and start all with `geohtn up`' in how_to_start(['a_node'], '')
    assert '`geohtn up --namespace team`' in how_to_start(['a', 'b'], 'team')
    assert '`geohtn up`' in how_to_start(['a', 'b'], '')


def test_namespaces_are_unique() -> None:
    assert len({unique_namespace() for _ in range(100)}) == 100


def test_installed_missions_are_listed(
    install: Install, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    install('interface_node', SLEEP)
    assert main(['missions']) == 0
    assert capsys.readouterr() == ('', 'no missions are installed\n')
    folder = tmp_path / 'share' / 'interface_node' / 'missions' / 'rover'
    folder.mkdir(parents=True)
    assert main(['missions']) == 0
    assert capsys.readouterr().out == f'rover  {folder}\n'
    assert main(['missions', '--folder', 'rover']) == 0
    assert capsys.readouterr().out == f'{folder}\n'
    assert main(['missions', '--folder', 'rovr']) == 2


@pytest.mark.parametrize('verb', ['run', 'plan'])
def test_a_bad_mission_is_refused_before_anything_starts(
    verb: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([verb, str(tmp_path / 'nowhere')]) == 2
    assert capsys.readouterr().err.startswith('geohtn: there is no folder')
    assert main([verb, str(tmp_path)]) == 2
    err = capsys.readouterr().err
    for name in ('domain.lisp', 'problem.lisp', 'world.yaml'):
        assert f'{tmp_path}/{name}: error: ' in err


@pytest.mark.parametrize('data', [b'', b'no recording', bytes(range(256)) * 100])
def test_a_bad_recording_is_refused_before_anything_starts(
    data: bytes, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / 'broken.mcap'
    file.write_bytes(data)
    for path in (file, tmp_path / 'missing.mcap', tmp_path):
        assert main(['replay', str(path)]) == 2
        err = capsys.readouterr().err
        assert err.startswith('geohtn: ')
        assert path.name in err
        assert err.count('\n') == 1


def test_the_example_parameters_are_the_defaults() -> None:
    file = Path(__file__).parent.parent / 'config' / 'geohtn.yaml'
    tables: dict[str, dict[str, object]] = {
        'motion_planner_node': {row.name: row.default for row in specifications()},
        'task_planner_node': {row.name: row.default for row in TASK_PLANNER_PARAMETERS},
        'interface_node': {row.name: row.default for row in INTERFACE_PARAMETERS},
    }
    written = yaml.safe_load(file.read_text())
    assert set(written) == {f'/**/{node}' for node in NODES}
    for node, table in tables.items():
        for name, value in written[f'/**/{node}']['ros__parameters'].items():
            assert (name, value) == (name, table[name])
            assert type(value) is type(table[name])
