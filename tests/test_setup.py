"""The set-up's parts that can go wrong without a word: what it needs, what it redoes, what it rewrites."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from workspace import build, cmake_paths, commands, environment, packages, prerequisites, stamps
from workspace.layout import Layout
from workspace.main import only_one
from workspace.problems import SetUpError
from workspace.ros import SourcedRos, find_sourced_ros

ROOT = Path(__file__).resolve().parent.parent


# What the machine must have


def test_a_machine_with_everything_passes(tmp_path: Path) -> None:
    (tmp_path / 'Python.h').touch()
    prerequisites.check_tools(lambda tool: f'/usr/bin/{tool}', lambda name: True, tmp_path)
    prerequisites.check_platform('linux', 'x86_64', ('glibc', '2.28'))


@pytest.mark.parametrize(
    ('present', 'modules', 'header', 'installs'),
    [
        ({'make', 'g++'}, True, True, 'sudo apt install cmake'),
        ({'cmake', 'g++'}, True, True, 'sudo apt install make'),
        ({'cmake', 'make'}, True, True, 'sudo apt install g++'),
        ({'make'}, True, True, 'sudo apt install cmake g++'),
        ({'cmake', 'make', 'g++'}, False, True, '-venv'),
        ({'cmake', 'make', 'g++'}, True, False, '-dev'),
    ],
)
def test_what_is_missing_is_named_with_its_command_in_one_line(
    tmp_path: Path, present: set[str], modules: bool, header: bool, installs: str
) -> None:
    if header:
        (tmp_path / 'Python.h').touch()
    with pytest.raises(SetUpError) as caught:
        prerequisites.check_tools(
            lambda tool: tool if tool in present else None, lambda name: modules, tmp_path
        )
    assert str(caught.value).endswith(installs)
    assert '\n' not in str(caught.value)


@pytest.mark.parametrize(
    ('system', 'machine', 'libc'),
    [
        ('linux', 'aarch64', ('glibc', '2.36')),
        ('linux', 'x86_64', ('glibc', '2.27')),
        ('linux', 'x86_64', ('', '')),
        ('darwin', 'x86_64', ('', '')),
    ],
)
def test_where_the_wheels_do_not_run_ros_itself_is_recommended(
    system: str, machine: str, libc: tuple[str, str]
) -> None:
    with pytest.raises(SetUpError, match=f'this is {machine} {system}.*ros-jazzy-ros-base'):
        prerequisites.check_platform(system, machine, libc)


def test_an_old_python_is_told_so_in_one_line() -> None:
    code = (
        'import runpy, sys; sys.version_info = (3, 8, 18, "final", 0); '
        'runpy.run_path("set_up.py", run_name="__main__")'
    )
    ended = subprocess.run(
        [sys.executable, '-c', code],
        cwd=ROOT / 'ros2_ws',
        capture_output=True,
        text=True,
        check=False,
    )
    assert ended.returncode == 2
    assert 'is 3.8' in ended.stderr
    assert 'sudo apt install' in ended.stderr
    assert ended.stderr.count('\n') == 1


@pytest.mark.parametrize('name', ['my robots', 'a:b', 'it;s'])
def test_a_path_that_cannot_be_built_in_is_refused(name: str) -> None:
    with pytest.raises(SetUpError, match='move the checkout'):
        Layout(Path('/home') / name)


# Which ROS 2


def ros_prefix(folder: Path, *, venv: bool) -> Path:
    (folder / 'lib' / 'python3.12' / 'site-packages' / 'rclpy').mkdir(parents=True)
    if venv:
        (folder / 'pyvenv.cfg').touch()
    return folder


def test_a_sourced_jazzy_is_found_behind_overlays(tmp_path: Path) -> None:
    prefix = ros_prefix(tmp_path / 'jazzy', venv=False)
    sourced = {'ROS_DISTRO': 'jazzy', 'AMENT_PREFIX_PATH': f'{tmp_path}/overlay:{prefix}'}
    assert find_sourced_ros(sourced) == SourcedRos(prefix, (3, 12))


def test_our_own_activated_environment_counts_as_none(tmp_path: Path) -> None:
    prefix = ros_prefix(tmp_path, venv=True)
    assert find_sourced_ros({'ROS_DISTRO': 'jazzy', 'AMENT_PREFIX_PATH': str(prefix)}) is None
    assert find_sourced_ros({}) is None


@pytest.mark.parametrize(
    'sourced',
    [
        {'ROS_DISTRO': 'humble', 'ROS_VERSION': '2', 'AMENT_PREFIX_PATH': '/opt/ros/humble'},
        {'ROS_DISTRO': 'noetic', 'ROS_VERSION': '1'},
    ],
)
def test_another_distribution_is_refused_in_one_line(sourced: dict[str, str]) -> None:
    with pytest.raises(SetUpError, match=f'ROS {sourced["ROS_DISTRO"]} is sourced') as caught:
        find_sourced_ros(sourced)
    assert '\n' not in str(caught.value)


def test_the_python_of_the_sourced_ros_is_found_or_asked_for(tmp_path: Path) -> None:
    assert prerequisites.python_of(SourcedRos(tmp_path, sys.version_info[:2])) is None
    with pytest.raises(SetUpError, match=r'sudo apt install python3\.77 python3\.77-venv'):
        prerequisites.python_of(SourcedRos(tmp_path, (3, 77)), str(tmp_path))
    other = tmp_path / 'python3.77'
    other.touch(mode=0o755)
    assert prerequisites.python_of(SourcedRos(tmp_path, (3, 77)), str(tmp_path)) == other


# What is installed


def test_every_requirement_is_pinned() -> None:
    layout = Layout(ROOT)
    pins = packages.pins_beside_wheels(layout)
    assert all('==' in pin.split(';')[0] for pin in pins)
    assert 'ros-rclpy==7.1.6' in pins


def test_a_sourced_ros_gets_neither_ros_nor_numpy_and_keeps_what_it_has() -> None:
    there = {'matplotlib': '3.6.3', 'pyyaml': '6.0.1', 'ruff': '0.1.0', 'lark': '1.1.9'}
    names = {
        packages.normalised(pin.split('==')[0])
        for pin in packages.pins_beside_ros(Layout(ROOT), there)
    }
    assert not any(name.startswith('ros-') for name in names)
    assert names.isdisjoint({'numpy', 'matplotlib', 'pyyaml', 'lark-parser'})
    assert {'ompl', 'colcon-core', 'ruff', 'pytest'} <= names


# Repaired paths


def test_the_builders_paths_are_replaced_once_and_for_all(tmp_path: Path) -> None:
    (tmp_path / 'share' / 'cmake').mkdir(parents=True)
    config = tmp_path / 'share' / 'cmake' / 'aConfig.cmake'
    config.write_text(
        'set(i "/opt/python/cp311-cp311/include/python3.11;/usr/include")\n'
        'set(n /opt/python/cp311-cp311/lib/python3.11/site-packages/numpy/_core/include)\n'
        "set(p '/project/build/temp.linux-x86_64-cpython-311/install/lib')\n"
    )
    untouched = tmp_path / 'share' / 'cmake' / 'readme.txt'
    untouched.write_text('/project/build/temp.x/install')
    places = {'include': Path('/inc'), 'packages': Path('/venv/lib/p')}
    assert cmake_paths.repair_prefix(tmp_path, **places) == 1
    assert config.read_text() == (
        f'set(i "/inc;/usr/include")\nset(n /venv/lib/p/numpy/_core/include)\n'
        f"set(p '{tmp_path}/lib')\n"
    )
    assert untouched.read_text() == '/project/build/temp.x/install'
    assert cmake_paths.repair_prefix(tmp_path, **places) == 0


# What is done again


@given(
    st.lists(st.text(alphabet='ab:1'), max_size=3), st.lists(st.text(alphabet='ab:1'), max_size=3)
)
def test_two_inputs_share_a_fingerprint_only_if_they_are_equal(
    one: list[str], other: list[str]
) -> None:
    assert (stamps.fingerprint(one) == stamps.fingerprint(other)) == (one == other)


def checkout(root: Path) -> Layout:
    """A small checkout that has all that the build's fingerprint looks at."""
    files = {
        'msgs/msg/A.msg': 'bool a\n',
        'src/p/setup.py': 'setup()\n',
        'src/p/p/node.py': 'x = 1\n',
        'src/p/test/test_p.py': '',
        'ros2_ws/colcon_defaults.yaml': '',
    }
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    return Layout(root)


