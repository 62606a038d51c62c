"""The black box in a running robot: its process killed, its disk full, all killed at once."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
import time
from pathlib import Path

import psutil
import pytest

from bridge.replay import replay
from tests.e2e.polling import until
from tests.e2e.robot import REFUSED, Robot
from wire import Mode

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(180), pytest.mark.nightly(keep=1)]
WRITER = "bridge.recording"


def writer(robot: Robot) -> psutil.Process | None:
    """Return the process that writes; None while there is none."""
    for process in robot.system.processes():
        try:
            if any(WRITER in word for word in process.cmdline()):
                return process
        except psutil.Error:
            continue
    return None


def files(home: Path) -> list[Path]:
    return sorted((home / "recordings").glob("*.mcap"))


def test_a_killed_writer_is_said_and_replaced_while_the_robot_drives_on(home: Path) -> None:
    robot = Robot(home)
    try:
        robot.start()
        robot.rest()
        place, goal = robot.drive_off()
        first = writer(robot)
        assert first is not None
        first.kill()

        def told() -> bool:
            return "recorder_down" in robot.judge.status.waiting_for

        until(told, 5.0, "the word that nothing is recorded", robot.judge.describe)
        assert robot.judge.status.mode is Mode.ACTIVE
        until(lambda: not told(), 15.0, "a new writer", robot.judge.describe)
        second = writer(robot)
        assert second is not None
        assert second.pid != first.pid
        robot.arrive(place, goal)
        robot.system.end(signal.SIGTERM)
        report = replay(files(home))
        assert (report.differing, report.first_difference) == (0, None)
        assert 0 < report.gaps < 1500
        assert report.ticks > 500
    finally:
        robot.system.destroy()
        robot.judge.close()


def test_with_everything_killed_at_once_the_last_stop_is_still_explained(home: Path) -> None:
    robot = Robot(home)
    try:
        robot.start()
        robot.rest()
        robot.drive_off()
        assert robot.system.pons("stop").returncode == 0
        robot.judge.until_standing(5.0)
        time.sleep(1.2)
        last_tick = robot.judge.status.ticks.ticks
        victims = [*robot.system.processes()]
        for process in victims:
            process.send_signal(signal.SIGKILL)
        psutil.wait_procs(victims, timeout=10)
        told = robot.system.pons("why")
        assert told.returncode == 0, (told.stdout, told.stderr)
        assert "ACTIVE -> STOPPING, by stop" in told.stdout
        assert "有人下达了停止指令" in robot.system.pons("why", chinese=True).stdout
        assert "pons resume" in told.stdout
        assert len(told.stdout.splitlines()) <= 24, "one screen"
        report = replay(files(home))
        assert (report.differing, report.gaps) == (0, 0)
        assert report.ticks >= last_tick - 100, "all but the last second"
    finally:
        robot.system.destroy()
        robot.judge.close()


def fill(path: Path) -> None:
    size = 1 << 20
    with path.open("wb", buffering=0) as file:
        while size:
            try:
                file.write(os.urandom(size))
            except OSError as error:
                if error.errno != errno.ENOSPC:
                    raise
                size //= 2


def test_a_full_disk_keeps_driving_and_refuses_only_to_arm(home: Path) -> None:
    folder = home / "recordings"
    folder.mkdir(parents=True)
    mount = ["mount", "-t", "tmpfs", "-o", "size=16m", "tmpfs", str(folder)]
    done = subprocess.run(mount, capture_output=True, text=True, check=False)
    if done.returncode:
        pytest.skip(f"no small disk to fill: {done.stderr.strip()}")
    robot = Robot(home)
    try:
        robot.start()
        robot.rest()
        place, goal = robot.drive_off()
        fill(folder / "somebody.log")

        def full() -> bool:
            return "disk_full" in robot.judge.status.waiting_for

        until(full, 10.0, "the word that the disk is full", robot.judge.describe)
        robot.arrive(place, goal)
        assert robot.system.operate("disarm").status == 200
        robot.judge.until_mode(Mode.DISARMED)
        until(
            lambda: robot.judge.status.waiting_for == ("disk_full",),
            10.0, "nothing else that keeps it disarmed", robot.judge.describe,
        )  # fmt: skip
        refused = robot.system.operate("arm")
        assert (refused.status, refused.code) == (409, "disk_full")
        assert refused.body["message"]["zh"].startswith("磁盘已满")
        assert robot.system.pons("arm").returncode == REFUSED
        (folder / "somebody.log").unlink()
        until(lambda: not full(), 10.0, "records again", robot.judge.describe)
        robot.arm()
        robot.system.end(signal.SIGTERM)
        report = replay(files(home))
        assert report.differing == 0
        assert report.gaps > 0
    finally:
        robot.system.destroy()
        robot.judge.close()
        subprocess.run(["umount", "-l", str(folder)], check=True)
