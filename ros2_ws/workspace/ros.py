"""Which ROS 2 the set-up builds on: the one that is sourced, or the wheels of PyPI."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from workspace.problems import SetUpError

DISTRO = 'jazzy'


@dataclass(frozen=True)
class SourcedRos:
    """A ROS 2 Jazzy that the shell has sourced.

    Attributes:
        prefix: where its ``rclpy`` is, for instance ``/opt/ros/jazzy``.
        python: major and minor version of the Python that it is compiled for.
    """

    prefix: Path
    python: tuple[int, int]


def find_sourced_ros(environment: Mapping[str, str] = os.environ) -> SourcedRos | None:
    """The ROS 2 that ``environment`` has sourced, or None.

    A virtual environment that holds the wheels is a ROS prefix too. It counts as none, so that the
    set-up finds the same answer inside an activated shell as outside of it.

    Raises:
        SetUpError: another distribution is sourced, or one without rclpy.
    """
    prefixes = [
        Path(entry) for entry in environment.get('AMENT_PREFIX_PATH', '').split(':') if entry
    ]
    prefixes = [prefix for prefix in prefixes if not (prefix / 'pyvenv.cfg').exists()]
    distro = environment.get('ROS_DISTRO', '')
    another = distro not in ('', DISTRO)
    if another and (prefixes or environment.get('ROS_VERSION') == '1'):
        raise SetUpError(
            f'ROS {distro} is sourced and GeoHTN needs ROS 2 Jazzy: source Jazzy, '
            'or open a shell without ROS to use the pinned wheels.'
        )
    if distro != DISTRO:
        return None
    for prefix in prefixes:
        for package in sorted(prefix.glob('lib/python3.*/site-packages/rclpy')):
            major, minor = package.parent.parent.name.removeprefix('python').split('.')
            return SourcedRos(prefix, (int(major), int(minor)))
    if any((prefix / 'share' / 'rcutils').exists() for prefix in prefixes):
        raise SetUpError(
            'The sourced ROS 2 Jazzy has no rclpy: sudo apt install ros-jazzy-ros-base, then source it again.'
        )
    return None
