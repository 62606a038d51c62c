"""A robot is found by the note of its ``pons up``, and no note of another's making hides it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from pons import running
from pons.running import NOTE, RunningNote, find_robots, of_this_user, robots_to_halt
from pons.settings import CHECKOUT, LaunchSettings, asker
from pons.stop import CONFIRMED
from tests.pons.lying_planner import lying_planner
from tests.pons.standing_bridge import StandingBridge

pytestmark = pytest.mark.nightly(keep=7)


ROOT = Path(__file__).resolve().parents[2]
STRANGER = 61_001
ROOT_ONLY = pytest.mark.skipif(os.geteuid() != 0, reason="only root may become another user")
HALTS = ("stop", "estop", "disarm")


@pytest.fixture
def notes(monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Give a folder for notes as /tmp is: everybody's, and sticky."""
    with TemporaryDirectory(prefix="pr-") as folder:
        Path(folder).chmod(0o1777)
        monkeypatch.setenv(running.NOTES, folder)
        yield Path(folder)


def robot(home: Path, port: int = 1) -> LaunchSettings:
    return LaunchSettings(home, CHECKOUT / "robot.toml", CHECKOUT / "sites", "127.0.0.1", port)


def test_a_note_says_where_a_robot_is_for_as_long_as_its_writer_lives(
    notes: Path, tmp_path: Path
) -> None:
    made = robot(tmp_path / "here", 8460)
    assert find_robots() == []
    with RunningNote(made, "r7") as note:
        assert find_robots() == [replace(made, owner_uid=os.geteuid(), robot_id="r7")]
        (next(notes.iterdir()) / NOTE).unlink()  # a cleaner of /tmp
        assert find_robots() == []
        note.keep()
        assert [one.port for one in find_robots()] == [8460]
        (folder,) = notes.iterdir()
        assert (folder.stat().st_mode & 0o777, (folder / NOTE).stat().st_mode & 0o777) == (
            0o755,
            0o644,
        )
    assert list(notes.iterdir()) == []


def test_what_a_killed_robot_left_is_no_robot_and_is_cleaned_up(
    notes: Path, tmp_path: Path
) -> None:
    left = notes / f"pons-run-{os.geteuid()}.dead"
    left.mkdir(mode=0o755)
    said = {"home": "/x", "robot": "/r", "site": "/s", "host": "h", "port": 1, "tls": False}
    (left / NOTE).write_text(json.dumps({**said, "robot_id": "r1"}))
    assert find_robots() == []
    with RunningNote(robot(tmp_path), "r7"):
        assert [one.robot_id for one in find_robots()] == ["r7"]
        assert not left.exists()


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{}", '{"home": 1}', "\x00" * 10, "[" * 9_000,
     '{"home":"r","robot":"/r","site":"/s","host":"h","port":1,"tls":false,"robot_id":"r"}',
     '{"home":"/r","robot":"/r","site":"/s","host":"h","port":0,"tls":false,"robot_id":"r"}'],
)  # fmt: skip
def test_a_note_that_is_none_hides_no_other(notes: Path, tmp_path: Path, text: str) -> None:
    with ExitStack() as stack:
        stack.enter_context(RunningNote(robot(tmp_path / "bad"), "bad"))
        (folder,) = notes.iterdir()
        (folder / NOTE).write_text(text)  # locked by its writer still
        stack.enter_context(RunningNote(robot(tmp_path / "good"), "good"))
        assert [one.robot_id for one in find_robots()] == ["good"]


@ROOT_ONLY
def test_a_note_in_anothers_name_is_not_believed(notes: Path, tmp_path: Path) -> None:
    with RunningNote(robot(tmp_path), "r7"):
        (folder,) = notes.iterdir()
        for path, owner, mode in (
            (folder, STRANGER, 0o755), (folder, 0, 0o777), (folder / NOTE, STRANGER, 0o644),
        ):  # fmt: skip
            os.chown(path, owner, owner)
            path.chmod(mode)
            assert find_robots() == []
            os.chown(path, 0, 0)
            path.chmod(0o755)
        assert len(find_robots()) == 1
        (folder / NOTE).rename(folder / "moved")
        (folder / NOTE).symlink_to(folder / "moved")
        assert find_robots() == []


