"""However many watch, all is looked at once; who is slow gets the newest alone."""

from __future__ import annotations

import asyncio
import base64
import json
import re
from typing import Any

import pytest
from starlette.websockets import WebSocketDisconnect

from planner.api import Access
from planner.api.live_state import ROBOT_S, SCAN_S, STANDING_S, Feed, Listener
from planner.mission import Leg
from planner.mission.activity import RouteDoubt
from planner.navigation import RoutePoint
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of
from tests.wire.examples import STATUS
from wire import Mode, Twist2

HOST = {"host": "127.0.0.1:8420"}
TOKEN = "a token of many characters/+"


class Clock:
    """Tell the time that a test sets."""

    now_s = 0.0

    def __call__(self) -> float:
        return self.now_s


async def taken(listener: Listener) -> list[dict[str, Any]]:
    bodies = await asyncio.wait_for(listener.take(), 1.0)
    return [json.loads("{" + body) for body in bodies]


def kinds(frames: list[dict[str, Any]]) -> list[str]:
    return sorted(str(frame["kind"]) for frame in frames)


async def watched(services: FakeServices, clock: Clock) -> tuple[Feed, Listener]:
    feed = Feed(services, clock=clock)
    listener = feed.listen()
    feed.look()
    await taken(listener)
    return feed, listener


@pytest.mark.parametrize(
    ("mode", "v_mps", "robot_s"),
    [
        (Mode.HOLD, 0.0, STANDING_S),
        (Mode.HOLD, -0.05, ROBOT_S),
        (Mode.ACTIVE, 0.0, ROBOT_S),
        (None, 0.0, STANDING_S),
    ],
)
async def test_robot_and_scan_come_at_their_rates_and_no_faster(
    mode: Mode | None, v_mps: float, robot_s: float
) -> None:
    services, clock = FakeServices(), Clock()
    measured = Twist2(v_mps=v_mps, w_radps=0.0)
    services.robot._status = (
        None if mode is None else STATUS.model_copy(update={"mode": mode, "measured": measured})
    )
    feed, listener = await watched(services, clock)
    counts = {"robot": 0, "scan": 0, "path": 0}
    for tick in range(1, 101):
        clock.now_s = tick * 0.02
        feed.look()
        if listener._waiting:
            for frame in await taken(listener):
                counts[str(frame["kind"])] += 1
    assert counts["robot"] == pytest.approx(2.0 / robot_s, abs=3)
    assert counts["scan"] == pytest.approx(2.0 / SCAN_S, abs=2)
    assert counts["path"] == 0
    feed.leave(listener)


async def test_a_change_of_mode_is_told_at_once() -> None:
    services, clock = FakeServices(), Clock()
    feed, listener = await watched(services, clock)
    clock.now_s = 0.02
    feed.look()
    assert not listener._waiting
    services.robot._status = STATUS.model_copy(update={"mode": Mode.STOPPING})
    feed.look()
    frames = await taken(listener)
    assert kinds(frames) == ["robot"]
    assert frames[0]["robot"]["status"]["mode"] == "STOPPING"
    feed.leave(listener)


async def test_a_new_leg_brings_its_path_once_and_its_end_takes_it_away() -> None:
    services, clock = FakeServices(), Clock()
    feed, listener = await watched(services, clock)
    points = (RoutePoint(1.00049, 2.0, 0.3), RoutePoint(1.5, 2.0, 0.3))
    services.goals.leg = Leg("g1", 4, points)
    feed.look()
    feed.look()
    [frame] = await taken(listener)
    way = {"goal": "g1", "leg": 4, "points": [[1.0, 2.0], [1.5, 2.0]]}
    assert frame["path"] == {**way, "doubt": None}
    services.goals.leg = None
    feed.look()
    assert await taken(listener) == [{"kind": "path", "path": None}]
    feed.leave(listener)


