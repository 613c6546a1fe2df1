"""The Python packages: all of them pinned, or only those that a sourced ROS 2 lacks."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from workspace.layout import Layout

#: Another distribution that provides the same module.
SAME_MODULE = {'lark-parser': 'lark'}
#: Never put beside the one that a sourced ROS 2 is compiled against.
OF_THE_SYSTEM = frozenset({'numpy'})
#: What a sourced ROS 2 Jazzy is compiled against.
CONSTRAINTS = 'numpy<2\n'


def read_pins(path: Path) -> list[str]:
    """The lines ``name==version[; marker]`` of a requirements file."""
    lines = (line.split('#')[0].strip() for line in path.read_text('utf-8').splitlines())
    return [line for line in lines if line]


def normalised(name: str) -> str:
    """A distribution's name as indexes compare it (PEP 503)."""
    return re.sub(r'[-_.]+', '-', name).lower()


def lacking(pins: list[str], installed: Mapping[str, str], *, exact: bool = False) -> list[str]:
    """The pins that ``installed`` (normalised name to version) does not meet.

    A package that is there in another version is good enough unless ``exact``.
    """
    found = []
    for pin in pins:
        name, version = pin.split(';')[0].strip().split('==')
        name = normalised(name)
        if name in OF_THE_SYSTEM:
            continue
        present = installed.get(name) or installed.get(SAME_MODULE.get(name, name))
        if present is None or (exact and present != version):
            found.append(pin)
    return found


def pins_beside_wheels(layout: Layout) -> list[str]:
    """What pip installs where no ROS 2 is sourced: everything."""
    files = ('ros_jazzy.txt', 'runtime.txt', 'development.txt')
    return [pin for file in files for pin in read_pins(layout.requirements / file)]


def pins_beside_ros(layout: Layout, installed: Mapping[str, str]) -> list[str]:
    """What pip adds to a sourced ROS 2: no part of ROS, and the tools in exactly our versions."""
    tools = [
        pin
        for pin in read_pins(layout.requirements / 'ros_jazzy.txt')
        if not pin.startswith('ros-') and not pin.startswith('pytest')
    ]
    runtime = read_pins(layout.requirements / 'runtime.txt')
    development = read_pins(layout.requirements / 'development.txt')
    return lacking(tools + runtime, installed) + lacking(development, installed, exact=True)
