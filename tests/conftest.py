"""Fixtures of the tests across nodes. Every test run has a DDS domain of its own."""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest

from tests.support.missions import ROVER, Run, run_mission
from tests.support.processes import started
from tests.support.spinning import DOMAIN


@pytest.fixture(scope='session', autouse=True)
def own_domain() -> None:
    """Keep other robots, and other test runs on this machine, out of these tests."""
    os.environ['ROS_DOMAIN_ID'] = str(DOMAIN)
    os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'


@pytest.fixture(scope='session')
def rover_run(tmp_path_factory: pytest.TempPathFactory) -> Run:
    """The paper's mission, planned once."""
    return run_mission(ROVER, tmp_path_factory.mktemp('rover'))


@pytest.fixture(scope='session')
def second_rover_run(tmp_path_factory: pytest.TempPathFactory) -> Run:
    """The paper's mission with the same seed in three fresh processes."""
    return run_mission(ROVER, tmp_path_factory.mktemp('rover_again'))


@pytest.fixture(scope='module')
def nodes() -> Iterator[str]:
    """Three nodes that stay up for a whole module; gives their namespace."""
    namespace = f'geohtn_test_{os.getpid()}'
    with started('up', '--namespace', namespace) as process:
        assert process.stdout is not None
        for line in process.stdout:
            if 'ready' in line:
                break
        else:
            pytest.fail(f'geohtn up ended with {process.wait()}')
        yield namespace
        assert process.poll() is None, 'a node died during the tests'