@pytest.mark.parametrize(
    ('path', 'again'),
    [
        ('msgs/msg/A.msg', True),  # a message's text
        ('msgs/msg/B.msg', True),
        ('src/p/setup.py', True),
        ('src/p/launch/new.launch.py', True),  # a link to a new file
        ('src/p/p/node.py', False),  # installed as a link
        ('src/p/test/test_p.py', False),
        ('src/p/p/__pycache__/node.cpython-312.pyc', False),
    ],
)
def test_the_build_is_repeated_for_what_it_reads(tmp_path: Path, path: str, again: bool) -> None:
    layout = checkout(tmp_path)
    before = build.wanted(layout, 'venv')
    (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / path).write_text('changed')
    assert (build.wanted(layout, 'venv') != before) == again
    assert build.wanted(layout, 'another venv') != build.wanted(layout, 'venv')


def test_a_step_without_its_own_stamp_is_not_current(tmp_path: Path) -> None:
    stamp = tmp_path / 'stamp'
    assert not stamps.is_current(stamp, 'a')
    stamps.write(stamp, 'a')
    assert stamps.is_current(stamp, 'a')
    assert not stamps.is_current(stamp, 'b')


# The environment


def test_the_build_sees_neither_its_own_results_nor_the_outer_make(tmp_path: Path) -> None:
    layout = checkout(tmp_path)
    installed = layout.workspace / 'install' / 'p'
    outer = {
        'MAKEFLAGS': '-n',
        'AMENT_PREFIX_PATH': f'{installed}:/opt/ros/jazzy',
        'PYTHONPATH': f'{installed}/lib:/opt/ros/jazzy/lib',
    }
    beside_ros = environment.build_environment(layout, SourcedRos(Path('/opt'), (3, 12)), outer)
    assert beside_ros['AMENT_PREFIX_PATH'] == '/opt/ros/jazzy'
    assert beside_ros['PYTHONPATH'] == '/opt/ros/jazzy/lib'
    assert 'MAKEFLAGS' not in beside_ros
    beside_wheels = environment.build_environment(layout, None, outer)
    assert beside_wheels['AMENT_PREFIX_PATH'] == str(layout.venv)
    assert 'PYTHONPATH' not in beside_wheels


