"""Bytes of true ROS 2 nodes are read as ROS reads them, and what Pons writes is as they write it.

golden/kilted_messages.json was written by rclpy 9.1 (Kilted, Fast CDR) with serialize_message.
"""

from __future__ import annotations

import json
import struct
from math import isnan
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2 import cdr
from ros2.layouts import LAYOUTS
from ros2.robot_words import Unreadable
from sim.twin import cdr_writer

GOLDEN = json.loads((Path(__file__).parent / "golden" / "kilted_messages.json").read_text())
KINDS = sorted(GOLDEN)


def as_json(value: Any) -> Any:
    """Return a decoded message as the golden file has it."""
    if isinstance(value, dict):
        return {name: as_json(one) for name, one in value.items()}
    if isinstance(value, float):
        return value if abs(value) < 1e300 else str(value)
    return value if isinstance(value, str | int) else [as_json(one) for one in value]


@pytest.mark.parametrize("kind", KINDS)
def test_bytes_of_a_true_node_are_read(kind: str) -> None:
    assert as_json(cdr.decode(kind, bytes.fromhex(GOLDEN[kind]["hex"]))) == GOLDEN[kind]["message"]


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_written_is_as_long_and_reads_the_same(kind: str) -> None:
    theirs = bytes.fromhex(GOLDEN[kind]["hex"])
    ours = cdr.encode(kind, cdr.decode(kind, theirs))
    assert len(ours) == len(theirs)
    assert cdr.decode(kind, ours) == cdr.decode(kind, theirs)


@pytest.mark.parametrize("kind", ["geometry_msgs/msg/Twist", "geometry_msgs/msg/PoseStamped"])
def test_what_pons_says_is_byte_for_byte_as_ros_says_it(kind: str) -> None:
    theirs = bytes.fromhex(GOLDEN[kind]["hex"])
    assert cdr.encode(kind, GOLDEN[kind]["message"]) == theirs


def test_packed_pictures_are_bytes_both_ways() -> None:
    kind = "sensor_msgs/msg/CompressedImage"
    read = cdr.decode(kind, bytes.fromhex(GOLDEN[kind]["hex"]))
    assert read["data"] == b"\xff\xd8\xff\x00\x07"
    assert cdr.encode(kind, read).hex() == GOLDEN[kind]["hex"]


def test_the_big_end_may_come_first() -> None:
    payload = b"\x00\x00\x00\x00" + struct.pack(">6d", 1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    twist = cdr.decode("geometry_msgs/msg/Twist", payload)
    assert (twist["linear"]["x"], twist["angular"]["z"]) == (1.0, 6.0)


def test_a_field_that_is_missing_is_zero() -> None:
    assert cdr.encode("geometry_msgs/msg/Twist", {"linear": {"x": 1.0}}) == cdr.encode(
        "geometry_msgs/msg/Twist",
        {"linear": {"x": 1.0, "y": 0.0, "z": 0.0}, "angular": dict.fromkeys("xyz", 0.0)},
    )


@pytest.mark.parametrize(
    ("kind", "message"),
    [
        ("geometry_msgs/msg/Twist", {"linear": {"x": "fast"}}),
        ("geometry_msgs/msg/Twist", {"linear": 7}),
        ("std_msgs/msg/String", {"data": 7}),
        ("nav_msgs/msg/Odometry", {"pose": {"covariance": [0.0]}}),
        ("std_msgs/msg/Header", {"stamp": {"sec": 1 << 40}}),
    ],
)
def test_what_does_not_fit_its_field_is_refused(kind: str, message: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match=f"no {kind}"):
        cdr.encode(kind, message)


@pytest.mark.parametrize(
    ("payload", "says"),
    [
        (b"", "nothing"),
        (b"\x00\x01\x00", "expected plain CDR"),
        (b"\x00\x03\x00\x00" + bytes(48), "expected plain CDR"),
        (b"\x00\x01\x00\x00" + bytes(47), "end within a geometry_msgs/msg/Twist"),
    ],
)
def test_what_is_no_message_is_refused(payload: bytes, says: str) -> None:
    with pytest.raises(Unreadable, match=says):
        cdr.decode("geometry_msgs/msg/Twist", payload)


def test_a_length_that_cannot_be_reserves_nothing() -> None:
    whole = bytes.fromhex(GOLDEN["nav_msgs/msg/OccupancyGrid"]["hex"])
    with pytest.raises(Unreadable, match="where 6 bytes are left"):
        cdr.decode("nav_msgs/msg/OccupancyGrid", whole[:-10] + b"\xff\xff\xff\xff" + whole[-6:])


@given(st.sampled_from(sorted(LAYOUTS)), st.binary(max_size=200))
def test_strangers_bytes_are_read_or_refused(kind: str, payload: bytes) -> None:
    for head in (b"", b"\x00\x01\x00\x00", b"\x00\x00\x00\x00"):
        try:
            cdr.decode(kind, head + payload)
        except Unreadable:
            continue


@given(st.integers(0, 400))
def test_a_true_message_that_was_cut_is_refused(cut: int) -> None:
    whole = bytes.fromhex(GOLDEN["nav_msgs/msg/Odometry"]["hex"])
    with pytest.raises(Unreadable):
        cdr.decode("nav_msgs/msg/Odometry", whole[:cut])


@pytest.mark.parametrize("kind", sorted(cdr_writer.WRITERS))
def test_what_the_twin_writes_by_its_own_code_is_read(kind: str) -> None:
    message = cdr.decode(kind, bytes.fromhex(GOLDEN[kind]["hex"]))
    message["ranges"] = [None if one == float("inf") else one for one in message.get("ranges", [])]
    read = cdr.decode(kind, cdr_writer.WRITERS[kind](message))
    for name in ("header", "data", "pose", "twist", "angular_velocity", "angle_min", "range_max"):
        assert read.get(name) == message.get(name)
    if kind.endswith("LaserScan"):
        assert isnan(read["ranges"][1])
        assert read["ranges"][2] == 1.5


def test_the_twin_reads_what_is_written() -> None:
    assert cdr_writer.read_string(cdr.encode("std_msgs/msg/String", {"data": "停 go"})) == "停 go"
    assert cdr_writer.read_string(b"\x00\x01") == ""
