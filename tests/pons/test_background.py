"""What runs in the background is started and ended, and its logs shown, with a status a case."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest

from pons.background import end, open_page, show_logs, start
from pons.settings import LaunchSettings
from tests.known import known

HOLDER = """
import fcntl, os, sys, time
file = open(sys.argv[1], "w")
fcntl.flock(file, fcntl.LOCK_EX)
file.write(str(os.getpid())), file.flush(), print("held", flush=True)
time.sleep(60)
"""


@contextmanager
def holding(home: Path) -> Iterator[subprocess.Popen[str]]:
    """Hold a home's lock from another process, as `pons up` does."""
    lock = home / "run" / "up.lock"
    lock.parent.mkdir(parents=True)
    with subprocess.Popen(
        [sys.executable, "-c", HOLDER, str(lock)], stdout=subprocess.PIPE, text=True
    ) as process:
        assert known(process.stdout).readline() == "held\n"
        try:
            yield process
        finally:
            process.kill()


def write_logs(settings: LaunchSettings, **logs: str) -> None:
    folder = settings.home / "logs"
    folder.mkdir(parents=True)
    for name, text in logs.items():
        (folder / f"{name}.log").write_text(text)


def test_down_ends_who_holds_the_home(
    settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    with holding(settings.home) as process:
        assert end(settings) == 0
        assert process.wait(20) == -15
        assert f"pid {process.pid}" in capsys.readouterr().out


def test_down_without_a_robot_says_so(
    settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    assert end(settings) == 1
    assert capsys.readouterr().err.startswith("not_running: ")


def test_a_lock_that_nobody_holds_ends_nothing(settings: LaunchSettings) -> None:
    lock = settings.home / "run" / "up.lock"
    lock.parent.mkdir(parents=True)
    lock.write_text(str(os.getpid()))
    assert end(settings) == 1


def test_what_ends_while_it_starts_gives_its_words_and_status(
    settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    assert start(settings, ["no-such-command"]) == 2
    assert "no-such-command" in capsys.readouterr().out


def test_a_home_that_takes_no_log_is_refused(
    settings: LaunchSettings, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").write_text("")
    assert start(replace(settings, home=tmp_path / "file"), ["up"]) == 2
    assert capsys.readouterr().err.startswith("home_unwritable: ")


@pytest.mark.parametrize("count", [0, 1, 2, 5])
def test_the_newest_lines_of_each_log_are_shown(
    settings: LaunchSettings, count: int, capsys: pytest.CaptureFixture[str]
) -> None:
    write_logs(settings, bridge="one\ntwo\n", planner="three\n")
    assert show_logs(settings, [], count, follow=False) == 0
    shown = [line.split() for line in capsys.readouterr().out.splitlines()]
    bridge = [["bridge", word] for word in ("one", "two")][2 - min(count, 2) :]
    assert shown == bridge + [["planner", "three"]] * (count > 0)


def test_one_log_is_shown_by_its_name(
    settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    write_logs(settings, bridge="one\n", planner="three\n")
    assert show_logs(settings, ["planner"], 9, follow=False) == 0
    assert capsys.readouterr().out.split() == ["planner", "three"]


@pytest.mark.parametrize("names", [[], ["lidar"]])
def test_a_log_that_is_not_there_is_told_with_those_that_are(
    settings: LaunchSettings, names: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    if names:
        write_logs(settings, bridge="one\n")
    assert show_logs(settings, names, 9, follow=False) == 1
    told = capsys.readouterr().err
    assert told.startswith("no_log: ")
    assert told.rstrip().endswith("bridge" if names else "none")


def test_a_page_that_nobody_serves_is_not_opened(settings: LaunchSettings) -> None:
    assert open_page(settings) == 6
