"""Finding a mission, in a folder or among the installed ones, and reading its three files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_prefix

from interface_node.command_line.errors import CommandError
from interface_node.command_line.exit_codes import ExitCode
from interface_node.plan import Diagnostic
from interface_node.sources import SourceError, read_source

#: Files of a mission, by what they hold.
FILE_NAMES = {'domain': 'domain.lisp', 'problem': 'problem.lisp', 'world': 'world.yaml'}


@dataclass(frozen=True, slots=True)
class Source:
    """A file of a mission: its absolute path, how the user named it, and its text."""

    path: str
    shown: str
    text: str


@dataclass(frozen=True, slots=True)
class Mission:
    """A mission's name and its sources by role: domain, problem and world."""

    name: str
    sources: Mapping[str, Source]


class UnreadableMission(Exception):
    """One or more files of a mission cannot be read; ``diagnostics`` say why."""

    def __init__(self, diagnostics: tuple[Diagnostic, ...]):
        super().__init__('; '.join(map(str, diagnostics)))
        self.diagnostics = diagnostics


def installed_missions() -> dict[str, Path]:
    """Folders of the missions that come with the installed package, by name, sorted."""
    try:
        folder = Path(get_package_prefix('interface_node'), 'share', 'interface_node', 'missions')
    except (PackageNotFoundError, OSError):
        return {}
    if not folder.is_dir():
        return {}
    return {path.name: path for path in sorted(folder.iterdir()) if path.is_dir()}


def mission_folder(mission: str, installed: Mapping[str, Path]) -> Path:
    """Folder of a mission that is given by a path or by the name of an installed one.

    Raises:
        CommandError: when there is neither; names the installed missions and the likely one.
    """
    folder = Path(mission)
    try:
        if mission and folder.is_dir():
            return folder
        is_something = bool(mission) and folder.exists()
    except (OSError, ValueError):
        is_something = False
    if is_something:
        raise CommandError(
            f'{mission} is not a folder: name the folder that holds '
            + ', '.join(FILE_NAMES.values()),
            ExitCode.INPUT,
        )
    if mission in installed:
        return installed[mission]
    message = f'there is no folder and no installed mission {mission!r}'
    close = get_close_matches(mission, installed, n=1)
    if close:
        message += f'; did you mean {close[0]!r}?'
    message += f' (installed missions: {", ".join(installed) or "none"})'
    raise CommandError(message, ExitCode.INPUT)


def read_mission(folder: Path, replacements: Mapping[str, str | None]) -> Mission:
    """Read a mission's files; ``replacements`` name other files by role.

    Raises:
        UnreadableMission: with a diagnostic for each file that is missing, too long or no text.
    """
    sources: dict[str, Source] = {}
    diagnostics: list[Diagnostic] = []
    for role, file_name in FILE_NAMES.items():
        shown = str(replacements.get(role) or folder / file_name)
        try:
            text = read_source(role, shown, '')
            sources[role] = Source(str(Path(shown).absolute()), shown, text)
        except SourceError as error:
            diagnostics.append(error.diagnostic)
    if diagnostics:
        raise UnreadableMission(tuple(diagnostics))
    return Mission(folder.resolve().name or 'mission', sources)
