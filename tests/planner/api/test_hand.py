"""A hand on the stick has a socket of its own; what is old, late or another's moves nothing."""

from __future__ import annotations

import json
from contextlib import ExitStack
from dataclasses import replace
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection, connect

from planner.api.access import Access, AccessError
from planner.api.hand import APART_S, CAUSAL_S, MOST_SOCKETS, RELEASED, Hand, HandFrame, StickOrder
from planner.people import Person, Role
from planner.robot_service import MOST_HANDS, LinkedRobot
from tests.e2e.polling import until
from tests.planner.api.serving import LOCAL, Served, served
from tests.wire.examples import STATUS
from wire import HeldReason, Mode, RobotDescription, StandingHold, Status, Velocity

FREE = {"seq": 1, "beat": 0, "forward": 0.0, "left": 0.0, "held": False}


def frame(seq: int, beat: int, *, forward: float = 0.5, held: bool = True) -> HandFrame:
    return HandFrame(seq=seq, beat=beat, forward=forward, left=0.0, held=held)


def opened(server: Served) -> ClientConnection:
    return connect(f"ws://127.0.0.1:{server.port}/v1/hand")


def beat(socket: ClientConnection) -> dict[str, Any]:
    heard: dict[str, Any] = json.loads(socket.recv(5.0))
    return heard


def say(socket: ClientConnection, seq: int, **more: Any) -> dict[str, Any]:
    """Send a frame that repeats the newest beat; return that beat."""
    heard = beat(socket)
    socket.send(json.dumps({**FREE, "seq": seq, "beat": heard["beat"], **more}))
    return heard


def told(server: Served, count: int) -> list[tuple[str, float, float, bool]]:
    steers = server.services.robot.steers
    until(lambda: len(steers) >= count, 5.0, "steering", lambda: steers)
    return steers


def test_a_held_stick_moves_and_its_release_stops_at_once() -> None:
    hand = Hand()
    number = hand.next_beat(10.0)
    assert hand.hear(frame(1, number, forward=0.0, held=False), 10.0, is_taken=False) == RELEASED
    held = hand.hear(frame(2, number), 10.05, is_taken=False)
    assert held == StickOrder(0.5, 0.0, held=True)
    assert hand.hear(frame(3, number, held=False), 10.051, is_taken=False) == RELEASED
    assert hand.let_go() is None


@pytest.mark.parametrize(("age_s", "moves"), [(CAUSAL_S - 1e-6, True), (CAUSAL_S + 1e-6, False)])
def test_a_frame_is_as_old_as_the_beat_that_it_repeats(age_s: float, moves: bool) -> None:
    hand = Hand()
    number = hand.next_beat(10.0)
    assert (hand.hear(frame(1, number), 10.0 + age_s, is_taken=False) is not None) is moves
    assert hand.code == (None if moves else "hand_late")


def test_what_a_network_kept_back_lets_go_until_the_page_does() -> None:
    hand = Hand()
    old = hand.next_beat(10.0)
    assert hand.hear(frame(1, old), 10.0, is_taken=False) is not None
    assert hand.hear(frame(2, old), 10.5, is_taken=False) == RELEASED
    young = hand.next_beat(10.5)
    assert hand.hear(frame(3, young), 10.5, is_taken=False) is None, "pressed still"
    assert hand.hear(frame(4, young, held=False), 10.51, is_taken=False) == RELEASED
    assert hand.hear(frame(5, young), 10.52, is_taken=False) is not None


@pytest.mark.parametrize("number", [0, 7, 10**9])
def test_a_beat_that_was_never_sent_makes_no_frame_young(number: int) -> None:
    hand = Hand()
    hand.next_beat(10.0)
    assert hand.hear(frame(1, number), 10.0, is_taken=False) is None
    assert hand.code == "hand_late"


def test_a_frame_that_is_repeated_or_overtaken_is_not_heard() -> None:
    hand = Hand()
    number = hand.next_beat(10.0)
    assert hand.hear(frame(5, number), 10.0, is_taken=False) is not None
    assert hand.hear(frame(5, number), 10.1, is_taken=False) is None
    assert hand.hear(frame(4, number), 10.2, is_taken=False) is None


def test_a_burst_is_no_flood_at_the_bridge_and_its_end_is_heard() -> None:
    hand = Hand()
    number = hand.next_beat(10.0)
    orders = [hand.hear(frame(seq, number), 10.1, is_taken=False) for seq in range(1, 9)]
    assert sum(order is not None for order in orders) == 1
    assert hand.hear(frame(9, number), 10.101 + APART_S, is_taken=False) is not None
    assert hand.hear(frame(10, number, held=False), 10.101 + APART_S, is_taken=False) == RELEASED


def test_a_second_hand_is_told_so_and_ends_nothing() -> None:
    hand = Hand()
    number = hand.next_beat(10.0)
    assert hand.hear(frame(1, number), 10.0, is_taken=True) is None
    assert hand.code == "hand_taken"
    assert hand.hear(frame(2, number), 10.1, is_taken=False) is None, "it must let go first"
    assert hand.hear(frame(3, number, held=False), 10.2, is_taken=True) == RELEASED
    assert hand.code is None


def test_fractions_become_speeds_below_the_robots_limits(server: Served) -> None:
    limits = RobotDescription().limits
    with opened(server) as socket:
        socket.send('{"name": " Ana "}')
        say(socket, 1)
        heard = say(socket, 2, forward=0.5, left=-1.0, held=True)
        source, v_mps, w_radps, dead_man = told(server, 2)[1]
    assert source == heard["id"]
    assert server.services.robot.names[source] == "Ana"
    assert (v_mps, w_radps) == (0.5 * limits.max_speed_mps, -limits.max_turn_radps)
    assert dead_man is True


