"""A few messages are asked for, and what keeps them away is told by a code."""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import Iterator

import pytest

from pons.robot_processes import free_port
from ros2.operations import (
    AskType,
    NoAnswer,
    Subscribe,
    TopicMessage,
    TopicType,
    UnreadableMessage,
)
from ros2.topic_request import TopicRequest, WantedTopic, collect
from ros2.trouble import Ros2Trouble, TopicFailure
from sim.twin.rosbridge_server import RosbridgeServer
from wire.ros2_config import Ros2Config

MAP = WantedTopic("/map", "nav_msgs/msg/OccupancyGrid", keeps=True)


def request(transport: str = "dds") -> TopicRequest:
    made = TopicRequest(Ros2Config.model_validate({"transport": transport}), [MAP])
    made.open(1.0)
    return made


def code(made: TopicRequest) -> str | None:
    trouble = made.trouble()
    return trouble.code if trouble else None


def test_a_topic_is_subscribed_once_its_type_is_known_to_be_right() -> None:
    made = request()
    assert made.due(1.0) == [AskType("/map")]
    assert made.due(1.1) == []
    assert code(made) == "ros2_no_peer"
    made.hear(TopicType("/map", "nav_msgs/OccupancyGrid"), 1.2)
    assert made.due(1.2) == [Subscribe("/map", MAP.kind, keeps=True)]
    assert made.due(3.0) == []
    assert code(made) == "ros2_topic_silent"
    made.hear(TopicMessage("/other", {}), 3.1)
    made.hear(TopicMessage("/map", {"a": 1}), 3.1)
    assert code(made) is None
    assert made.messages == {"/map": [{"a": 1}]}


@pytest.mark.parametrize(
    ("said", "expected"),
    [
        (TopicType("/map", ""), "ros2_topic_missing"),
        (TopicType("/map", "std_msgs/msg/String"), "ros2_topic_type"),
        (NoAnswer("/map", "no service"), "ros2_no_rosapi"),
        (UnreadableMessage("/map", "cut"), "ros2_unreadable"),
    ],
)
def test_what_is_wrong_is_named_and_not_subscribed(
    said: TopicType | NoAnswer | UnreadableMessage, expected: str
) -> None:
    made = request()
    made.hear(said, 1.1)
    assert code(made) == expected
    assert [one for one in made.due(1.2) if isinstance(one, Subscribe)] == []


def test_a_connection_that_went_is_the_trouble_and_a_new_one_begins_anew() -> None:
    made = request()
    made.hear(TopicType("/map", MAP.kind), 1.1)
    made.close(Ros2Trouble("ros2_no_router", "gone"))
    assert (code(made), made.due(9.0)) == ("ros2_no_router", [])
    made.open(10.0)
    assert made.due(10.0) == [AskType("/map")]


@pytest.fixture
def server() -> Iterator[RosbridgeServer]:
    made = RosbridgeServer(0, {"/map": MAP.kind})
    yield made
    made.close()


def collected(port: int, limit_s: float) -> dict[str, list[dict[str, object]]]:
    ros2 = Ros2Config.model_validate({"url": f"ws://127.0.0.1:{port}"})
    return asyncio.run(collect(ros2, [MAP], lambda heard: bool(heard["/map"]), limit_s))


def test_a_message_longer_than_any_scan_comes_through_a_server(server: RosbridgeServer) -> None:
    ending = threading.Event()

    def say() -> None:
        while not ending.wait(1.0):
            server.publish("/map", {"data": [0] * 600_000})

    speaking = threading.Thread(target=say)
    speaking.start()
    began_s = time.monotonic()
    try:
        heard = collected(server.port, 20.0)
    finally:
        ending.set()
        speaking.join()
    assert len(heard["/map"][0]["data"]) == 600_000  # type: ignore[arg-type]  # a list
    assert time.monotonic() - began_s < 20.0


def test_a_server_that_is_not_there_and_a_map_that_never_comes_are_told(
    server: RosbridgeServer,
) -> None:
    with pytest.raises(TopicFailure) as nobody:
        collected(free_port(), 0.3)
    assert nobody.value.trouble.code == "ros2_no_server"
    with pytest.raises(TopicFailure) as silent:
        collected(server.port, 0.5)
    assert silent.value.trouble.code == "ros2_topic_silent"
