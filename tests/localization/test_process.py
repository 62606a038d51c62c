"""Stand-in and localizer as real processes: sensors in, localization out, a clean end."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

from localization.__main__ import PRIORITY
from sim import SimRobot
from wire import IDENTITY, STILL, Localization, Odometry, Pose2, SimTruth, keys
from wire.keys import Party
from wire.session import open_session
from wire.site_map import read_map_id

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=1)]
LIMIT_S = 20.0


def test_it_places_odom_in_map_and_says_that_it_is_a_stand_in(
    repository: Path, tmp_path: Path
) -> None:
    robot = tmp_path / "robot.toml"
    robot.write_text('[localization]\nkind = "stand_in"\n', "utf-8")
    command = [sys.executable, "-m", "localization", "--site", "sites/two_room"]
    process = subprocess.Popen(
        [*command, "--home", str(tmp_path), "--robot", str(robot)],
        cwd=repository, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    try:
        answer = converse(tmp_path)
        assert answer.map_id == read_map_id(repository / "sites" / "two_room")
        assert answer.odom_id == "bridge-1"
        assert answer.odom_in_map.x_m == pytest.approx(1.5, abs=0.1)
        assert answer.odom_in_map.y_m == pytest.approx(1.9, abs=0.1)
        first, *others = ranks(process.pid)
        assert first == (PRIORITY if may_be_first() else 0)
        assert first in others, "its transport has the same rank"
        process.send_signal(signal.SIGTERM)
        _, said = process.communicate(timeout=LIMIT_S)
        assert process.returncode == 0
        assert "STAND-IN" in said
    finally:
        process.kill()
        process.communicate(timeout=LIMIT_S)


def test_by_scans_it_places_itself_and_leaves_no_process_behind(
    repository: Path, tmp_path: Path
) -> None:
    robot = tmp_path / "robot.toml"
    robot.write_text('[localization]\nkind = "scans"\n', "utf-8")
    command = [sys.executable, "-m", "localization", "--site", "sites/two_room"]
    process = subprocess.Popen(
        [*command, "--home", str(tmp_path), "--robot", str(robot)],
        cwd=repository, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    try:
        answer, true = converse_by_scans(repository, tmp_path)
        assert answer.map_id == read_map_id(repository / "sites" / "two_room")
        assert answer.odom_in_map.x_m == pytest.approx(true.x_m, abs=0.06)
        assert answer.odom_in_map.y_m == pytest.approx(true.y_m, abs=0.06)
        assert answer.quality > 0.6
        children = psutil.Process(process.pid).children(recursive=True)
        assert children, "the search process"
        assert all(os.sched_getscheduler(child.pid) == os.SCHED_OTHER for child in children)
        process.send_signal(signal.SIGTERM)
        _, said = process.communicate(timeout=LIMIT_S)
        assert process.returncode == 0, said
        assert not psutil.wait_procs(children, timeout=LIMIT_S)[1]
    finally:
        process.kill()
        process.communicate(timeout=LIMIT_S)


def converse_by_scans(repository: Path, home: Path) -> tuple[Localization, Pose2]:
    """Be a standing robot and its bridge until the process has placed it."""
    simulated = SimRobot(repository / "sites" / "two_room", seed=1)
    with (
        open_session(Party.ROBOT, "r1", home) as robot,
        open_session(Party.BRIDGE, "r1", home) as bridge,
    ):
        scans, odoms = robot.publisher(keys.SCAN), bridge.publisher(keys.ODOM)
        answers = bridge.subscriber(keys.LOCALIZATION)
        end_s = time.monotonic() + 2 * LIMIT_S
        for seq in range(10_000):
            now_s = time.monotonic()
            assert now_s < end_s, "no answer"
            scan = simulated.tick(now_s).scan
            if scan is not None:
                scans.put(scan)
            odoms.put(
                Odometry(
                    odom_id="bridge-1", seq=seq, stamp_s=now_s, base_in_odom=IDENTITY,
                    twist=STILL, yaw_rate_radps=None,
                )
            )  # fmt: skip
            answer = answers.newest()
            if answer is not None:
                return answer, simulated.base_in_map
            time.sleep(0.01)
    raise AssertionError("no answer")


def ranks(pid: int) -> list[int]:
    """Return the real-time priorities of a process's threads, the first's first; 0: ordinary."""
    threads = sorted(int(thread.name) for thread in Path(f"/proc/{pid}/task").iterdir())
    return [os.sched_getparam(thread).sched_priority for thread in threads]


def may_be_first() -> bool:
    """Ask in a process of its own whether this machine gives real-time priority."""
    ask = "import os; os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(1))"
    asked = subprocess.run([sys.executable, "-c", ask], stderr=subprocess.DEVNULL, check=False)
    return asked.returncode == 0


def converse(home: Path) -> Localization:
    """Be simulator and bridge until the process has answered."""
    with (
        open_session(Party.ROBOT, "r1", home) as robot,
        open_session(Party.BRIDGE, "r1", home) as bridge,
    ):
        truths, odoms = robot.publisher(keys.SIM_TRUTH), bridge.publisher(keys.ODOM)
        answers = bridge.subscriber(keys.LOCALIZATION)
        end_s = time.monotonic() + LIMIT_S
        for seq in range(10_000):
            now_s = time.monotonic()
            assert now_s < end_s, "no answer"
            truths.put(
                SimTruth(
                    boot_id="sim-1", seq=seq, stamp_s=now_s, base_in_map=Pose2(1.5, 1.9, 0.0),
                    twist=STILL, contacts=0, contacts_total=0, real_time_factor=1.0,
                )
            )  # fmt: skip
            odoms.put(
                Odometry(
                    odom_id="bridge-1", seq=seq, stamp_s=now_s, base_in_odom=IDENTITY,
                    twist=STILL, yaw_rate_radps=None,
                )
            )  # fmt: skip
            answer = answers.newest()
            if answer is not None:
                return answer
            time.sleep(0.02)
    raise AssertionError("no answer")


def test_neither_process_loads_opencv() -> None:
    """It is 18 MB of each, on computers that have one gigabyte for everything."""
    loads = "import localization.localizer, localization.search_client, localization.search_process"
    code = f"import sys; {loads}; raise SystemExit('cv2' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