async def test_why_a_way_bends_or_goes_on_is_told_with_its_path() -> None:
    services, clock = FakeServices(), Clock()
    feed, listener = await watched(services, clock)
    points = (RoutePoint(1.0, 2.0, 0.3),)
    services.goals.leg = Leg("g1", 4, points)
    feed.look()
    assert len(await taken(listener)) == 1
    doubt = RouteDoubt(4, (1.006, 2.0), 1.0, 1.2, "route_kept")
    services.goals.leg = Leg("g1", 4, points, doubt)
    feed.look()
    [frame] = await taken(listener)
    news = frame["path"]["doubt"]
    assert (news["code"], news["x_m"], news["y_m"]) == ("route_kept", 1.01, 2.0)
    assert "no other way" in news["message"]["en"]
    assert "没有别的路" in news["message"]["zh"]
    services.goals.leg = Leg("g1", 4, points)
    feed.look()
    [over] = await taken(listener)
    assert over["path"]["doubt"] is None
    feed.leave(listener)


async def test_who_is_slow_gets_the_newest_of_each_kind() -> None:
    services, clock = FakeServices(), Clock()
    feed, listener = await watched(services, clock)
    for tick in range(1, 200):
        clock.now_s = tick * 0.5
        services.robot.points = [(float(tick), -0.004)]
        feed.look()
    frames = await taken(listener)
    assert kinds(frames) == ["robot", "scan"]
    [scan] = [frame["scan"] for frame in frames if frame["kind"] == "scan"]
    assert scan == [19_900, 0]
    feed.leave(listener)


async def test_nobody_listening_costs_nothing() -> None:
    feed = Feed(FakeServices())
    first, second = feed.listen(), feed.listen()
    task = feed._task
    assert task is not None
    feed.leave(first)
    await asyncio.sleep(0)
    assert not task.done()
    feed.leave(second)
    await asyncio.sleep(0)
    assert task.cancelled()
    assert feed._task is None


def test_a_page_that_lost_count_gets_another_snapshot() -> None:
    with (
        client_of(FakeServices()) as client,
        client.websocket_connect("/v1/events", headers=dict(HOST)) as socket,
    ):
        first = socket.receive_json()
        assert (first["seq"], first["kind"]) == (1, "snapshot")
        assert re.fullmatch(r"\d+\.\d+\.\d+", first["about"]["version"])
        assert first["about"]["base"]["wheel_separation_m"] == 0.5
        socket.send_text('{"snapshot": true}')
        seqs = [1]
        while (frame := socket.receive_json())["kind"] != "snapshot":
            seqs.append(frame["seq"])
        assert [*seqs, frame["seq"]] == list(range(1, frame["seq"] + 1))


def offered(token: str) -> list[str]:
    text = base64.urlsafe_b64encode(token.encode()).decode().rstrip("=")
    return ["pons.v1", f"bearer.{text}"]


def test_a_browser_gives_its_token_as_a_subprotocol_and_does_not_get_it_back() -> None:
    access = Access("0.0.0.0", hosts=frozenset({"127.0.0.1"}), operator_token=TOKEN)
    with (
        client_of(FakeServices(), access) as client,
        client.websocket_connect(
            "/v1/events", subprotocols=offered(TOKEN), headers=dict(HOST)
        ) as socket,
    ):
        assert socket.accepted_subprotocol == "pons.v1"
        assert socket.receive_json()["kind"] == "snapshot"


def test_a_socket_without_the_token_is_refused() -> None:
    access = Access("0.0.0.0", hosts=frozenset({"127.0.0.1"}), operator_token=TOKEN)
    with client_of(FakeServices(), access) as client:
        for offer in ([], ["pons.v1"], offered("another token"), ["bearer.%%%"]):
            with (
                pytest.raises(WebSocketDisconnect),
                client.websocket_connect("/v1/events", subprotocols=offer, headers=dict(HOST)),
            ):
                pytest.fail(f"{offer} opened a socket")
