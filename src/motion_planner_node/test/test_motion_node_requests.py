"""Requests of several clients at a time: queued, cancelled, timed out, while all else is answered."""

from __future__ import annotations

import signal
import subprocess
from collections.abc import Iterator
from typing import Any

import pytest
from geohtn_msgs import msg, srv
from rcl_interfaces.srv import GetParameters
from rclpy.qos import QoSProfile, ReliabilityPolicy

from tests.support.motion_planner import DEADLINE, ROVER, START, Asker, start_node, wait_until_ready
from tests.support.processes import output_of

TEXT = ROVER.read_text(encoding='utf-8')
OTHER = TEXT.replace('location8', 'location9')
NEAR = '((agent rover0)(object {0})(distance(rover0, {0}) <= 60))'
#: In mode paper, which proves nothing, this is tried in vain until somebody ends it.
ENDLESS = (
    '((agent rover0)(object location1)(object location5)'
    '(visible(rover0, location1))(distance(rover0, location1) <= 100)'
    '(distance(rover0, location5) <= 100))'
)


@pytest.fixture(scope='module')
def process() -> Iterator[subprocess.Popen[str]]:
    with start_node('--ros-args', '-p', 'paper_tries:=100000') as process:
        wait_until_ready(process)
        yield process
        process.send_signal(signal.SIGTERM)
        assert process.wait(timeout=DEADLINE) == 0


@pytest.fixture(scope='module')
def client(process: subprocess.Popen[str]) -> Iterator[Client]:
    client = Client()
    yield client
    client.close()


@pytest.fixture
def rover(client: Client) -> Client:
    assert client.set_world(TEXT).accepted
    return client


class Client(Asker):
    """Asks without waiting for the answer."""

    def __init__(self) -> None:
        super().__init__()
        self._satisfy = self.node.create_client(
            srv.SatisfyPreconditions,
            '/satisfy_preconditions',
            qos_profile=QoSProfile(depth=1000, reliability=ReliabilityPolicy.RELIABLE),
        )
        assert self._satisfy.wait_for_service(timeout_sec=DEADLINE)

    def begin(self, text: str, **fields: Any) -> Any:
        request = msg.GeometricRequest(**({'preconditions': text, 'start': [START]} | fields))
        return self._satisfy.call_async(srv.SatisfyPreconditions.Request(request=request))

    def begin_endless(self, name: str) -> Any:
        """Begin a request that would take for ever; returns once the node has received it."""
        future = self.begin(ENDLESS, mode='paper', time_budget=1000.0, request_id=name)
        self.settle()
        assert not future.done()
        return future

    def settle(self) -> None:
        """Return once the node has received all that was begun, while something else runs."""
        late = self.begin(NEAR.format('location1'), time_budget=1e-6)
        assert self.wait_for(late).answer.code == msg.GeometricAnswer.OUT_OF_TIME

    def cancel(self, name: str) -> int:
        return int(self.call(srv.CancelRequest, '/cancel_request', request_id=name).cancelled)


def test_all_else_is_answered_while_a_request_is_worked_on(rover: Client) -> None:
    endless = rover.begin_endless('r1')
    assert rover.call(srv.GetWorld, '/get_world').available
    check = rover.call(
        srv.CheckPreconditions, '/check_preconditions', preconditions=NEAR.format('?o')
    )
    assert check.valid
    values = rover.call(GetParameters, '/motion_planner_node/get_parameters', names=['paper_tries'])
    assert values.values[0].integer_value == 100000
    assert not endless.done()
    assert rover.cancel('another') == 0
    assert rover.cancel('r1') == 1
    answer = rover.wait_for(endless).answer
    assert answer.code == msg.GeometricAnswer.CANCELLED
    assert answer.status == msg.GeometricAnswer.UNKNOWN
    assert answer.request_id == 'r1'
    assert 'cancelled' in answer.message