def test_a_person_bears_their_own_name_whatever_the_page_says() -> None:
    ana = Person("ana", "Ana", Role.OPERATOR, "2026-01-01T00:00:00+00:00")
    with served(access=replace(LOCAL, find_person={"t": ana}.get)) as running:
        url = f"ws://127.0.0.1:{running.port}/v1/hand"
        with connect(url, additional_headers={"authorization": "Bearer t"}) as socket:
            socket.send('{"name": "Bob"}')
            say(socket, 1)
            source = say(socket, 2, held=True)["id"]
            told(running, 2)
        assert running.services.robot.names[source] == "Ana"


def test_a_socket_that_closes_lets_go(server: Served) -> None:
    with opened(server) as socket:
        say(socket, 1)
        say(socket, 2, held=True)
        told(server, 2)
    assert told(server, 3)[2][1:] == (0.0, 0.0, False)


def test_a_held_stick_that_falls_silent_is_let_go(server: Served) -> None:
    with opened(server) as socket:
        say(socket, 1)
        say(socket, 2, held=True)
        assert told(server, 3)[2][1:] == (0.0, 0.0, False)
        while (heard := beat(socket))["code"] is None:
            pass
        assert heard["code"] == "hand_late"
        say(socket, 3, held=True)
        say(socket, 4)
        assert told(server, 4)[3][1:] == (0.0, 0.0, False)


def test_a_beat_tells_who_drives_and_why_the_stick_does_not(server: Served) -> None:
    server.services.robot.driver = {"id": "page-ana", "name": "Ana"}
    with opened(server) as socket:
        say(socket, 1, held=True)
        while (heard := beat(socket))["code"] is None:
            pass
        assert heard["code"] == "hand_taken"
        assert heard["driver"] == {"id": "page-ana", "name": "Ana"}
        assert heard["mode"] == STATUS.mode
    assert server.services.robot.steers == []


@pytest.mark.parametrize(
    "said",
    ["{", "[]", b"\x00", "x" * 2_000, '{"name": 3}', json.dumps({**FREE, "forward": 1.5}),
     json.dumps({**FREE, "held": 1}), json.dumps({**FREE, "seq": True}),
     json.dumps({**FREE, "beat": -1}), json.dumps({**FREE, "more": 1}),
     '{"seq": 1, "beat": 1, "forward": NaN, "left": 0, "held": true}'],
)  # fmt: skip
def test_what_is_no_frame_is_told_so_and_ends_the_socket(server: Served, said: str | bytes) -> None:
    with opened(server) as socket:
        socket.send(said)
        while (heard := beat(socket))["kind"] != "problem":
            pass
        assert heard["code"] == "unknown_message"
        with pytest.raises(ConnectionClosed):
            [socket.recv(5.0) for _ in range(100)]
    assert server.services.robot.steers == []


def test_so_many_pages_show_a_stick_and_no_more(server: Served) -> None:
    with ExitStack() as stack:
        for _ in range(MOST_SOCKETS):
            stack.enter_context(opened(server))
        with pytest.raises(InvalidStatus) as refused:
            stack.enter_context(opened(server))
    assert refused.value.response.status_code == 503


def test_a_viewer_may_not_steer() -> None:
    access = Access("0.0.0.0", operator_token="o" * 32, viewer_token="v" * 32)
    asked = {"host": "127.0.0.1", "authorization": f"Bearer {'v' * 32}"}
    with pytest.raises(AccessError) as refused:
        access.judge("GET", "/v1/hand", asked, websocket=True)
    assert (refused.value.status, refused.value.code) == (403, "operator_needed")
    access.judge("GET", "/v1/events", asked, websocket=True)


class FakeLink:
    """Hold a status; keep what was steered."""

    def __init__(self, status: Status) -> None:
        self.value, self.age_s = status, 0.0
        self.said: list[Velocity] = []

    @property
    def status(self) -> FakeLink:
        return self

    def teleop(self, velocity: Velocity) -> None:
        self.said.append(velocity)


def steered(status: Status) -> tuple[LinkedRobot, FakeLink]:
    link = FakeLink(status)
    return LinkedRobot(link, RobotDescription()), link  # type: ignore[arg-type]  # what it uses


def test_the_robot_says_whose_hand_steers_by_name() -> None:
    held = StandingHold(reason=HeldReason.TELEOP, id="page-1")
    robot, _ = steered(STATUS.model_copy(update={"mode": Mode.TELEOP, "held": held}))
    assert robot.driver == {"id": "page-1", "name": ""}
    robot.steer("page-1", 0.1, 0.0, dead_man=True, name="Ana")
    assert robot.driver == {"id": "page-1", "name": "Ana"}
    for number in range(MOST_HANDS):
        robot.steer(f"page-x{number}", 0.0, 0.0, dead_man=False)
    assert robot.driver == {"id": "page-1", "name": ""}, "a name is not kept for ever"


@pytest.mark.parametrize("mode", [Mode.HOLD, Mode.ACTIVE, Mode.STOPPING])
def test_who_has_let_go_drives_no_more(mode: Mode) -> None:
    held = StandingHold(reason=HeldReason.TELEOP, id="page-1")
    robot, _ = steered(STATUS.model_copy(update={"mode": mode, "held": held}))
    assert robot.driver is None


def test_numbers_of_a_hand_rise_within_an_epoch() -> None:
    robot, link = steered(STATUS)
    for source in ("a", "b", "a"):
        robot.steer(source, 0.0, 0.0, dead_man=True)
    assert [velocity.seq for velocity in link.said] == [0, 1, 2]
