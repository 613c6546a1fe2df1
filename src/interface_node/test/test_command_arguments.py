"""The command line: what is accepted, and that everything else is refused in one line."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from interface_node.command_line.arguments import goal_of, mission_of, node_settings_of
from interface_node.command_line.dispatch import parser

VERBS = ('run', 'up', 'plan', 'replay', 'missions')


@pytest.fixture
def mission(tmp_path: Path) -> Path:
    """A mission of empty files."""
    folder = tmp_path / 'survey'
    folder.mkdir()
    for name in ('domain.lisp', 'problem.lisp', 'world.yaml', 'other.yaml'):
        (folder / name).write_text(name)
    return folder


def test_a_goal_holds_all_options(mission: Path, tmp_path: Path) -> None:
    other = str(mission / 'other.yaml')
    options = ['--seed', '18446744073709551615', '--time-budget', '2.5', '--max-alternatives', '3']
    flags = ['--no-advice', '--optimise', '--output', str(tmp_path / 'o'), '--world', other]
    flags += ['--guidance', 'nearest_first']
    arguments = parser().parse_args(['run', str(mission), *options, *flags])
    goal = goal_of(arguments, mission_of(arguments))
    assert (goal.seed, goal.time_budget, goal.max_alternatives) == (2**64 - 1, 2.5, 3)
    assert (goal.use_advice, goal.optimise, goal.guidance) == (False, True, 'nearest_first')
    assert goal.output_directory == str(tmp_path / 'o')
    assert goal.mission.sources['world'].text == 'other.yaml'
    assert goal.mission.sources['domain'].text == 'domain.lisp'


def test_by_default_the_nodes_choose_and_results_go_to_out(
    mission: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(mission.parent)
    arguments = parser().parse_args(['plan', 'survey', '--output', ''])
    goal = goal_of(arguments, mission_of(arguments))
    assert (goal.seed, goal.time_budget, goal.max_alternatives) == (0, 0.0, 0)
    assert (goal.use_advice, goal.optimise, goal.guidance) == (True, False, '')
    assert goal.output_directory == str(mission.parent / 'out' / 'survey')


def test_node_settings_hold_parameters_in_yaml(tmp_path: Path) -> None:
    file = tmp_path / 'p.yaml'
    file.touch()
    arguments = parser().parse_args(
        [
            *('up', '--param', 'motion_planner_node.a.b:=[1, 2]', '--log-level', 'warn'),
            *('--param', 'interface_node.c:=x:=y', '--params-file', str(file)),
        ]
    )
    settings = node_settings_of(arguments, 'team')
    assert settings.parameters == (
        ('motion_planner_node', 'a.b', '[1, 2]'),
        ('interface_node', 'c', 'x:=y'),
    )
    assert (settings.namespace, settings.log_level) == ('team', 'warn')
    assert settings.parameters_file == file


@pytest.mark.parametrize(
    ('given', 'expected'), [('/team_a/', 'team_a'), ('a/b2', 'a/b2'), ('', ''), ('/', '')]
)
def test_namespaces_lose_outer_slashes(given: str, expected: str) -> None:
    assert parser().parse_args(['up', '--namespace', given]).namespace == expected


@pytest.mark.parametrize(
    'arguments',
    [
        [],
        ['fly'],
        ['run'],
        ['run', 'rover', '--seed', '-1'],
        ['run', 'rover', '--seed', '18446744073709551616'],
        ['run', 'rover', '--seed', '9' * 5000],
        ['run', 'rover', '--seed', '\u0663'],
        ['run', 'rover', '--time-budget', '0'],
        ['run', 'rover', '--time-budget', 'nan'],
        ['run', 'rover', '--time-budget', 'inf'],
        ['run', 'rover', '--time-budget', 'soon'],
        ['run', 'rover', '--max-alternatives', '0'],
        ['run', 'rover', '--max-alternatives', '4294967296'],
        ['run', 'rover', '--guidance', 'stars'],
        ['run', 'rover', '--namespace', '1st'],
        ['run', 'rover', '--namespace', 'a//b'],
        ['run', 'rover', '--namespace', 'a b'],
        ['up', '--param', 'seed:=1'],
        ['up', '--param', 'other_node.seed:=1'],
        ['up', '--param', 'interface_node.seed=1'],
        ['up', '--params-file', '/nowhere/at/all.yaml'],
        ['up', '--log-level', 'loud'],
        ['plan', 'rover', 'twice'],
        ['replay'],
    ],
)
def test_nonsense_is_refused_in_one_line(
    arguments: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as caught:
        parser().parse_args(arguments)
    assert caught.value.code == 2
    assert re.fullmatch(r'geohtn: .*\(see `geohtn.* --help`\)\n', capsys.readouterr().err)


@pytest.mark.parametrize('verb', VERBS)
def test_help_shows_examples_and_exit_codes(verb: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        parser().parse_args([verb, '--help'])
    assert caught.value.code == 0
    text = capsys.readouterr().out
    assert f'geohtn {verb}' in text.split('examples:')[1]
    assert '130' in text.split('exit codes:')[1]


def test_every_verb_and_exit_code_is_in_the_general_help(
    capsys: pytest.CaptureFixture[str],
) -> None:
    with pytest.raises(SystemExit):
        parser().parse_args(['--help'])
    text = capsys.readouterr().out
    for verb in VERBS:
        assert re.search(rf'^ +{verb}  +\w', text, re.MULTILINE)
    assert 'exit codes:' in text


def test_the_version_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        parser().parse_args(['--version'])
    assert caught.value.code == 0
    assert re.fullmatch(r'geohtn \S+\n', capsys.readouterr().out)
