"""The twin's rosbridge server keeps the protocol's page, as a plain client sees it."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

from sim.twin.rosbridge_server import RosbridgeServer
from wire import ConfigError

LIMIT_S = 5.0
TWIST = "geometry_msgs/msg/Twist"


@pytest.fixture
def server() -> Iterator[RosbridgeServer]:
    made = RosbridgeServer(0, {"/cmd_vel": TWIST, "/odom": "nav_msgs/msg/Odometry"})
    yield made
    made.close()


@pytest.fixture
def client(server: RosbridgeServer) -> Iterator[ClientConnection]:
    with connect(f"ws://127.0.0.1:{server.port}", proxy=None, compression=None) as made:
        yield made


def ask(client: ClientConnection, **raw: object) -> dict[str, Any]:
    client.send(json.dumps(raw))
    answer = json.loads(client.recv(LIMIT_S))
    assert isinstance(answer, dict)
    return answer


def taken(server: RosbridgeServer, count: int) -> list[tuple[str, dict[str, Any]]]:
    found: list[tuple[str, dict[str, Any]]] = []
    end_s = time.monotonic() + LIMIT_S
    while len(found) < count:
        assert time.monotonic() < end_s, found
        found += server.take()
        time.sleep(0.001)
    return found


def ask_type(client: ClientConnection, topic: str) -> dict[str, Any]:
    return ask(
        client, op="call_service", id="1", service="/rosapi/topic_type", args={"topic": topic}
    )


def test_the_graph_answers_types_and_nothing_for_what_it_has_not(client: ClientConnection) -> None:
    assert ask_type(client, "/cmd_vel") == {
        "op": "service_response", "id": "1", "service": "/rosapi/topic_type",
        "values": {"type": TWIST}, "result": True,
    }  # fmt: skip
    assert ask_type(client, "/other")["values"] == {"type": ""}
    unknown = ask(client, op="call_service", service="/rosapi/nothing")
    assert (unknown["result"], "id" in unknown) == (False, False)


def test_what_was_advertised_is_heard_and_what_was_not_is_an_error(
    server: RosbridgeServer, client: ClientConnection
) -> None:
    refused = ask(client, op="publish", topic="/new", msg={"data": 1})
    assert (refused["op"], refused["level"]) == ("status", "error")
    client.send(json.dumps({"op": "advertise", "topic": "/new", "type": "std_msgs/msg/Int8"}))
    client.send(json.dumps({"op": "publish", "topic": "/new", "msg": {"data": 1}}))
    assert taken(server, 1) == [("/new", {"data": 1})]
    other = ask(client, op="advertise", topic="/new", type="std_msgs/msg/String")
    assert "it is std_msgs/msg/Int8" in other["msg"]


def test_infinity_goes_out_as_null_to_who_subscribed_and_no_faster_than_asked(
    server: RosbridgeServer, client: ClientConnection
) -> None:
    client.send(json.dumps({"op": "subscribe", "topic": "/odom", "throttle_rate": 60_000}))
    assert ask_type(client, "/odom")["result"]
    for _ in range(3):
        server.publish("/odom", {"x": float("inf"), "y": [float("nan"), 1.0]})
        server.publish("/cmd_vel", {})
    came = json.loads(client.recv(LIMIT_S))
    assert came == {"op": "publish", "topic": "/odom", "msg": {"x": None, "y": [None, 1.0]}}
    assert ask_type(client, "/odom")["op"] == "service_response", "throttled: nothing between"
    client.send(json.dumps({"op": "unsubscribe", "topic": "/odom"}))


def test_a_subscription_of_another_type_is_an_error(client: ClientConnection) -> None:
    refused = ask(client, op="subscribe", topic="/odom", type=TWIST)
    assert "it is nav_msgs/msg/Odometry" in refused["msg"]


@pytest.mark.parametrize("frame", ["{", "[]", "7", '{"op": "dance"}', '{"op": "advertise"}'])
def test_what_is_no_operation_is_an_error(client: ClientConnection, frame: str) -> None:
    client.send(frame)
    assert json.loads(client.recv(LIMIT_S))["level"] == "error"


def test_hanging_up_cuts_without_a_word(server: RosbridgeServer, client: ClientConnection) -> None:
    assert ask_type(client, "/odom")["result"]
    server.hang_up()
    with pytest.raises(ConnectionClosed):
        client.recv(LIMIT_S)


def test_a_port_that_is_taken_is_refused(server: RosbridgeServer) -> None:
    with pytest.raises(ConfigError, match="twin_port"):
        RosbridgeServer(server.port, {})
