"""The last stop is found in a recording and told with its row, its evidence and what came of it."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from bridge.stop_report import BadRecording, last_stop
from tests.bridge.core.fake_planner import FakeDrive
from tests.bridge.core.scripted import World
from tests.bridge.recorded import stream_of, written
from tests.bridge.test_replay import taken
from wire import HeldReason, Mode, OpKind

if TYPE_CHECKING:
    from pathlib import Path


def kept(
    folder: Path,
    world: World,
    boot: str = "boot1",
    segment_at: int | None = None,
    *,
    closed: bool = True,
) -> Path:
    segments = () if segment_at is None else (segment_at,)
    stream = stream_of(world.core, taken(world), segments_at=segments)
    return written(folder, stream, boot=boot, beat_every=150, closed=closed)[0]


def test_a_silent_planner_is_told_as_the_row_with_its_evidence(tmp_path: Path) -> None:
    world = World(keep=True).driving((5.0, 0.0))
    world.brain.silent = True
    world.run(3.0)
    stop = last_stop(kept(tmp_path, world).parent)
    assert stop is not None
    assert (stop.before, stop.after, stop.cause) == (Mode.ACTIVE, Mode.STOPPING, "brain_lost")
    assert "BRAIN_LOST.0" in [stage.name for stage, _ in stop.rows]
    assert 0.2 < stop.speed_mps < 0.5, "BRAIN_LATE had slowed it before"
    assert stop.stood_s is not None
    assert 0.2 < stop.stood_s < 1.0
    assert 0.02 < stop.way_m < 0.4
    assert (stop.ended, stop.held) == (Mode.HOLD, None)
    assert 1.0 < stop.ago_s < 3.0


def test_who_said_stop_is_named_and_the_newest_of_two_is_told(tmp_path: Path) -> None:
    world = World(keep=True).driving((5.0, 0.0))
    world.lidar_silent = True
    world.run(1.0)
    world.lidar_silent = False
    world.until(Mode.ACTIVE)
    world.run(1.0)
    world.stop("stop-1")
    world.run(1.5)
    stop = last_stop(kept(tmp_path, world, segment_at=150).parent)
    assert stop is not None
    assert (stop.cause, stop.ordered_by, stop.ended) == ("stop", "test", Mode.HOLD)
    assert stop.held is not None
    assert (stop.held.reason, stop.held.id) == (HeldReason.STOP, "stop-1")


@pytest.mark.parametrize(("kind", "by"), [("estop", "test"), ("disarm", "test")])
def test_who_gave_another_order_to_stand_is_named_too(
    tmp_path: Path, kind: OpKind, by: str
) -> None:
    world = World(keep=True).driving((5.0, 0.0))
    world.op(kind)
    world.run(1.5)
    stop = last_stop(kept(tmp_path, world).parent)
    assert stop is not None
    assert (stop.cause, stop.ordered_by) == (kind, by)


def test_a_stop_that_comes_with_another_cause_is_not_its_cause(tmp_path: Path) -> None:
    """A robot that was latched while somebody said stop was not latched by them."""
    world = World(keep=True).driving((5.0, 0.0))
    world.stop("s1")
    world.op("estop")
    world.run(1.5)
    stop = last_stop(kept(tmp_path, world).parent)
    assert stop is not None
    assert (stop.cause, stop.ordered_by) == ("stop", "test")


def test_a_stop_just_before_a_new_segment_is_followed_into_it(tmp_path: Path) -> None:
    world = World(keep=True).driving((5.0, 0.0))
    stop_at = len(world.inboxes)
    world.stop()
    world.run(1.5)
    stop = last_stop(kept(tmp_path, world, segment_at=stop_at + 5).parent)
    assert stop is not None
    assert stop.stood_s is not None
    assert stop.ended is Mode.HOLD


def test_the_newest_recording_with_a_stop_counts(tmp_path: Path) -> None:
    quiet, stopped = World(keep=True).armed(), World(keep=True).driving((5.0, 0.0))
    stopped.op("estop")
    stopped.run(2.0)
    older = kept(tmp_path, stopped, "b1")
    newer = kept(tmp_path, quiet, "b2")
    os.utime(older, (1.0, 1.0))
    assert newer.stat().st_mtime > older.stat().st_mtime
    stop = last_stop(tmp_path)
    assert stop is not None
    assert (stop.path, stop.after, stop.ended) == (older, Mode.ESTOPPED, Mode.ESTOPPED)


def test_a_robot_that_is_disarmed_where_it_stands_is_told_too(tmp_path: Path) -> None:
    world = World(keep=True).armed()
    world.drive_silent = True
    world.run(1.5)
    stop = last_stop(kept(tmp_path, world).parent)
    assert stop is not None
    assert (stop.before, stop.cause, stop.ended) == (Mode.HOLD, "enc_stale", Mode.DISARMED)


def test_without_a_stop_there_is_nothing_to_tell(tmp_path: Path) -> None:
    assert last_stop(tmp_path) is None
    assert last_stop(kept(tmp_path, World(keep=True).armed()).parent) is None


def test_a_stop_at_the_end_of_a_file_is_followed_into_the_next(tmp_path: Path) -> None:
    world = World(keep=True).driving((5.0, 0.0))
    stop_at = len(world.inboxes)
    world.stop()
    world.run(1.5)
    stream = stream_of(world.core, taken(world), segments_at=(stop_at + 5,))
    first, second = written(tmp_path, stream, rotate_bytes=1)
    os.utime(first, (1.0, 1.0))
    stop = last_stop(second.parent)
    assert stop is not None
    assert (stop.path, stop.ended) == (first, Mode.HOLD)
    assert stop.stood_s is not None


def test_a_file_cut_anywhere_after_the_stop_still_tells_it(tmp_path: Path) -> None:
    world = World(keep=True).driving((5.0, 0.0))
    stop_at = len(world.inboxes)
    world.op("estop")
    world.run(3.0)
    path = kept(tmp_path, world, segment_at=stop_at - 50, closed=False)
    data, told = path.read_bytes(), []
    for share in range(60, 101, 4):
        path.write_bytes(data[: len(data) * share // 100])
        stop = last_stop(tmp_path)
        told.append(stop is not None)
        if stop is not None:
            assert (stop.after, stop.whole) == (Mode.ESTOPPED, False)
    assert told == sorted(told), "longer never tells less"
    assert told[-1]


def test_what_is_no_recording_is_refused(tmp_path: Path) -> None:
    (tmp_path / "x.mcap").write_bytes(b"no container at all")
    with pytest.raises(BadRecording, match="recording_not_mcap"):
        last_stop(tmp_path)


def test_a_self_test_that_faults_is_told(tmp_path: Path) -> None:
    world = World(keep=True, drive=FakeDrive(never_times_out=True))
    world.until(Mode.FAULT, 5.0)
    world.run(0.5)
    stop = last_stop(kept(tmp_path, world).parent)
    assert stop is not None
    assert (stop.before, stop.after, stop.ended) == (Mode.SELFTEST, Mode.FAULT, Mode.FAULT)
    assert (stop.cause, stop.fault) == ("drive_no_timeout", "drive_no_timeout")


def test_a_stop_that_fails_is_told_with_its_order_and_its_fault(tmp_path: Path) -> None:
    world = World(keep=True).driving((5.0, 0.0))
    world.drive.runs_on = True
    world.stop()
    world.run(2.0)
    stop = last_stop(kept(tmp_path, world).parent)
    assert stop is not None
    assert (stop.cause, stop.ended) == ("stop", Mode.FAULT)
    assert stop.fault in {"stop_too_slow", "stop_too_long", "runaway"}