def test_requests_that_wait_are_cancelled_and_the_others_answered_as_ever(rover: Client) -> None:
    texts = [NEAR.format(f'location{number}') for number in range(1, 7)]
    alone = [rover.satisfy(text) for text in texts]
    endless = rover.begin_endless('r2')
    waiting = [rover.begin(text, request_id=f'w{i}') for i, text in enumerate(texts)]
    dropped = rover.begin(texts[0], request_id='dropped')
    rover.settle()
    assert rover.cancel('dropped') == 1
    assert rover.wait_for(dropped).answer.code == msg.GeometricAnswer.CANCELLED
    assert not any(future.done() for future in waiting)
    assert rover.cancel('r2') == 1
    assert rover.wait_for(endless).answer.code == msg.GeometricAnswer.CANCELLED
    for before, future in zip(alone, waiting, strict=True):
        answer = rover.wait_for(future).answer
        answer.time_spent, answer.request_id = before.time_spent, ''
        assert answer == before


def test_more_requests_than_can_wait_are_all_answered(rover: Client) -> None:
    endless = rover.begin_endless('r3')
    many = [rover.begin(NEAR.format('location1'), request_id=f'm{i}') for i in range(40)]
    assert rover.cancel('r3') == 1
    rover.wait_for(endless)
    answers = [rover.wait_for(future).answer for future in many]
    assert [answer.request_id for answer in answers] == [f'm{i}' for i in range(40)]
    assert {answer.status for answer in answers} == {msg.GeometricAnswer.FOUND}
    assert len({answer.length for answer in answers}) == 1


def test_a_request_stays_with_the_world_that_it_began_with(rover: Client) -> None:
    held = rover.call(srv.GetWorld, '/get_world').world.revision
    named = {'world_revision': held, 'request_id': 'named'}
    endless = rover.begin_endless('r4')
    waiting = rover.begin(NEAR.format('location8'), **named)
    rover.settle()
    response = rover.set_world(OTHER)
    assert response.accepted
    assert response.revision != held
    after = rover.begin(NEAR.format('location8'), **named)
    renamed = rover.begin(NEAR.format('location9'))
    assert rover.cancel('r4') == 1
    assert rover.wait_for(endless).answer.world_revision == held
    answer = rover.wait_for(waiting).answer
    assert (answer.status, answer.world_revision) == (msg.GeometricAnswer.FOUND, held)
    assert rover.wait_for(after).answer.code == msg.GeometricAnswer.WORLD_CHANGED
    answer = rover.wait_for(renamed).answer
    assert (answer.status, answer.world_revision) == (msg.GeometricAnswer.FOUND, response.revision)


def test_the_deadline_of_a_request_ends_it(rover: Client) -> None:
    future = rover.begin(ENDLESS, mode='paper', time_budget=0.2)
    answer = rover.wait_for(future).answer
    assert answer.code == msg.GeometricAnswer.OUT_OF_TIME
    assert 0.2 <= answer.time_spent < DEADLINE


def test_the_node_ends_in_the_middle_of_a_request() -> None:
    with start_node('--ros-args', '-p', 'paper_tries:=100000', '-p', f'world:={ROVER}') as process:
        wait_until_ready(process)
        client = Client()
        try:
            client.begin_endless('r5')
        finally:
            client.close()
        process.send_signal(signal.SIGTERM)
        output = output_of(process, DEADLINE)
    assert process.returncode == 0
    assert 'Traceback' not in output


def test_clients_and_a_new_world_under_load_disturb_no_answer(rover: Client) -> None:
    """Each answer is the one that its world gives when nothing else is asked."""
    texts = [NEAR.format(f'location{number}') for number in range(1, 7)]

    def plain(answer: Any) -> Any:
        answer.time_spent, answer.request_id = 0.0, ''
        return answer

    alone: dict[str, list[Any]] = {}
    for world in (OTHER, TEXT):
        revision = rover.set_world(world).revision
        alone[revision] = [plain(rover.satisfy(text)) for text in texts]
    clients = [rover, Client()]
    try:
        clients[1].satisfy(texts[0])
        futures = [(client, client.begin(text)) for text in texts for client in clients]
        changed = rover.set_world(OTHER)
        futures += [(client, client.begin(text)) for text in texts for client in clients]
        answers = [client.wait_for(future).answer for client, future in futures]
    finally:
        clients[1].close()
    for number, answer in enumerate(answers):
        assert plain(answer) == alone[answer.world_revision][number // 2 % len(texts)]
    # What was asked for after the change was answered is about the new world.
    assert {answer.world_revision for answer in answers[len(answers) // 2 :]} == {changed.revision}
