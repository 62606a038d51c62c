"""rosbridge's operations are written as its page says, and what is none is read as nothing."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2 import rosbridge
from ros2.operations import (
    Advertise,
    Answer,
    AskType,
    NoAnswer,
    Publish,
    ServerWords,
    Subscribe,
    TopicMessage,
    TopicType,
    Unadvertise,
    plain_type,
)


def test_what_is_sent_has_the_members_that_the_protocol_names() -> None:
    assert json.loads(rosbridge.write(Advertise("/a", "p/msg/T"))) == {
        "op": "advertise", "topic": "/a", "type": "p/msg/T"
    }  # fmt: skip
    assert json.loads(rosbridge.write(Publish("/a", {"x": 1}))) == {
        "op": "publish", "topic": "/a", "msg": {"x": 1}
    }  # fmt: skip
    assert json.loads(rosbridge.write(Subscribe("/a", "p/msg/T", 10))) == {
        "op": "subscribe", "topic": "/a", "type": "p/msg/T", "throttle_rate": 10,
        "queue_length": 1,
    }  # fmt: skip
    assert json.loads(rosbridge.write(AskType("/a"))) == {
        "op": "call_service", "id": "type:/a", "service": "/rosapi/topic_type",
        "args": {"topic": "/a"},
    }  # fmt: skip
    assert json.loads(rosbridge.write(Unadvertise("/a"))) == {"op": "unadvertise", "topic": "/a"}


def test_a_number_that_json_lacks_is_not_sent() -> None:
    with pytest.raises(ValueError, match="JSON compliant"):
        rosbridge.write(Publish("/a", {"x": float("nan")}))


@pytest.mark.parametrize(
    ("frame", "expected"),
    [
        ({"op": "publish", "topic": "/a", "msg": {}}, TopicMessage("/a", {})),
        ({"op": "publish", "topic": "/a", "msg": None}, None),
        ({"op": "publish", "topic": 7, "msg": {}}, None),
        ({"op": "status", "level": "error", "msg": "no"}, ServerWords("error", "no")),
        (
            {"op": "service_response", "id": "type:/a", "values": {"type": "p/msg/T"},
             "result": True}, TopicType("/a", "p/msg/T"),
        ),
        (
            {"op": "service_response", "id": "type:/a", "values": "no service", "result": False},
            NoAnswer("/a", "no service"),
        ),
        ({"op": "service_response", "id": "type:/a", "values": {}}, NoAnswer("/a", "{}")),
        ({"op": "service_response", "id": "another", "values": {"type": ""}}, None),
        ({"op": "service_response", "values": {"type": ""}}, None),
        ({"op": "png", "data": ""}, None),
        ([], None),
        (7, None),
    ],
)  # fmt: skip
def test_what_comes_is_read_or_is_nothing(frame: object, expected: Answer | None) -> None:
    assert rosbridge.read(json.dumps(frame)) == expected


@given(st.binary(max_size=64) | st.text(max_size=64))
def test_no_bytes_raise(frame: bytes | str) -> None:
    rosbridge.read(frame)


@pytest.mark.parametrize(
    "frame",
    [
        r'{"op":"service_response","id":"type:/odom","values":{"type":"x\ud800"},"result":true}',
        r'{"op":"service_response","id":"type:/odom","values":"x\ud800","result":false}',
        r'{"op":"status","level":"error","msg":"x\ud800"}',
        r'{"op":"status","level":"\ud800","msg":"x"}',
    ],
)
def test_half_of_a_letter_is_told_to_people_as_a_question_mark(frame: str) -> None:
    said = rosbridge.read(frame)
    assert said is not None
    assert "?" in str(said)
    str(said).encode()


def test_a_deep_nest_is_nothing() -> None:
    assert rosbridge.read("[" * 200_000) is None


def test_types_are_compared_with_and_without_msg() -> None:
    assert plain_type("p/msg/T") == plain_type("p/T") == "p/T"
