"""A recorded drive runs again through the core to the same commands, to the last bit."""

from __future__ import annotations

import gzip
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from bridge.core import initial
from bridge.recorder import BadRecording
from bridge.recorder.format import TickFrame, segment_lines, tick_line
from bridge.replay import replay
from tests.bridge.core.scripted import World
from wire import Mode

Lines = list[bytes]


def recorded(world: World, segment_at: int | None = None, missing: range = range(0)) -> Lines:
    """Write down a world's ticks as the recorder does; a gap is followed by a new segment."""
    before = initial(world.core, 100.0)
    lines = [segment_lines(world.core, 0, before)]
    for number, ((inbox, now_s), decision) in enumerate(
        zip(world.inboxes, world.decisions, strict=True)
    ):
        if number == segment_at or (missing and number == missing.stop):
            lines.append(segment_lines(world.core, len(missing), before))
        if number not in missing:
            frame = TickFrame(
                tick=before.tick,
                now_s=now_s,
                inbox=inbox,
                command=decision.command,
                mode=decision.state.mode,
                reasons=decision.reasons,
            )
            lines.append(tick_line(frame))
        before = decision.state
    return b"".join(lines).splitlines(keepends=True)


@pytest.fixture(scope="module")
def drive() -> World:
    """Drive, meet an obstacle, be stopped, be steered by hand, and be stopped for good."""
    world = World(keep=True).driving((3.0, 0.0))
    world.obstacle_m = (2.2, 0.1, 0.2)
    world.run(2.0)
    world.stop()
    world.run(1.0)
    world.op("resume")
    world.run(0.5)
    for held, v in [(False, 0.0)] * 5 + [(True, 0.0)] * 5 + [(True, -0.2)] * 20:
        world.teleop(v, 0.3 * v, held=held)
        for _ in range(5):
            world.tick()
    world.op("estop")
    world.run(1.0)
    assert world.mode is Mode.ESTOPPED
    return world


@pytest.fixture
def write(tmp_path: Path) -> Callable[[Lines], Path]:
    def put(lines: Lines) -> Path:
        path = tmp_path / "r.jsonl.gz"
        path.write_bytes(gzip.compress(b"".join(lines)))
        return path

    return put


def changed(lines: Lines, which: Callable[[dict[str, Any]], bool], how: str, value: Any) -> int:
    """Change one field (a/b/c) of the first frame that fits; return its tick."""
    for number, line in enumerate(lines):
        frame = json.loads(line)
        if which(frame):
            *path, last = how.split("/")
            inner = frame
            for name in path:
                inner = inner[name]
            inner[last] = value(inner[last]) if callable(value) else value
            lines[number] = json.dumps(frame).encode() + b"\n"
            return int(frame.get("tick", -1))
    raise AssertionError("no frame fits")


def moving(frame: dict[str, Any]) -> bool:
    return frame["kind"] == "tick" and frame["mode"] == "ACTIVE" and bool(frame["command"])


def test_a_drive_replays_to_the_last_bit(drive: World, write: Callable[[Lines], Path]) -> None:
    modes = {decision.state.mode for decision in drive.decisions}
    assert {Mode.SELFTEST, Mode.ACTIVE, Mode.STOPPING, Mode.TELEOP, Mode.ESTOPPED} <= modes
    report = replay(write(recorded(drive)))
    assert report.first_difference is None
    assert (report.ticks, report.differing, report.gaps) == (len(drive.inboxes), 0, 0)


def test_every_state_on_the_way_can_be_gone_on_from(
    drive: World, write: Callable[[Lines], Path]
) -> None:
    for at in range(50, len(drive.inboxes), 331):
        report = replay(write(recorded(drive, segment_at=at)))
        assert (report.first_difference, report.differing) == (None, 0)


def test_after_a_gap_the_replay_goes_on_from_the_recorded_state(
    drive: World, write: Callable[[Lines], Path]
) -> None:
    report = replay(write(recorded(drive, missing=range(200, 260))))
    assert (report.differing, report.gaps) == (0, 60)
    assert report.ticks == len(drive.inboxes) - 60


