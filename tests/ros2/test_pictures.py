"""Pictures of a robot are dated and paired with their depth, or it is said why there are none."""

from __future__ import annotations

import json

import pytest

from ros2.pictures import PAIR_S, RosPictureListener
from tests.known import known


def head(stamp_s: float | None = 100.0, **more: object) -> bytes:
    return json.dumps({"kind": "packed", "format": "jpeg", "stamp_s": stamp_s} | more).encode()


def test_a_picture_that_was_held_up_on_its_way_is_dated_as_older() -> None:
    listener = RosPictureListener("tcp/x:1")
    first = listener.hear(head(100.0), b"a", 10.0)
    late = listener.hear(head(100.1), b"b", 10.3)
    assert first is not None
    assert late is not None
    assert first.at_s == 10.0
    assert late.at_s == pytest.approx(10.1)
    for stamp_s in (None, 0.0):
        unstamped = known(listener.hear(head(stamp_s), b"c", 11.0))
        assert unstamped.at_s == 11.0


def test_depth_of_the_same_time_belongs_to_a_picture() -> None:
    listener = RosPictureListener("tcp/x:1")
    listener.hear_depth(head(100.0), b"depth")
    with_it = listener.hear(head(100.0 + PAIR_S / 2), b"a", 10.0)
    without = listener.hear(head(100.0 + 2 * PAIR_S), b"b", 10.2)
    assert with_it is not None
    assert without is not None
    assert (known(with_it.depth)[1], without.depth) == (b"depth", None)


@pytest.mark.parametrize(
    ("said", "data", "code"),
    [
        (
            head(code="ros2_topic_missing", found="picture /x is not there"),
            b"",
            "ros2_topic_missing",
        ),
        (head(), b"", "ros2_unreadable"),
        (b"{", b"a", "ros2_unreadable"),
        (head(kind="other"), b"a", "ros2_unreadable"),
        (head(code="of_a_newer_package"), b"", "ros2_relay_silent"),
    ],
)
def test_what_is_no_picture_is_told(said: bytes, data: bytes, code: str) -> None:
    listener = RosPictureListener("tcp/x:1")
    assert listener.trouble(joined=True).code == "ros2_topic_silent"
    assert listener.hear(said, data, 10.0) is None
    assert listener.trouble(joined=True).code == code
    assert listener.trouble(joined=False).code == "ros2_no_node"
