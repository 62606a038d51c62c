"""What is exported is a rosbag2 that an independent reader knows whole, figure by figure."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import pytest
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from bridge.recording.mcap_reader import Raw
from bridge.recording.protobuf import laser_scan
from pons import record
from pons.record.ros2_messages import DEFINITIONS, definition, encode, ros_name
from pons.record.ros2_topics import TYPES
from pons.record.rosbag import write_rosbag

AT_NS = 1_800_000_000_250_000_000
STAMP = {"sec": 1_800_000_000, "nsec": 250_000_000}
POSE = {"position": {"x": 1.5, "y": 2.5, "z": 0.0},
        "orientation": {"x": 0.0, "y": 0.0, "z": 0.6, "w": 0.8}}  # fmt: skip


def raw(topic: str, told: dict[str, Any] | bytes) -> Raw:
    data = told if isinstance(told, bytes) else json.dumps(told).encode()
    return Raw(topic=topic, sequence=7, at_ns=AT_NS, data=data)


SCAN = laser_scan(
    AT_NS, "base", (0.1, 0.0, (0.0, 1.0)), (-1.0, 1.0), struct.pack("<3d", 1.0, float("inf"), 2.0)
)
RECORDED = [
    raw("/scan", SCAN),
    raw("/pons/inbox", {"inbox": {"scan": {
        "angle_min_rad": -1.0, "angle_increment_rad": 1.0, "range_min_m": 0.1, "range_max_m": 12.0,
    }}}),
    raw("/pons/inbox", {"inbox": {}}),
    raw("/tf", {"timestamp": STAMP, "parent_frame_id": "map", "child_frame_id": "odom",
                "translation": {"x": 1.0, "y": 0.0, "z": 0.0}, "rotation": POSE["orientation"]}),
    raw("/pons/odometry", {"base_in_odom": {"x_m": 1.0, "y_m": 2.0, "yaw_rad": 0.0},
                           "twist": {"v_mps": 0.4, "w_radps": -0.2}}),
    raw("/pose", {"timestamp": STAMP, "frame_id": "map", "pose": POSE}),
    raw("/plan", {"timestamp": STAMP, "frame_id": "map", "poses": [POSE, POSE]}),
    raw("/pons/decision", {"sent": {"v_mps": 0.3, "w_radps": 0.1}}),
    raw("/log", {"timestamp": STAMP, "level": 3, "message": "row_up X", "name": "bridge"}),
    raw("/pons/status", {"mode": "HOLD", "robot": "r1", "rows": [
        {"row": "POSE_LOST", "action": "HOLD2", "evidence": "none", "for_s": 1.0}]}),
    raw("/pons/boot", {"config": {"robot": {"lidar": {"x_m": 0.1, "y_m": 0.0, "yaw_rad": 3.0}}}}),
    raw("/pons/state", {}),
]  # fmt: skip


def read(folder: Path) -> dict[str, Any]:
    """Return each topic's last message, by the definitions that the bag itself holds."""
    store = get_typestore(Stores.EMPTY)
    for kind in TYPES.values():
        store.register(get_types_from_msg(definition(kind), ros_name(kind)))
    found: dict[str, Any] = {}
    with Reader(folder) as bag:
        for connection, at_ns, data in bag.messages():
            assert at_ns == AT_NS
            found[connection.topic] = store.deserialize_cdr(data, connection.msgtype)
    return found


def test_an_independent_reader_knows_every_type_and_figure(tmp_path: Path) -> None:
    folder = tmp_path / "drive"
    counts = write_rosbag(folder, RECORDED)
    assert counts == dict.fromkeys(TYPES, 1)
    found = read(folder)
    assert set(found) == set(TYPES)
    scan = found["/scan"]
    assert list(scan.ranges) == [1.0, float("inf"), 2.0]
    assert (scan.angle_min, scan.angle_max, scan.range_max) == (-1.0, 1.0, 12.0)
    assert found["/tf"].transforms[0].transform.translation.x == 1.0
    assert found["/odom"].twist.twist.linear.x == 0.4
    assert found["/odom"].pose.pose.position.y == 2.0
    assert len(found["/plan"].poses) == 2
    assert found["/plan"].poses[1].pose.orientation.z == 0.6
    assert found["/pose"].header.stamp.nanosec == STAMP["nsec"]
    assert found["/cmd_vel"].twist.angular.z == 0.1
    assert (found["/rosout"].level, found["/rosout"].msg) == (30, "row_up X")
    assert [each.name for each in found["/diagnostics"].status] == ["bridge", "bridge: POSE_LOST"]


@pytest.mark.parametrize("kind", sorted(set(TYPES.values())))
def test_our_definitions_are_ros_2s_own(kind: str) -> None:
    """The oracle is the store of Jazzy: the same fields in the same order, all the way down."""
    ours = get_types_from_msg(definition(kind), ros_name(kind))
    theirs = get_typestore(Stores.ROS2_JAZZY).fielddefs
    assert ours
    for name, told in ours.items():
        assert told[1] == theirs[name][1], name


@pytest.mark.parametrize("kind", sorted(DEFINITIONS))
def test_a_message_of_nothing_is_one_of_zeros(kind: str) -> None:
    store = get_typestore(Stores.EMPTY)
    store.register(get_types_from_msg(definition(kind), ros_name(kind)))
    assert store.deserialize_cdr(encode(kind, {}), ros_name(kind)) is not None


def test_an_export_never_replaces_a_folder(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "bag").mkdir()
    assert record.export([tmp_path / "x.mcap"], tmp_path / "bag", as_json=False) == 2
    assert "bag_exists" in capsys.readouterr().err


def test_a_file_that_is_no_recording_leaves_no_half_bag(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "x.mcap").write_bytes(b"no recording" * 100)
    assert record.export([tmp_path / "x.mcap"], None, as_json=False) == 2
    assert not (tmp_path / "x.bag").exists()
    assert capsys.readouterr().err
