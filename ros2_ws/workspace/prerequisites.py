"""What the machine must bring along, and the command that installs what it lacks."""

from __future__ import annotations

import importlib.util
import os
import platform
import shutil
import sys
import sysconfig
from collections.abc import Callable
from pathlib import Path

from workspace.problems import SetUpError
from workspace.ros import SourcedRos

#: The oldest C library that the ROS wheels run on (manylinux_2_28).
OLDEST_GLIBC = (2, 28)


def check_tools(
    which: Callable[[str], str | None] = shutil.which,
    has_module: Callable[[str], bool] = lambda name: importlib.util.find_spec(name) is not None,
    headers: Path | None = None,
) -> None:
    """Raise SetUpError that names every missing tool and the one command that installs them all."""
    python = (
        'python3' if sys.executable.startswith('/usr/bin/') else f'python3.{sys.version_info[1]}'
    )
    headers = Path(sysconfig.get_path('include')) if headers is None else headers
    missing = {tool: tool for tool in ('cmake', 'make', 'g++') if which(tool) is None}
    if not (has_module('venv') and has_module('ensurepip')):
        missing[f"Python's venv module (of {sys.executable})"] = f'{python}-venv'
    if not (headers / 'Python.h').exists():
        missing[f"Python's headers ({headers / 'Python.h'})"] = f'{python}-dev'
    if missing:
        names, packages = ', '.join(missing), ' '.join(missing.values())
        raise SetUpError(f'Missing: {names}. Install with: sudo apt install {packages}')


def check_platform(
    system: str = sys.platform, machine: str | None = None, libc: tuple[str, str] | None = None
) -> None:
    """Raise SetUpError where the ROS wheels do not run."""
    machine = platform.machine() if machine is None else machine
    name, version = platform.libc_ver() if libc is None else libc
    numbers = tuple(int(part) for part in version.split('.')[:2] if part.isdigit())
    if system == 'linux' and machine == 'x86_64' and name == 'glibc' and numbers >= OLDEST_GLIBC:
        return
    raise SetUpError(
        f'The ROS 2 wheels run on x86-64 Linux with glibc 2.28 or later, and this is {machine} '
        f'{system} with {name or "another C library"} {version}'.rstrip()
        + ': install ROS 2 Jazzy (sudo apt install ros-jazzy-ros-base), source it and run this again.'
    )


def python_of(ros: SourcedRos, path: str = os.environ.get('PATH', '')) -> Path | None:
    """The Python that ``ros`` is compiled for, or None if that is the one that runs.

    Raises:
        SetUpError: it is not installed.
    """
    if ros.python == sys.version_info[:2]:
        return None
    name = 'python' + '.'.join(map(str, ros.python))
    found = shutil.which(name, path=f'/usr/bin:{path}')
    if found is None:
        raise SetUpError(
            f'The ROS 2 in {ros.prefix} is compiled for {name}, which is missing: '
            f'sudo apt install {name} {name}-venv {name}-dev'
        )
    return Path(found)


def check(ros: SourcedRos | None) -> None:
    """Raise SetUpError if the machine or this Python cannot build the workspace."""
    if ros is None:
        check_platform()
    check_tools()