def test_one_bit_of_one_command_is_found(drive: World, write: Callable[[Lines], Path]) -> None:
    lines = recorded(drive)
    tick = changed(lines, moving, "command/left_radps", lambda v: v * (1 + 2**-52) + 5e-324)
    report = replay(write(lines))
    assert report.differing == 1
    assert report.first_difference is not None
    assert report.first_difference.startswith(f"tick {tick}: ")


def test_the_sign_of_a_zero_is_found(drive: World, write: Callable[[Lines], Path]) -> None:
    lines = recorded(drive)

    def standing(frame: dict[str, Any]) -> bool:
        return frame["kind"] == "tick" and (frame["command"] or {}).get("left_radps") == 0.0

    changed(lines, standing, "command/left_radps", lambda v: -v)
    assert replay(write(lines)).differing == 1


def test_another_input_gives_another_drive(drive: World, write: Callable[[Lines], Path]) -> None:
    lines = recorded(drive)
    changed(lines, moving, "now_s", lambda v: v + 0.004)
    assert replay(write(lines)).differing > 0


def test_a_state_that_is_not_the_one_reached_is_found(
    drive: World, write: Callable[[Lines], Path]
) -> None:
    lines = recorded(drive, segment_at=300)

    def second(frame: dict[str, Any]) -> bool:
        return bool(frame["kind"] == "state" and frame["state"]["tick"] > 0)

    changed(lines, second, "state/voice/dropped", lambda v: v + 1)
    report = replay(write(lines))
    assert report.differing >= 1
    assert "state reached" in str(report.first_difference)


def of_version_1(line: bytes) -> bytes:
    """Write a frame as version 1 did: a scan's picture held all points, and beams by count."""
    frame = json.loads(line)
    if frame["kind"] == "header":
        frame["version"] = 1
    picture = frame["state"]["lidar"]["picture"] if frame["kind"] == "state" else None
    if picture is not None:
        came = [r is not None for r in picture.pop("ranges_m")]
        for gone in ("range_min_m", "range_max_m", "returns", "sight_m"):
            del picture[gone]
        picture["before"] = [sum(came[:i]) for i in range(len(came) + 1)]
    return json.dumps(frame, separators=(",", ":")).encode() + b"\n"


def test_a_recording_of_version_1_replays_too(drive: World, write: Callable[[Lines], Path]) -> None:
    old = [of_version_1(line) for line in recorded(drive, segment_at=300)]
    assert b'"before"' in b"".join(old)
    report = replay(write(old))
    assert (report.ticks, report.differing) == (len(drive.inboxes), 0)
    later = [of_version_1(line) for line in recorded(drive, missing=range(5, 290))]
    report = replay(write(later))
    assert (report.gaps, report.differing) == (285, 0)


@pytest.mark.parametrize("what", ["newest", "picture"])
def test_a_broken_state_of_version_1_is_refused(
    drive: World, write: Callable[[Lines], Path], what: str
) -> None:
    old = [of_version_1(line) for line in recorded(drive, segment_at=300)]

    def second(frame: dict[str, Any]) -> bool:
        return bool(frame["kind"] == "state" and frame["state"]["tick"] > 0)

    changed(old, second, f"state/lidar/{what}", {} if what == "picture" else None)
    old = [line.replace(b'"kind": "state"', b'"kind":"state"') for line in old]
    with pytest.raises(BadRecording, match="recording_invalid"):
        replay(write(old))


def test_nothing_whole_is_no_recording(write: Callable[[Lines], Path]) -> None:
    with pytest.raises(BadRecording, match="recording_empty"):
        replay(write([b'{"kind":"header"']))


def test_a_tick_without_a_state_is_no_recording(
    drive: World, write: Callable[[Lines], Path]
) -> None:
    lines = [line for line in recorded(drive) if b'"kind":"state"' not in line]
    with pytest.raises(BadRecording, match="recording_stateless"):
        replay(write(lines))
