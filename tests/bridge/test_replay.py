"""A recording run again gives every command to the last bit; what differs is found."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from bridge.core import initial
from bridge.recording import pipe_frames
from bridge.recording.mcap_file import McapFile
from bridge.recording.topics import topics
from bridge.replay import BadRecording, replay
from tests.bridge.core.scripted import World
from tests.bridge.recorded import SCHEMAS, Taken, stream_of, written
from wire import Mode

pytestmark = pytest.mark.nightly(keep=5)


def taken(world: World) -> list[Taken]:
    """Return what a recorder would have been given."""
    before = initial(world.core, 100.0)
    ticks = []
    for (inbox, now_s), decision in zip(world.inboxes, world.decisions, strict=True):
        ticks.append((before, inbox, now_s, decision))
        before = decision.state
    return ticks


SOME = 420
"""Ticks in which it tests itself, is armed, owned and granted, and drives: enough to differ."""
ALL = 1_000_000


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


@pytest.fixture(scope="module")
def ticks(drive: World) -> list[Taken]:
    return taken(drive)


@pytest.fixture
def write(drive: World, ticks: list[Taken], tmp_path: Path) -> Callable[..., list[Path]]:
    def put(
        change: Callable[[bytes], bytes] | None = None, count: int = SOME, **how: Any
    ) -> list[Path]:
        rotate = {"rotate_bytes": how.pop("rotate_bytes")} if "rotate_bytes" in how else {}
        stream = stream_of(drive.core, ticks[:count], **how)
        return written(tmp_path, change(stream) if change else stream, **rotate)

    return put


def edited(
    stream: bytes, kind: bytes, which: Callable[[dict[str, Any]], bool], how: str, value: Any
) -> bytes:
    """Change one field (a/b/c) of the first frame of that kind that fits."""
    out, done = [], False
    for each, payload in pipe_frames.Splitter().feed(stream):
        data = payload
        if each == kind and not done and which(said := json.loads(payload)):
            *path, last = how.split("/")
            inner = said
            for name in path:
                inner = inner[name]
            inner[last] = value(inner[last])
            data, done = json.dumps(said).encode(), True
        out.append(pipe_frames.frame(each, data))
    assert done, "no frame fits"
    return b"".join(out)


def moving(command: dict[str, Any]) -> bool:
    return bool(command["enable"]) and command["left_radps"] > 1.0


def test_a_drive_replays_to_the_last_bit(
    drive: World, write: Callable[..., list[Path]]
) -> None:  # fmt: skip
    modes = {decision.state.mode for decision in drive.decisions}
    assert {Mode.SELFTEST, Mode.ACTIVE, Mode.STOPPING, Mode.TELEOP, Mode.ESTOPPED} <= modes
    report = replay(write(count=ALL))
    assert report.first_difference is None
    assert (report.ticks, report.differing, report.gaps) == (len(drive.inboxes), 0, 0)
    assert report.other_core is None


def test_every_file_of_a_rotated_run_replays_alone_and_all_together(
    drive: World, write: Callable[..., list[Path]]
) -> None:
    files = write(count=ALL, segments_at=range(0, len(drive.inboxes), 173), rotate_bytes=1)
    assert len(files) > 5
    alone = [replay([path]) for path in files]
    assert sum(report.ticks for report in alone) == len(drive.inboxes)
    assert {report.differing for report in alone} == {0}
    together = replay(files)
    assert (together.ticks, together.differing, together.gaps) == (len(drive.inboxes), 0, 0)


def test_after_a_gap_the_replay_goes_on_from_the_recorded_state(
    write: Callable[..., list[Path]],
) -> None:
    report = replay(write(missing=range(200, 260)))
    assert (report.differing, report.gaps) == (0, 60)
    assert report.ticks == SOME - 60


def test_one_bit_of_one_command_is_found(write: Callable[..., list[Path]]) -> None:
    def bent(stream: bytes) -> bytes:
        return edited(stream, pipe_frames.COMMAND, moving, "left_radps", lambda v: v * (1 + 2**-52))

    report = replay(write(bent))
    assert report.differing == 1
    assert "left_radps" in str(report.first_difference)


def test_the_sign_of_a_zero_is_found(write: Callable[..., list[Path]]) -> None:
    def standing(command: dict[str, Any]) -> bool:
        return bool(command["left_radps"] == 0.0)

    report = replay(
        write(lambda s: edited(s, pipe_frames.COMMAND, standing, "left_radps", lambda v: -v))
    )
    assert report.differing == 1


def test_another_input_gives_another_drive(write: Callable[..., list[Path]]) -> None:
    def late(given: dict[str, Any]) -> bool:
        return bool(given["tick"] == 400)

    report = replay(
        write(lambda s: edited(s, pipe_frames.INBOX, late, "now_s", lambda v: v + 0.004))
    )
    assert report.differing > 0


def test_a_state_that_is_not_the_one_reached_is_found(write: Callable[..., list[Path]]) -> None:
    def second(frame: dict[str, Any]) -> bool:
        return bool(frame["state"]["tick"] > 0)

    report = replay(
        write(
            lambda s: edited(s, pipe_frames.STATE, second, "state/voice/dropped", lambda v: v + 1),
            segments_at=[300],
        )
    )
    assert report.differing >= 1
    assert "state reached" in str(report.first_difference)


def test_another_core_is_said_where_this_one_can_still_run_it(
    write: Callable[..., list[Path]],
) -> None:
    report = replay(
        write(
            lambda s: edited(
                s, pipe_frames.BOOT, lambda _: True, "core", lambda _: "0123456789abcdef"
            )
        )
    )
    assert (report.differing, report.other_core) == (0, "0123456789abcdef")


def test_another_core_is_named_where_this_one_cannot_run_it(
    write: Callable[..., list[Path]],
) -> None:
    def foreign(stream: bytes) -> bytes:
        stream = edited(
            stream, pipe_frames.BOOT, lambda _: True, "core", lambda _: "0123456789abcdef"
        )
        return edited(
            stream, pipe_frames.STATE, lambda _: True, "state", lambda s: {**s, "legs": 4}
        )  # fmt: skip

    with pytest.raises(BadRecording, match=r"recording_of_other_core: .*legs.*0123456789abcdef"):
        replay(write(foreign))


def test_a_tick_without_a_state_is_no_recording(write: Callable[..., list[Path]]) -> None:
    def headless(stream: bytes) -> bytes:
        parts = pipe_frames.Splitter().feed(stream)
        return b"".join(pipe_frames.frame(k, p) for k, p in parts if k != pipe_frames.STATE)

    with pytest.raises(BadRecording, match="recording_stateless"):
        replay(write(headless))


def test_a_missing_tick_without_a_state_after_it_is_no_recording(
    write: Callable[..., list[Path]],
) -> None:
    def holed(stream: bytes) -> bytes:
        out, number = [], 0
        for kind, payload in pipe_frames.Splitter().feed(stream):
            if kind == pipe_frames.TICK:
                number, _ = pipe_frames.TICK_OF.unpack(payload)
            if number != 250:
                out.append(pipe_frames.frame(kind, payload))
        return b"".join(out)

    with pytest.raises(BadRecording, match=r"recording_stateless: tick 251 follows tick 249"):
        replay(write(holed))


def test_a_file_without_one_record_is_no_recording(tmp_path: Path) -> None:
    box = McapFile(tmp_path / "empty.mcap", topics(SCHEMAS))
    box.close()
    with pytest.raises(BadRecording, match="recording_empty"):
        replay([box.path])
