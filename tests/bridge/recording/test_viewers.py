"""Independent readers open a recording: foxglove's mcap, and Google's protobuf for the scan.

What they read is compared with what the simulated robot really sent.
"""

from __future__ import annotations

import json
import struct
from collections import Counter
from math import asin, inf
from pathlib import Path
from typing import Any

import pytest
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from mcap.exceptions import McapError
from mcap.reader import make_reader
from mcap.records import Channel, McapRecord, Message, Schema
from mcap.stream_reader import StreamReader

from bridge.core import initial
from bridge.core import step as plain
from tests.bridge.recorded import UNIX_S, Taken, stream_of, written
from tools.lockstep import LockstepWorld
from wire import Pose2, Scan, compose, wrap

FOXGLOVE = {
    "/scan": ("foxglove.LaserScan", "protobuf"),
    "/tf": ("foxglove.FrameTransform", "json"),
    "/pose": ("foxglove.PoseInFrame", "json"),
    "/plan": ("foxglove.PosesInFrame", "json"),
    "/log": ("foxglove.Log", "json"),
}
OURS = {"boot", "state", "inbox", "command", "decision", "status", "odometry", "event"}


@pytest.fixture(scope="module")
def drive() -> tuple[LockstepWorld, list[Taken]]:
    """Drive a little on the two-room site, in lockstep, and keep what a recorder would be given."""
    ticks: list[Taken] = []

    def kept(config: Any, state: Any, inbox: Any, now_s: float) -> Any:
        decision = plain(config, state, inbox, now_s)
        ticks.append((state, inbox, now_s, decision))
        return decision

    world = LockstepWorld(step=kept)
    world.say("go to the kitchen")
    world.run(6.5)
    return world, ticks


@pytest.fixture(scope="module")
def recording(
    drive: tuple[LockstepWorld, list[Taken]], tmp_path_factory: pytest.TempPathFactory
) -> Path:
    world, ticks = drive
    folder = tmp_path_factory.mktemp("box")
    (path,) = written(folder, stream_of(world.bridge.config, ticks, segments_at=[600]))
    return path


Read = list[tuple[Schema | None, Channel, Message]]


def read(path: Path) -> Read:
    with path.open("rb") as file:
        return list(make_reader(file).iter_messages())


@pytest.fixture(scope="module")
def messages(recording: Path) -> Read:
    return read(recording)


def said(messages: Read, topic: str) -> list[tuple[int, dict[str, Any]]]:
    return [(m.log_time, json.loads(m.data)) for _, c, m in messages if c.topic == topic]


def test_channels_and_schemas_are_listed(recording: Path, messages: Read) -> None:
    with recording.open("rb") as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    assert summary.statistics is not None
    schemas = {c.topic: summary.schemas[c.schema_id] for c in summary.channels.values()}
    encodings = {c.topic: c.message_encoding for c in summary.channels.values()}
    assert set(schemas) == set(FOXGLOVE) | {f"/pons/{name}" for name in OURS}
    for topic, (name, encoding) in FOXGLOVE.items():
        assert (schemas[topic].name, encodings[topic]) == (name, encoding)
    for topic in set(schemas) - {"/scan"}:
        assert schemas[topic].encoding == "jsonschema"
        assert json.loads(schemas[topic].data)["type"] == "object"
    assert summary.statistics.message_count == len(messages)
    assert summary.chunk_indexes


def test_times_never_run_backwards_and_are_utc(
    messages: Read, drive: tuple[LockstepWorld, Any]
) -> None:
    times = [m.log_time for _, _, m in messages]
    assert times == sorted(times)
    first_s = drive[1][0][2]
    assert times[0] / 1e9 == pytest.approx(UNIX_S + first_s, abs=0.02)
    assert {m.publish_time == m.log_time for _, _, m in messages} == {True}


def test_every_tick_is_there_with_what_it_said(
    messages: Read, drive: tuple[LockstepWorld, list[Taken]]
) -> None:
    count = Counter(channel.topic for _, channel, _ in messages)
    ticks = drive[1]
    decisions = [decision for *_, decision in ticks]
    assert count["/pons/inbox"] == count["/pons/decision"] == len(ticks)
    assert count["/pons/command"] == sum(d.command is not None for d in decisions)
    assert count["/pons/status"] == sum(d.status is not None for d in decisions)
    assert count["/pons/odometry"] == sum(d.odometry is not None for d in decisions)
    assert count["/log"] == count["/pons/event"] == sum(len(d.events) for d in decisions)
    assert count["/pons/boot"] == count["/pons/state"] == 2


