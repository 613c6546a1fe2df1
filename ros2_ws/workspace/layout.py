"""Where things are in a checkout."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from workspace.problems import SetUpError

#: Characters that CMake, PATH or the first line of a script cannot carry in a path.
FORBIDDEN = frozenset(' \t\n:;"\'$')


@dataclass(frozen=True)
class Layout:
    """The paths of one checkout. Raises SetUpError where its own path cannot be built in."""

    root: Path

    def __post_init__(self) -> None:
        """Refuse a path that would break CMake or scripts much later and obscurely."""
        bad = sorted(FORBIDDEN.intersection(str(self.root)))
        if bad:
            raise SetUpError(
                f'ROS 2 cannot be built in a path with {bad[0]!r} in it ({self.root}): '
                'move the checkout elsewhere.'
            )

    @property
    def workspace(self) -> Path:
        """Where colcon runs."""
        return self.root / 'ros2_ws'

    @property
    def venv(self) -> Path:
        """The virtual environment; without a sourced ROS it is the ROS prefix as well."""
        return self.root / '.venv'

    @property
    def logs(self) -> Path:
        """What the steps of the set-up printed."""
        return self.workspace / 'log' / 'set_up'

    @property
    def requirements(self) -> Path:
        """The pinned versions."""
        return self.workspace / 'requirements'

    @property
    def messages(self) -> Path:
        """The package ``geohtn_msgs``."""
        return self.root / 'msgs'

    @property
    def packages(self) -> Path:
        """The folder of the node packages."""
        return self.root / 'src'
