"""Thinned recordings keep what is round an incident, message for message, and replay as before."""

from __future__ import annotations

import os
import subprocess
import sys
from functools import lru_cache
from pathlib import Path

import pytest

from bridge.recording import thinning
from bridge.recording.mcap_reader import McapReader, Raw
from bridge.recording.rotation import Stage, prune, stage_of
from bridge.recording.thinning import Thinner, rewrite, survey
from bridge.replay import replay
from bridge.stop_report import last_stop
from tests.bridge.core.scripted import World
from tests.bridge.recorded import UNIX_S, stream_of, written
from tests.bridge.test_replay import taken

pytestmark = pytest.mark.nightly(keep=3)


ROOT = Path(__file__).resolve().parents[3]
SECOND_NS = 1_000_000_000
MINUTE_TICKS = 500
"""Between two segments here, in place of 6 000: a test is no minute long."""
GIB = 1 << 30


@pytest.fixture(autouse=True)
def short_rounds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(thinning, "ROUND_NS", 4 * SECOND_NS)


@lru_cache
def drive(*, stops: bool = True, stands_s: float = 0.0) -> World:
    """Stand for a while, drive for some seconds, with a stop at their end or without, and stand."""
    world = World(keep=True)
    world.run(stands_s)
    world.driving((5.0, 0.0)).run(3.0)
    if stops:
        world.stop()
        world.run(2.0 + stands_s)
    return world


def record(folder: Path, world: World, *, boot: str = "b1", closed: bool = True) -> Path:
    ticks = taken(world)
    segments = range(0, len(ticks), MINUTE_TICKS)
    stream = stream_of(world.core, ticks, segments_at=segments)
    return written(folder, stream, boot=boot, closed=closed)[-1]


def messages(path: Path) -> list[Raw]:
    with McapReader(path) as box:
        return list(box.messages())


def test_all_round_a_stop_is_kept_to_the_last_bit_and_replays(tmp_path: Path) -> None:
    whole = record(tmp_path, drive(stands_s=15.0))
    before = messages(whole)
    [stop] = [at for segment in survey(whole) for at in segment.incidents]
    told = last_stop(tmp_path)
    kept = rewrite(whole, Stage.KEPT, [])
    assert kept is not None
    assert (stage_of(kept), whole.exists()) == (Stage.KEPT, False)
    after = messages(kept)
    assert set(after) <= set(before)
    near = [raw for raw in before if abs(raw.at_ns - stop) <= thinning.ROUND_NS]
    assert near
    assert set(near) <= set(after)
    assert len(after) < len(before) / 2
    assert replay([kept]).differing == 0
    again = last_stop(tmp_path)
    assert told is not None
    assert again is not None
    assert (again.cause, again.events, again.way_m) == (told.cause, told.events, told.way_m)


def test_of_idle_time_a_second_of_each_minute_is_left_and_a_drive_is_whole(tmp_path: Path) -> None:
    world = World(keep=True)
    world.run(30.0)  # it stands, never armed
    idle = record(tmp_path, world)
    before = len(messages(idle))
    thinned = rewrite(idle, Stage.IDLE_THINNED, [])
    assert thinned is not None
    assert len(messages(thinned)) < before / 2
    report = replay([thinned])
    assert report.differing == 0
    assert report.gaps > 0
    moved = record(tmp_path, drive(stops=False), boot="b2")
    all_of_it = messages(moved)
    again = rewrite(moved, Stage.IDLE_THINNED, [])
    assert again is not None
    assert messages(again) == all_of_it


def test_without_an_incident_nothing_is_kept(tmp_path: Path) -> None:
    quiet = record(tmp_path, drive(stops=False))
    assert rewrite(quiet, Stage.KEPT, []) is None
    assert list(tmp_path.iterdir()) == []


def test_an_incident_just_after_its_end_keeps_the_end_of_the_file_before(tmp_path: Path) -> None:
    path = record(tmp_path, drive(stops=False))
    end_ns = messages(path)[-1].at_ns
    kept = rewrite(path, Stage.KEPT, [end_ns + 2 * SECOND_NS])
    assert kept is not None
    assert messages(kept)[-1].at_ns == end_ns


