"""``pons why`` and ``pons replay`` say in one screen, in both languages, what a recording shows."""

from __future__ import annotations

import fcntl
import gzip
import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest

from bridge.stop_report import StopReport
from pons import replay, why
from pons.__main__ import main
from pons.settings import load
from tests.bridge.core.fake_planner import FakeDrive
from tests.bridge.core.scripted import World
from tests.bridge.recorded import stream_of, written
from tests.bridge.test_replay import taken
from wire import Mode

SCREEN_LINES = 24
SHUT = StopReport(
    path=Path("x.mcap"),
    at_unix_s=1_700_000_000.0,
    ago_s=1.0,
    whole=True,
    growing=False,
    before=Mode.ACTIVE,
    after=Mode.STOPPING,
    cause="obstacle",
    ordered_by=None,
    rows=(),
    speed_mps=0.0,
    stood_s=0.2,
    way_m=0.0,
    ended=Mode.HOLD,
    held=None,
    fault=None,
    events=(),
)
"""A stop before a gate that shut the way."""


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Hold a file as its writer does."""
    with path.open("rb") as file:
        fcntl.flock(file, fcntl.LOCK_SH)
        yield


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("PONS_HOME", str(tmp_path))
    (tmp_path / "recordings").mkdir()
    return tmp_path


def recorded(home: Path, world: World, *, closed: bool = True) -> list[Path]:
    return written(home / "recordings", stream_of(world.core, taken(world)), closed=closed)


def test_a_row_is_told_with_evidence_and_what_to_do(
    home: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    world = World(keep=True).driving((5.0, 0.0))
    world.lidar_silent = True
    world.run(7.0)
    (path,) = recorded(home, world, closed=False)
    assert why.run(load()) == why.EXIT_TOLD
    said = capsys.readouterr().out
    assert len(said.splitlines()) <= SCREEN_LINES
    assert "by lidar_stale" in said
    assert "evidence  LIDAR_STALE.0 (HOLD2): " in said
    assert "to do     pons arm, then pons resume" in said
    assert "power failed" in said
    with locked(path):
        assert why.run(load()) == why.EXIT_TOLD
    said = capsys.readouterr().out
    assert "it is still being written" in said
    assert "power failed" not in said
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    assert why.run(load()) == why.EXIT_TOLD
    said = capsys.readouterr().out
    assert "激光雷达没有新数据" in said
    assert "运行 pons arm，然后 pons resume" in said
    assert "断电" in said


def test_a_stop_is_told_as_json_with_its_sentences_in_both_languages(
    home: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    world = World(keep=True).driving((5.0, 0.0))
    world.stop()
    world.run(2.0)
    recorded(home, world)
    assert main(["why", "--json"]) == why.EXIT_TOLD
    told = json.loads(capsys.readouterr().out)
    assert (told["cause"], told["held"]["reason"], told["ended"]) == ("stop", "stop", "HOLD")
    assert set(told["why"]) == set(told["to_do"]) == {"en", "zh"}


def test_a_self_test_and_a_stop_that_fault_are_told_in_sentences(
    home: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    unproven = World(keep=True, drive=FakeDrive(never_times_out=True))
    unproven.until(Mode.FAULT, 5.0)
    recorded(home, unproven)
    assert why.run(load()) == why.EXIT_TOLD
    said = capsys.readouterr().out
    assert "SELFTEST -> FAULT, by drive_no_timeout" in said
    assert "the drive's own time-out" in said.lower()
    assert "fault     " not in said, "it is what stopped it: told once"

    pushed = World(keep=True).driving((5.0, 0.0))
    pushed.drive.runs_on = True
    pushed.stop()
    pushed.run(2.0)
    recorded(home, pushed)
    assert why.run(load()) == why.EXIT_TOLD
    said = capsys.readouterr().out
    assert "Somebody said stop." in said
    assert "fault     The robot braked more slowly than planned" in said


@pytest.mark.parametrize(
    ("gate", "en", "zh"),
    [
        ("obstacle", "Something stands in the way", "前方有障碍物"),
        ("fence", "too near the fence", "离围栏太近"),
        ("contact", "bumper", "防撞条"),
    ],
)
def test_each_gate_is_told_by_its_own_name_with_what_to_do(
    gate: str, en: str, zh: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    said = dict(why._lines(replace(SHUT, cause=gate)))
    assert en in said["why"]
    assert "nothing" not in said["to do"], "a fence does not go away by itself"
    assert "as said above" in said["to do"]
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    assert zh in dict(why._lines(replace(SHUT, cause=gate)))["why"]


def test_no_stop_and_no_recording_are_told_apart(
    home: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert why.run(load()) == why.EXIT_NO_STOP
    assert "no_stop" in capsys.readouterr().out
    (home / "recordings" / "x.mcap").write_bytes(b"nothing of the kind")
    assert why.run(load()) == why.EXIT_BAD
    assert "recording_not_mcap" in capsys.readouterr().err


def test_replay_takes_several_files_and_counts(
    home: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    world = World(keep=True).armed()
    (path,) = recorded(home, world)
    assert main(["replay", str(path)]) == replay.EXIT_SAME
    assert f"{len(world.inboxes)} ticks replayed, 0 differing, 0 gaps" in capsys.readouterr().out


def test_a_recording_of_before_is_refused_with_what_to_do(
    home: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    old = home / "recordings" / "b-000.jsonl.gz"
    old.write_bytes(gzip.compress(b'{"kind":"header"}\n'))
    assert main(["replay", str(old)]) == replay.EXIT_BAD
    said = capsys.readouterr().err
    assert "recording_of_old_format" in said
    assert "the version of Pons that recorded it" in said
