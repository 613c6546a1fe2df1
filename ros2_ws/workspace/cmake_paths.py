"""The ROS wheels' CMake files hold the paths of the machine that built them: put in ours."""

from __future__ import annotations

import re
from pathlib import Path

SUFFIXES = frozenset({'.cmake', '.in', '.sh', '.dsv', '.pc'})

#: A character of a path: none that ends one in CMake or in a shell.
_IN_PATH = r'[^"\';:)\s]'
_INCLUDE = re.compile(r'/opt/python/cp\d+-cp\d+/include/python[\d.]+')
_PACKAGES = re.compile(rf'/opt/python/{_IN_PATH}*?/site-packages')
_PREFIX = re.compile(rf'/project/build/temp{_IN_PATH}*?/install')


def repair_text(text: str, *, prefix: Path, include: Path, packages: Path) -> str:
    """``text`` with the builder's paths replaced by those of the environment in ``prefix``."""
    text = _INCLUDE.sub(lambda _: str(include), text)
    text = _PACKAGES.sub(lambda _: str(packages), text)
    return _PREFIX.sub(lambda _: str(prefix), text)


def repair_prefix(prefix: Path, include: Path, packages: Path) -> int:
    """Repair every file below ``prefix/share``, and return how many were changed.

    Doing it again changes nothing.
    """
    changed = 0
    for path in (prefix / 'share').rglob('*'):
        if path.suffix not in SUFFIXES or not path.is_file():
            continue
        before = path.read_bytes()
        if b'/opt/python/' not in before and b'/project/build/' not in before:
            continue
        after = repair_text(
            before.decode(), prefix=prefix, include=include, packages=packages
        ).encode()
        if after != before:
            path.write_bytes(after)
            changed += 1
    return changed
