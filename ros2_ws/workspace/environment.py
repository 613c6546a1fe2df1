"""The environment variables that commands need, for the set-up itself and as a script to source."""

from __future__ import annotations

import os
import shlex
from collections.abc import Mapping

from workspace.layout import Layout
from workspace.ros import DISTRO, SourcedRos

#: Variables of an outer ``make`` that the one inside colcon must not inherit.
OUTER_MAKE = ('MAKEFLAGS', 'MFLAGS', 'MAKELEVEL', 'MAKEOVERRIDES')
SEARCH_PATHS = ('AMENT_PREFIX_PATH', 'CMAKE_PREFIX_PATH', 'LD_LIBRARY_PATH', 'PATH', 'PYTHONPATH')


def fixed_variables(layout: Layout, ros: SourcedRos | None) -> dict[str, str]:
    """What is set whatever it was before. A sourced ROS has set all of it already."""
    if ros is not None:
        return {}
    prefix = str(layout.venv)
    return {
        'AMENT_PREFIX_PATH': prefix,
        'CMAKE_PREFIX_PATH': prefix,
        'ROS_DISTRO': DISTRO,
        'ROS_PYTHON_VERSION': '3',
        'ROS_VERSION': '2',
        'RMW_IMPLEMENTATION': 'rmw_fastrtps_cpp',
        # The wheels' start-up hook would start every Python twice to set LD_LIBRARY_PATH.
        '_ROS_WHEELS_BOOTSTRAP_COMPLETE': '1',
    }


def leading_folders(layout: Layout, ros: SourcedRos | None) -> dict[str, list[str]]:
    """What is searched before everything else, by variable."""
    folders = {'PATH': [str(layout.venv / 'bin')]}
    if ros is None:
        libraries = sorted(layout.venv.glob('lib/python3.*/site-packages/ros_*.libs'))
        folders['LD_LIBRARY_PATH'] = [str(layout.venv / 'lib'), *map(str, libraries)]
    return folders


def build_environment(
    layout: Layout, ros: SourcedRos | None, outer: Mapping[str, str] = os.environ
) -> dict[str, str]:
    """``outer`` as the build needs it: with ROS, without what this workspace installed before."""
    environment = {name: value for name, value in outer.items() if name not in OUTER_MAKE}
    installed = str(layout.workspace / 'install')
    for name in SEARCH_PATHS:
        if name in environment:
            kept = [e for e in environment[name].split(':') if e and not e.startswith(installed)]
            environment[name] = ':'.join(kept)
    if ros is None:
        environment.pop('PYTHONPATH', None)
    environment.pop('PYTHONHOME', None)
    environment.update(fixed_variables(layout, ros))
    for name, folders in leading_folders(layout, ros).items():
        environment[name] = ':'.join([*folders, *filter(None, [environment.get(name)])])
    environment['VIRTUAL_ENV'] = str(layout.venv)
    return environment


def script(layout: Layout, ros: SourcedRos | None) -> str:
    """The same for a shell to source (bash or zsh)."""
    lines = [
        '# Written by the set-up; sourced by ros2_ws/activate.sh.',
        f'if [ "$_geohtn_ws" != {shlex.quote(str(layout.workspace))} ]; then',
        '  echo "This checkout was moved: run make setup in $(dirname "$_geohtn_ws") again." >&2',
        '  return 2',
        'fi',
    ]
    if ros is not None:
        hint = f'GeoHTN was set up with the ROS 2 in {ros.prefix}: source it first.'
        lines += [
            f'if [ "${{ROS_DISTRO:-}}" != {DISTRO} ] || [ -z "${{AMENT_PREFIX_PATH:-}}" ]; then',
            f'  echo {shlex.quote(hint)} >&2',
            '  return 2',
            'fi',
        ]
    for name, value in fixed_variables(layout, ros).items():
        lines.append(f'export {name}={shlex.quote(value)}')
    for name, folders in leading_folders(layout, ros).items():
        front = shlex.quote(':'.join(folders))
        lines.append(f'export {name}={front}"${{{name}:+:${name}}}"')
    return '\n'.join(lines) + '\n'
