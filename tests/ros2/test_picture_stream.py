"""The newest picture of a topic is kept by each transport, and what keeps pictures away is told."""

from __future__ import annotations

import base64
import os
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

import pytest

from pons.robot_processes import free_port
from ros2.compressed_image import COMPRESSED_IMAGE, MOST_MESSAGE_BYTES, RAW_IMAGE
from ros2.operations import AskType, NoAnswer, Subscribe, TopicMessage, TopicType, UnreadableMessage
from ros2.picture_stream import PictureListener, PictureStream, StreamedPicture, TopicFailure
from ros2.trouble import Ros2Trouble
from sim.twin.rmw_zenoh_peer import RmwZenohPeer
from sim.twin.rosbridge_server import RosbridgeServer
from tests.ros2.frames import header
from wire.ros2_config import Ros2Config

TOPIC = "/camera/compressed"
DATA = bytes(range(256)) * 300
LIMIT_S = 60.0
DOMAIN = 9


def picture(at_s: float, data: object = DATA) -> dict[str, Any]:
    return {"header": header(at_s) | {"frame_id": "camera"}, "format": "jpeg", "data": data}


def listener() -> PictureListener:
    made = PictureListener(Ros2Config(transport="dds"), TOPIC, 50)
    made.open(1.0)
    return made


def told(made: PictureListener, at_s: float, stamped_s: float) -> float:
    """Hear a picture, and return when it is said to have come."""
    made.hear(TopicMessage(TOPIC, picture(stamped_s)), at_s)
    assert made.newest is not None
    return made.newest.at_s


def test_it_subscribes_what_has_the_right_type_and_asks_about_silence() -> None:
    made = listener()
    assert made.due(1.0) == [AskType(TOPIC)]
    made.hear(TopicType(TOPIC, COMPRESSED_IMAGE), 1.1)
    assert made.due(1.1) == [Subscribe(TOPIC, COMPRESSED_IMAGE, 50)]
    assert made.due(2.9) == []
    assert made.trouble().code == "ros2_topic_silent"
    assert made.due(3.1) == [AskType(TOPIC)]
    told(made, 4.9, 4.8)
    assert made.due(6.8) == []
    assert made.due(7.0) == [AskType(TOPIC)]


def test_only_the_newest_is_kept() -> None:
    made = listener()
    for at_s in (2.0, 2.1, 2.2):
        told(made, at_s, at_s)
    assert made.newest is not None
    assert made.newest.at_s == pytest.approx(2.2)
    made.hear(TopicMessage("/other", picture(2.3)), 2.3)
    assert made.newest.at_s == pytest.approx(2.2)


def test_one_that_was_held_up_is_as_old_as_it_is() -> None:
    made = listener()
    assert told(made, 2.00, 1.98) == pytest.approx(2.00)
    assert told(made, 2.10, 2.08) == pytest.approx(2.10)
    assert told(made, 2.45, 2.18) == pytest.approx(2.20, abs=1e-6), "0.25 s late"
    assert told(made, 2.46, 2.28) == pytest.approx(2.30, abs=1e-6)


def test_a_clock_that_stands_runs_back_or_is_none_dates_by_arrival() -> None:
    made = listener()
    for at_s, stamped_s in ((2.0, 2.0), (2.1, 2.0), (2.2, 2.0), (2.3, -5.0), (2.4, -4.9)):
        assert told(made, at_s, stamped_s) == pytest.approx(at_s)
    made.hear(TopicMessage(TOPIC, picture(0.0) | {"header": None}), 2.5)
    assert made.newest is not None
    assert made.newest.at_s == 2.5


@pytest.mark.parametrize(
    ("said", "code"),
    [
        (TopicType(TOPIC, ""), "ros2_topic_missing"),
        (TopicType(TOPIC, RAW_IMAGE), "ros2_image_raw"),
        (TopicType(TOPIC, "sensor_msgs/Image"), "ros2_image_raw"),
        (TopicType(TOPIC, "std_msgs/msg/String"), "ros2_topic_type"),
        (NoAnswer(TOPIC, "no service"), "ros2_no_rosapi"),
        (UnreadableMessage(TOPIC, "cut"), "ros2_unreadable"),
        (TopicMessage(TOPIC, picture(1.0, data=7)), "ros2_unreadable"),
        (TopicMessage(TOPIC, picture(1.0) | {"format": "compressedDepth"}), "ros2_image_depth"),
    ],
)
def test_what_is_wrong_is_named_until_a_picture_came(said: Any, code: str) -> None:
    made = listener()
    made.hear(said, 1.2)
    assert made.trouble().code == code
    assert made.newest is None
    made.hear(TopicType(TOPIC, COMPRESSED_IMAGE), 1.3)
    told(made, 1.4, 1.4)
    assert made.trouble().code == "ros2_topic_silent"