def scan_class(schema: bytes) -> Any:
    files = descriptor_pb2.FileDescriptorSet()
    files.ParseFromString(schema)
    pool = descriptor_pool.DescriptorPool()
    for each in files.file:
        pool.Add(each)
    return message_factory.GetMessageClass(pool.FindMessageTypeByName("foxglove.LaserScan"))


def test_scans_are_the_robots_own_to_the_bit(
    messages: Read, drive: tuple[LockstepWorld, list[Taken]]
) -> None:
    scans = [(s, m) for s, c, m in messages if c.topic == "/scan"]
    sent = [inbox.scan for _, inbox, *_ in drive[1] if inbox.scan is not None]
    assert len(scans) == len(sent) > 50
    schema = scans[0][0]
    assert schema is not None
    assert schema.encoding == "protobuf"
    kind = scan_class(schema.data)
    for (_, message), scan in zip(scans, sent, strict=True):
        assert isinstance(scan, Scan)
        got = kind()
        got.ParseFromString(message.data)
        assert list(got.ranges) == [inf if r is None else r for r in scan.ranges_m]
        assert (got.frame_id, got.start_angle) == ("base", scan.angle_min_rad)
        last_rad = scan.angle_min_rad + (len(scan.ranges_m) - 1) * scan.angle_increment_rad
        assert got.end_angle == pytest.approx(last_rad)
        taken_s = got.timestamp.seconds + got.timestamp.nanos / 1e9 - UNIX_S
        assert taken_s == pytest.approx(scan.stamp_s, abs=1e-3)


def test_frames_put_the_robot_where_status_says_it_is(messages: Read) -> None:
    frames: dict[str, dict[str, Any]] = {}
    compared = 0
    for _, channel, message in messages:
        if channel.topic == "/tf":
            frame = json.loads(message.data)
            frames[frame["child_frame_id"]] = frame
        elif channel.topic == "/pose" and {"odom", "base"} <= set(frames):
            pose = json.loads(message.data)
            assert pose["frame_id"] == frames["odom"]["parent_frame_id"] == "map"
            here = compose(plane(frames["odom"]), plane(frames["base"]))
            told = pose["pose"]["position"]
            assert here.x_m == pytest.approx(told["x"], abs=0.03)
            assert here.y_m == pytest.approx(told["y"], abs=0.03)
            compared += 1
    assert compared > 100


def plane(frame: dict[str, Any]) -> Pose2:
    turn = frame["rotation"]
    yaw_rad = wrap(2 * asin(turn["z"]) * (1 if turn["w"] >= 0 else -1))
    return Pose2(frame["translation"]["x"], frame["translation"]["y"], yaw_rad)


def test_the_plan_and_the_log_can_be_read(
    messages: Read, drive: tuple[LockstepWorld, list[Taken]]
) -> None:
    plans = said(messages, "/plan")
    horizons = [i.waypoints[-1] for _, i, *_ in drive[1] if i.waypoints]
    assert len(plans) == len(horizons) > 10
    for (_, plan), horizon in zip(plans, horizons, strict=True):
        spots = [(p["position"]["x"], p["position"]["y"]) for p in plan["poses"]]
        assert spots == [(p.x_m, p.y_m) for p in horizon.points]
    lines = [line["message"] for _, line in said(messages, "/log")]
    assert any(line.startswith("mode HOLD ACTIVE") for line in lines)


def test_another_reader_streams_a_file_that_nobody_closed(
    drive: tuple[LockstepWorld, list[Taken]], tmp_path: Path
) -> None:
    world, ticks = drive
    stream = stream_of(world.bridge.config, ticks[:300])
    (path,) = written(tmp_path, stream, closed=False)
    got: list[McapRecord] = []
    with path.open("rb") as file:
        records = StreamReader(file, validate_crcs=True).records
        with pytest.raises((McapError, struct.error)):
            got.extend(iter(lambda: next(records), None))
    assert sum(isinstance(record, Message) for record in got) > 300 * 3


def test_the_state_that_begins_a_recording_is_the_robots(
    messages: Read, drive: tuple[LockstepWorld, list[Taken]]
) -> None:
    world, ticks = drive
    (_, first), _ = said(messages, "/pons/state")
    assert first["state"]["tick"] == ticks[0][0].tick
    assert ticks[0][0] == initial(world.bridge.config, ticks[0][0].now_s)