def test_a_recording_that_a_power_loss_cut_is_thinned_and_read(tmp_path: Path) -> None:
    cut = record(tmp_path, drive(stands_s=8.0), closed=False)
    with cut.open("r+b") as file:
        file.truncate(cut.stat().st_size - 100)
    kept = rewrite(cut, Stage.KEPT, [])
    assert kept is not None
    assert replay([kept]).differing == 0
    assert last_stop(tmp_path) is not None


def test_a_folder_is_thinned_until_there_is_room_and_the_runs_newest_stay(tmp_path: Path) -> None:
    for number in range(4):
        world = drive(stands_s=8.0 if number == 0 else 0.0)
        path = record(tmp_path, world, boot="old" if number < 2 else "now")
        os.utime(path, (UNIX_S + number, UNIX_S + number))
    (tmp_path / "left.mcap.part").touch()
    Thinner(tmp_path, "now", GIB, 1 << 20).run(UNIX_S)
    stages = [stage_of(path) for path in sorted(tmp_path.iterdir(), key=os.path.getmtime)]
    assert stages == [Stage.IDLE_THINNED, Stage.IDLE_THINNED, Stage.WHOLE, Stage.WHOLE]
    size = sum(path.stat().st_size for path in tmp_path.iterdir())
    Thinner(tmp_path, "now", size + 2, 1).run(UNIX_S)
    stages = [stage_of(path) for path in sorted(tmp_path.iterdir(), key=os.path.getmtime)]
    assert stages == [Stage.KEPT, Stage.IDLE_THINNED, Stage.WHOLE, Stage.WHOLE]


def test_incidents_go_after_thirty_days_and_where_they_are_too_many(tmp_path: Path) -> None:
    size = 0
    for number in range(3):
        kept = rewrite(record(tmp_path, drive(), boot=f"b{number}"), Stage.KEPT, [])
        assert kept is not None
        os.utime(kept, (UNIX_S + number, UNIX_S + number))
        size = kept.stat().st_size
    days = 30 * 86_400.0
    Thinner(tmp_path, "now", GIB, 1).run(UNIX_S + days + 0.5)
    assert [path.name.split("-")[1] for path in sorted(tmp_path.iterdir())] == ["b1", "b2"]
    Thinner(tmp_path, "now", 2 * size, 1).run(UNIX_S)
    assert [path.name.split("-")[1] for path in sorted(tmp_path.iterdir())] == ["b2"]


def test_what_can_not_be_read_stays_for_its_age(tmp_path: Path) -> None:
    broken = tmp_path / "t-b1-000.mcap"
    broken.write_bytes(b"no recording")
    Thinner(tmp_path, "now", GIB, 1).run(UNIX_S)
    assert broken.exists()


def test_whole_files_are_pruned_before_what_was_kept_of_incidents(tmp_path: Path) -> None:
    for name, age in (("t-b0-000.kept.mcap", 9), ("t-b1-000.mcap", 5), ("t-b2-000.mcap", 1)):
        (tmp_path / name).write_bytes(bytes(100))
        os.utime(tmp_path / name, (2e9 - age, 2e9 - age))
    prune(tmp_path, "now", cap_bytes=250, room_bytes=50)
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "t-b0-000.kept.mcap",
        "t-b2-000.mcap",
    ]


def test_the_process_thins_a_folder_out(tmp_path: Path) -> None:
    path = record(tmp_path, drive(), boot="old")
    words = [str(tmp_path), "now", str(GIB), str(1 << 20)]
    command = [sys.executable, "-m", "bridge.recording.thinning", *words]
    subprocess.run(command, cwd=ROOT, check=True, timeout=60)
    assert [stage_of(left) for left in tmp_path.iterdir()] == [Stage.IDLE_THINNED]
    assert not path.exists()
