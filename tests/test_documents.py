"""The documents: links lead somewhere, interfaces are listed, and the README's mission works."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.support.missions import ROOT
from tests.support.processes import geohtn

DOCUMENTS = [*ROOT.glob('*.md'), *(ROOT / 'docs').rglob('*.md')]


@pytest.mark.parametrize('document', DOCUMENTS, ids=lambda path: path.name)
def test_links_lead_somewhere(document: Path) -> None:
    text = document.read_text(encoding='utf-8')
    targets = re.findall(r'\]\(([^)#\s]+)[^)]*\)', text) + re.findall(r'src="([^"]+)"', text)
    for target in targets:
        if not target.startswith(('http://', 'https://')):
            assert (document.parent / target).exists(), target


def test_every_interface_is_documented() -> None:
    text = (ROOT / 'docs' / 'interfaces.md').read_text(encoding='utf-8')
    types = [*(ROOT / 'msgs' / 'srv').iterdir(), *(ROOT / 'msgs' / 'action').iterdir()]
    assert types
    for path in types:
        assert f'`{path.stem}`' in text, path.name


def test_the_first_mission_of_the_readme(tmp_path: Path) -> None:
    """The three files that the README tells a newcomer to write are a mission that works."""
    text = (ROOT / 'README.md').read_text(encoding='utf-8')
    files = re.findall(r'`(\w+\.(?:lisp|yaml))`:\n+```\w+\n(.*?)```', text, re.DOTALL)
    assert {name for name, _ in files} == {'domain.lisp', 'problem.lisp', 'world.yaml'}
    for name, content in files:
        (tmp_path / name).write_text(content, encoding='utf-8')
    done = geohtn('run', tmp_path, '--output', tmp_path / 'out')
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / 'out' / 'mission.png').exists()