def test_a_lost_connection_is_told_and_one_that_was_too_much_stays_told() -> None:
    made = listener()
    made.close(Ros2Trouble("ros2_no_router", "gone"))
    assert (made.trouble().code, made.due(9.0)) == ("ros2_no_router", [AskType(TOPIC)])
    made.close(Ros2Trouble("ros2_message_too_large", "16 MB"))
    made.open(10.0)
    assert made.trouble().code == "ros2_message_too_large"


class Camera(threading.Thread):
    """Say pictures on a twin's server, 30 a second."""

    def __init__(self, say: Callable[[dict[str, Any]], None]) -> None:
        super().__init__(daemon=True)
        self.say, self.ending = say, threading.Event()

    def run(self) -> None:
        while not self.ending.wait(1 / 30):
            self.say(picture(time.monotonic()))


@contextmanager
def running(say: Callable[[dict[str, Any]], None]) -> Iterator[None]:
    camera = Camera(say)
    camera.start()
    yield
    camera.ending.set()
    camera.join()


@contextmanager
def streaming(ros2: Ros2Config) -> Iterator[PictureStream]:
    stream = PictureStream(ros2, TOPIC)
    yield stream
    stream.close()


def by_json(said: dict[str, Any]) -> dict[str, Any]:
    return said | {"data": base64.b64encode(said["data"]).decode()}


@pytest.fixture
def server() -> Iterator[RosbridgeServer]:
    made = RosbridgeServer(0, {TOPIC: COMPRESSED_IMAGE})
    yield made
    made.close()


def is_fresh(found: StreamedPicture) -> bool:
    return found.packed.data == DATA and time.monotonic() - found.at_s < 2.0


def test_pictures_come_through_rosbridge_each_once_and_go_on_after_a_cut(
    server: RosbridgeServer,
) -> None:
    ros2 = Ros2Config(url=f"ws://127.0.0.1:{server.port}")
    with running(lambda said: server.publish(TOPIC, by_json(said))), streaming(ros2) as stream:
        found = [stream.take(LIMIT_S) for _ in range(5)]
        assert all(map(is_fresh, found))
        stamps = [one.packed.stamp_s for one in found]
        assert len(set(stamps)) == len(stamps)
        server.hang_up()
        assert is_fresh(stream.take(LIMIT_S))


def test_one_that_no_camera_sends_ends_the_connection_and_is_named(server: RosbridgeServer) -> None:
    ros2 = Ros2Config(url=f"ws://127.0.0.1:{server.port}")
    huge = "A" * (MOST_MESSAGE_BYTES + 8)
    with streaming(ros2) as stream, ExitStack() as stack:
        ending = threading.Event()

        def say() -> None:
            while not ending.wait(0.2):
                server.publish(TOPIC, {"data": huge})

        speaking = threading.Thread(target=say)
        speaking.start()
        stack.callback(speaking.join)
        stack.callback(ending.set)
        code, end_s = "", time.monotonic() + LIMIT_S
        while code != "ros2_message_too_large" and time.monotonic() < end_s:
            with pytest.raises(TopicFailure) as why:
                stream.take(0.2)
            code = why.value.trouble.code
    assert code == "ros2_message_too_large"


def test_a_fault_of_our_own_is_raised_where_pictures_are_taken(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def fail(*_: object) -> None:
        raise RuntimeError("a fault of ours")

    monkeypatch.setattr("ros2.picture_stream.open_transport", fail)
    with (
        streaming(Ros2Config(transport="dds")) as stream,
        pytest.raises(RuntimeError, match="of ours"),
    ):
        stream.take(LIMIT_S)


def test_a_server_that_is_not_there_is_told() -> None:
    with (
        streaming(Ros2Config(url=f"ws://127.0.0.1:{free_port()}")) as stream,
        pytest.raises(TopicFailure) as why,
    ):
        stream.take(0.5)
    assert why.value.trouble.code == "ros2_no_server"


@pytest.mark.e2e
def test_pictures_come_by_rmw_zenoh() -> None:
    port = free_port()
    ros2 = Ros2Config(transport="zenoh", router=f"tcp/127.0.0.1:{port}", domain=DOMAIN)
    peer = RmwZenohPeer(port, {TOPIC: COMPRESSED_IMAGE}, (), DOMAIN)
    try:
        with running(lambda said: peer.publish(TOPIC, said)), streaming(ros2) as stream:
            assert is_fresh(stream.take(LIMIT_S))
            assert is_fresh(stream.take(LIMIT_S))
    finally:
        peer.close()


def test_pictures_come_by_dds() -> None:
    pytest.importorskip("cyclonedds", reason="the extra dds is not installed (x86_64 alone)")
    from tests.ros2.graph_peers import DdsPeer

    domain = 165 + os.getpid() % 60
    ros2 = Ros2Config(transport="dds", domain=domain, interface="lo")
    peer = DdsPeer(domain, {TOPIC: COMPRESSED_IMAGE})
    try:
        with running(lambda said: peer.publish(TOPIC, said)), streaming(ros2) as stream:
            assert is_fresh(stream.take(LIMIT_S))
            assert is_fresh(stream.take(LIMIT_S))
    finally:
        peer.close()