def test_an_order_to_stand_means_every_robot_where_none_is_named(
    notes: Path, tmp_path: Path
) -> None:
    here, there = robot(tmp_path / "here"), robot(tmp_path / "there", 2)
    assert robots_to_halt(here) == [here]
    with RunningNote(there, "r7"):
        assert [one.home for one in robots_to_halt(there)] == [there.home]
        assert [one.home for one in robots_to_halt(here)] == [there.home, here.home]
        assert of_this_user(here).home == there.home
        assert of_this_user(here).port == 2
        with RunningNote(here, "r8"):
            assert {one.home for one in robots_to_halt(here)} == {here.home, there.home}
            other = robot(tmp_path / "other")
            assert of_this_user(other) == other, "one of two is nobody's guess"


def pons(folder: Path, notes: Path, *words: str, user: int = 0) -> subprocess.CompletedProcess[str]:
    """Type a command in a folder, with nothing that names a robot."""
    environment = {name: text for name, text in os.environ.items() if not name.startswith("PONS_")}
    environment |= {running.NOTES: str(notes), "PYTHONPATH": str(ROOT)}
    other = ["tests.as_user", str(user), str(user)] if user else []
    return subprocess.run(
        [sys.executable, "-m", *other, "pons.__main__" if user else "pons", *words],
        cwd=folder, env=environment, capture_output=True, text=True, check=False, timeout=30,
    )  # fmt: skip


@pytest.fixture
def place() -> Iterator[Path]:
    """Give a folder of a short name: a socket's path ends at 107 bytes."""
    with TemporaryDirectory(prefix="ps-") as folder:
        yield Path(folder)


@pytest.mark.parametrize("word", HALTS)
def test_the_robot_stands_from_any_folder(notes: Path, place: Path, word: str) -> None:
    elsewhere = place / "elsewhere"
    elsewhere.mkdir()
    with StandingBridge(place / "h", "r7") as bridge, RunningNote(robot(place / "h"), "r7"):
        done = pons(elsewhere, notes, word)
        assert done.returncode == 0, done.stderr
        assert bridge.asked == ["cmd/stop" if word == "stop" else f"op/{word}"]
        assert bridge.sources == {asker()}
    assert not (elsewhere / ".pons").exists()


def test_of_several_robots_each_is_told_and_named(notes: Path, place: Path) -> None:
    with ExitStack() as stack:
        bridges = []
        for name in ("a", "b"):
            bridges.append(stack.enter_context(StandingBridge(place / name, name)))
            stack.enter_context(RunningNote(robot(place / name), name))
        stack.enter_context(RunningNote(robot(place / "gone"), "gone"))
        done = pons(place, notes, "stop")
    assert [len(bridge.asked) for bridge in bridges] == [1, 1]
    user = f", user {os.geteuid()}"
    assert done.stdout.splitlines() == [
        f"{name} in {place}/{name}{user}: {CONFIRMED[0]}" for name in "ab"
    ]
    assert done.stderr.startswith(f"gone in {place}/gone{user}: no_bridge: ")
    assert done.returncode == 6, "one of three was not confirmed"


@ROOT_ONLY
@pytest.mark.parametrize("word", HALTS)
def test_another_user_is_heard_by_the_planner(notes: Path, place: Path, word: str) -> None:
    """The home is closed to all but its owner, as ``pons up`` makes it."""
    (place / "h").mkdir(mode=0o700)
    with (
        StandingBridge(place / "h", "r7"),
        lying_planner() as port,
        RunningNote(robot(place / "h", port), "r7"),
    ):
        done = pons(Path("/"), notes, word, user=STRANGER)
    assert done.returncode == 0, done.stderr
    assert f"r7 in {place}/h, user 0: the planner says that the bridge took" in done.stdout
    assert "Permission denied" in done.stdout


def test_a_name_in_the_environment_means_that_robot_alone(notes: Path, place: Path) -> None:
    with StandingBridge(place / "h", "r7") as bridge, RunningNote(robot(place / "h"), "r7"):
        done = subprocess.run(
            [sys.executable, "-m", "pons", "stop"],
            cwd=ROOT, env={**os.environ, "PONS_HOME": str(place / "other"), "PONS_PORT": "1"},
            capture_output=True, text=True, check=False, timeout=30,
        )  # fmt: skip
        assert (done.returncode, bridge.asked) == (6, [])
