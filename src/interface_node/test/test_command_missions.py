"""Missions are found by folder and by name, and what is wrong with their files is said."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from interface_node.command_line.errors import CommandError
from interface_node.command_line.missions import (
    FILE_NAMES,
    UnreadableMission,
    installed_missions,
    mission_folder,
    read_mission,
)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A mission whose files hold their own names."""
    mission = tmp_path / 'survey'
    mission.mkdir()
    for name in FILE_NAMES.values():
        (mission / name).write_text(name)
    return mission


def test_a_folder_is_read(folder: Path) -> None:
    mission = read_mission(mission_folder(str(folder), {}), {})
    assert mission.name == 'survey'
    assert {role: source.text for role, source in mission.sources.items()} == FILE_NAMES


def test_sources_have_absolute_paths_and_are_shown_as_the_user_named_them(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder.parent)
    source = read_mission(mission_folder('survey', {}), {}).sources['world']
    assert source.path == str(folder / 'world.yaml')
    assert source.shown == 'survey/world.yaml'
    monkeypatch.chdir(folder)
    assert read_mission(mission_folder('.', {}), {}).name == 'survey'


def test_single_files_can_be_replaced(folder: Path, tmp_path: Path) -> None:
    other = tmp_path / 'other.yaml'
    other.write_text('other')
    mission = read_mission(folder, {'world': str(other), 'domain': None})
    assert mission.sources['world'].text == 'other'
    assert mission.sources['domain'].text == 'domain.lisp'


def test_an_installed_mission_is_found_by_name(folder: Path) -> None:
    assert mission_folder('rover', {'rover': folder}) == folder


@pytest.mark.parametrize('name', ['rovr', 'Rover', 'rover/'])
def test_an_unknown_name_gets_a_suggestion(name: str, folder: Path) -> None:
    with pytest.raises(CommandError, match=r"did you mean 'rover'.*installed missions: rover, x"):
        mission_folder(name, {'rover': folder, 'x': folder})


@pytest.mark.parametrize('name', ['', 'a\0b', 'x' * 5000])
def test_names_that_cannot_be_paths_are_refused(name: str) -> None:
    with pytest.raises(CommandError) as caught:
        mission_folder(name, {})
    assert caught.value.exit_code == 2


def test_a_file_is_no_mission(folder: Path) -> None:
    with pytest.raises(CommandError, match='is not a folder'):
        mission_folder(str(folder / 'world.yaml'), {})


def test_every_bad_file_is_named(folder: Path) -> None:
    (folder / 'domain.lisp').unlink()
    (folder / 'problem.lisp').write_bytes(b'first line\nab\xff\xfe')
    (folder / 'world.yaml').unlink()
    os.mkfifo(folder / 'world.yaml')
    with pytest.raises(UnreadableMission) as caught:
        read_mission(folder, {})
    found = [(Path(d.source).name, d.line, d.column) for d in caught.value.diagnostics]
    assert found == [('domain.lisp', 0, 0), ('problem.lisp', 2, 3), ('world.yaml', 0, 0)]


def test_a_huge_file_is_not_read(folder: Path) -> None:
    with (folder / 'domain.lisp').open('wb') as file:
        file.truncate(50 * 1024 * 1024)
    with pytest.raises(UnreadableMission) as caught:
        read_mission(folder, {})
    assert [Path(d.source).name for d in caught.value.diagnostics] == ['domain.lisp']


def test_without_an_installation_there_are_no_installed_missions(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    assert installed_missions() == {}
    monkeypatch.delenv('AMENT_PREFIX_PATH')
    assert installed_missions() == {}


def test_installed_missions_are_found_through_the_ament_index(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    marker = tmp_path / 'share' / 'ament_index' / 'resource_index' / 'packages' / 'interface_node'
    marker.parent.mkdir(parents=True)
    marker.touch()
    missions = tmp_path / 'share' / 'interface_node' / 'missions'
    (missions / 'survey').mkdir(parents=True)
    (missions / 'rover').mkdir()
    (missions / 'world.schema.json').touch()
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    assert list(installed_missions().items()) == [
        ('rover', missions / 'rover'),
        ('survey', missions / 'survey'),
    ]