@pytest.mark.parametrize(('moved', 'code'), [(False, 0), (True, 2)])
def test_the_environment_of_a_checkout_that_was_moved_is_refused(
    tmp_path: Path, moved: bool, code: int
) -> None:
    layout = checkout(tmp_path / 'checkout')
    workspace = '/elsewhere/ros2_ws' if moved else layout.workspace
    program = f'_geohtn_ws={workspace}\n{environment.script(layout, None)}echo "$ROS_DISTRO"\n'
    (tmp_path / 'environment.sh').write_text(program)
    ended = subprocess.run(
        ['bash', '-c', f'. {tmp_path}/environment.sh'],
        capture_output=True,
        text=True,
        check=False,
        env={'PATH': '/usr/bin:/bin'},
    )
    assert ended.returncode == code
    assert ended.stdout == ('' if moved else 'jazzy\n')
    assert ('make setup' in ended.stderr) == moved


# Failing and waiting


def test_a_failed_step_shows_its_errors_and_its_log(tmp_path: Path) -> None:
    program = 'print("\\n".join(["chatter"] * 50)); print("ERROR: no such wheel"); exit(3)'
    with pytest.raises(SetUpError) as caught:
        commands.run_step(
            'Installing',
            [sys.executable, '-c', program],
            tmp_path / 'logs' / 'pip.log',
            environment={},
            cwd=tmp_path,
        )
    text = str(caught.value)
    assert text.startswith('Installing: failed with exit code 3.')
    assert str(tmp_path / 'logs' / 'pip.log') in text
    assert 'ERROR: no such wheel' in text
    assert 'chatter' not in text


def test_two_set_ups_of_one_checkout_take_turns(tmp_path: Path) -> None:
    lock = tmp_path / 'lock'
    code = (
        f'import sys; sys.path.insert(0, {str(ROOT / "ros2_ws")!r})\n'
        'import time; from pathlib import Path; from workspace.main import only_one\n'
        f'with only_one(Path({str(lock)!r})): print(time.monotonic(), flush=True)'
    )
    with only_one(lock):
        other = subprocess.Popen([sys.executable, '-c', code], stdout=subprocess.PIPE, text=True)
        assert other.stdout is not None
        assert 'waiting' in other.stdout.readline()
        before_release = time.monotonic()
    with other:
        assert float(other.stdout.readline()) >= before_release
    assert other.returncode == 0
