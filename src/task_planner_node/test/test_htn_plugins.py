"""Functions of other packages in domains: used where they fit, refused in one sentence where they do not."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOM = Path(__file__).resolve().parents[1]
USE = """
from task_planner_node.language import Source, read_domain
from task_planner_node.language.functions import FUNCTIONS, load_plugins

assert load_plugins() == ('double',)
read_domain(Source('d', '(:method (m ?x) ((call > (call double ?x) 4)) ())'))
assert FUNCTIONS['double'].value(3) == 6
print('used')
"""
LOAD = """
from task_planner_node.language.functions import PluginError, load_plugins
try:
    print(load_plugins())
except PluginError as error:
    print(error)
"""
GOOD = "Function('double', lambda number: 2 * number, 1, 1, 'twice the number')"


def run(script: str, source: str, folder: Path) -> str:
    start = 'from task_planner_node.language.functions import Function\nFUNCTIONS = '
    (folder / 'plugged.py').write_text(start + source + '\n')
    information = folder / 'plugged-1.dist-info'
    information.mkdir()
    (information / 'METADATA').write_text('Metadata-Version: 2.1\nName: plugged\nVersion: 1\n')
    entry = '[task_planner_node.functions]\nmine = plugged:FUNCTIONS\n'
    (information / 'entry_points.txt').write_text(entry)
    code = f'import sys\nsys.path[:0] = {[str(folder), str(ROOM)]!r}\n{script}'
    done = subprocess.run([sys.executable, '-c', code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


@pytest.mark.parametrize('source', [GOOD, f'[{GOOD}]'])
def test_a_function_of_a_package_is_used(tmp_path: Path, source: str) -> None:
    assert run(USE, source, tmp_path) == 'used'


@pytest.mark.parametrize(
    ('source', 'words'),
    [
        ('1 / 0', 'cannot be loaded: ZeroDivisionError'),
        ('5', 'is not a Function, nor several, but 5'),
        (GOOD.replace('double', 'car'), 'function car: its name is taken'),
        (GOOD.replace('double', 'if'), 'function if: its name is taken'),
        (GOOD.replace('double', 'Double'), 'its name cannot be written'),
        (GOOD.replace('1, 1', '2, 1'), 'cannot take 2 to 1 arguments'),
    ],
)
def test_what_is_no_function_is_refused_in_one_sentence(
    tmp_path: Path, source: str, words: str
) -> None:
    message = run(LOAD, source, tmp_path)
    assert words in message
    assert 'mine (plugged:FUNCTIONS)' in message
    assert len(message.splitlines()) == 1


def test_the_example_in_the_documents_works(tmp_path: Path) -> None:
    text = (ROOM.parents[1] / 'docs' / 'htn.md').read_text()
    (source,) = re.findall(r'```python\n(.*?)```', text, re.DOTALL)
    use = """
from task_planner_node.language.functions import FUNCTIONS, load_plugins
load_plugins()
print(FUNCTIONS['bearing-name'].value(85.0))
"""
    assert run(use, f'()\n{source}', tmp_path) == 'east'
