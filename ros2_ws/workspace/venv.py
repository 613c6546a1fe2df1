"""The virtual environment of a checkout: made once, made again when what it is made from changes."""

from __future__ import annotations

import json
import platform
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from workspace import cmake_paths, environment, packages, stamps
from workspace.commands import run_step, say
from workspace.layout import Layout
from workspace.ros import SourcedRos

#: Prints the installed distributions, those found first winning.
_LIST_INSTALLED = """
import importlib.metadata as metadata, json
found = {}
for distribution in metadata.distributions():
    found.setdefault(distribution.metadata['Name'], distribution.version)
print(json.dumps(found))
"""


def base_python() -> Path:
    """This Python outside of any virtual environment: ours may be active, and is about to go."""
    if sys.prefix == sys.base_prefix:
        return Path(sys.executable)
    return Path(sys.base_prefix, 'bin', f'python{sys.version_info[0]}.{sys.version_info[1]}')


def wanted(layout: Layout, ros: SourcedRos | None) -> str:
    """The fingerprint of the environment that this checkout needs."""
    own = [Path(module.__file__ or '') for module in (cmake_paths, environment, packages)]
    origin = 'wheels' if ros is None else str(ros.prefix)
    words = [str(layout.venv), platform.python_version(), str(base_python()), origin]
    return stamps.fingerprint(words, [*layout.requirements.glob('*.txt'), *own, Path(__file__)])


def make(layout: Layout, ros: SourcedRos | None) -> str:
    """Make ``.venv`` unless it is what is wanted, and return its fingerprint.

    Raises:
        SetUpError: venv or pip failed.
    """
    made_from = wanted(layout, ros)
    stamp = layout.venv / 'set_up.stamp'
    if stamps.is_current(stamp, made_from):
        return made_from
    if layout.venv.exists():
        say('The Python environment in .venv is unfinished or out of date: making it anew.')
        stamp.unlink(missing_ok=True)
        shutil.rmtree(layout.venv)
    outer = environment.build_environment(layout, ros)
    create: list[str | Path] = [base_python(), '-m', 'venv', layout.venv]
    run_step(
        'Making the Python environment .venv',
        create if ros is None else [*create, '--system-site-packages'],
        layout.logs / 'venv.log',
        environment=outer,
        cwd=layout.root,
    )
    if ros is None:
        _install(layout, packages.pins_beside_wheels(layout), outer, 'ROS 2 Jazzy: ')
        _make_ros_prefix(layout)
    else:
        pins = packages.pins_beside_ros(layout, _installed(layout, outer))
        _install(layout, pins, outer, f'what {ros.prefix} lacks: ', packages.CONSTRAINTS)
    (layout.venv / 'environment.sh').write_text(environment.script(layout, ros), 'utf-8')
    stamps.write(stamp, made_from)
    return made_from


def _install(
    layout: Layout, pins: list[str], outer: dict[str, str], what: str, constraints: str = ''
) -> None:
    requirements, limits = layout.venv / 'requirements.txt', layout.venv / 'constraints.txt'
    requirements.write_text('\n'.join(pins) + '\n', 'utf-8')
    limits.write_text(constraints, 'utf-8')
    pip: list[str | Path] = [
        layout.venv / 'bin' / 'python',
        '-m',
        'pip',
        'install',
        '--disable-pip-version-check',
    ]
    pip += ['--no-input', '--progress-bar=off', '-r', requirements, '-c', limits]
    run_step(
        f'Installing {what}{len(pins)} Python packages (a minute or two)',
        pip,
        layout.logs / 'pip.log',
        environment=outer,
        cwd=layout.root,
    )


def _installed(layout: Layout, outer: dict[str, str]) -> dict[str, str]:
    listed = subprocess.run(
        [layout.venv / 'bin' / 'python', '-c', _LIST_INSTALLED],
        env=outer,
        stdout=subprocess.PIPE,
        check=True,
    )
    return {
        packages.normalised(name): version for name, version in json.loads(listed.stdout).items()
    }


def _make_ros_prefix(layout: Layout) -> None:
    """Make an ament prefix of the environment that the wheels are in."""
    python = f'python{sys.version_info[0]}.{sys.version_info[1]}'
    cmake_paths.repair_prefix(
        layout.venv,
        include=Path(sysconfig.get_path('include')),
        packages=layout.venv / 'lib' / python / 'site-packages',
    )
    for shell in ('sh', 'bash', 'zsh'):  # colcon expects them in a prefix
        (layout.venv / f'local_setup.{shell}').touch()
