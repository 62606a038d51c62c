"""Put three robots into networks of their own, over TLS; pull one's cable, kill another."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path

import pytest

from pons.authority import issue
from tests.conftest import ROOT
from tests.fleet.conftest import RunningFleet, until
from tests.fleet.judge import CLEAN, judge
from tests.known import known

pytestmark = [
    pytest.mark.e2e,
    pytest.mark.long,
    pytest.mark.timeout(600),
    pytest.mark.skipif(
        os.geteuid() != 0 or shutil.which("ip") is None, reason="namespaces need root and ip"
    ),
    pytest.mark.nightly,
]
PORT, NET = 8420, 100 + os.getpid() % 100


def ip(*words: str) -> None:
    subprocess.run(["ip", *words], check=True, capture_output=True)


class NetworkedRobot:
    """Hold a robot behind a cable of its own."""

    def __init__(self, folder: Path, number: int) -> None:
        self.name, self.folder = f"r{number}", folder
        self.space, self.cable = f"pons{os.getpid()}{number}", f"pv{os.getpid()}{number}"
        self.host = f"10.{NET}.{number}.2"
        ip("netns", "add", self.space)
        ip("link", "add", self.cable, "type", "veth", "peer", "name", "eth0", "netns", self.space)
        ip("addr", "add", f"10.{NET}.{number}.1/24", "dev", self.cable)
        ip("link", "set", self.cable, "up")
        ip("-n", self.space, "addr", "add", f"{self.host}/24", "dev", "eth0")
        ip("-n", self.space, "link", "set", "eth0", "up")
        (folder / self.name).mkdir()
        made = issue(folder / self.name, "robot", {self.host}, set(), datetime.now(UTC))
        self._words = [str(PORT), self.host, str(made.planner)]
        self.journal = folder / f"{self.name}.journal"
        self.start()

    def start(self) -> None:
        module = [sys.executable, "-m", "tests.fleet.robot_stub", str(self.folder), self.name]
        self.process = subprocess.Popen(
            ["ip", "netns", "exec", self.space, *module, *self._words],
            cwd=ROOT, stdout=subprocess.PIPE, text=True,
        )  # fmt: skip
        known(self.process.stdout).readline()

    def plug(self, state: str) -> None:
        """Plug its end of the cable in or out: without ours, packets would go the default way."""
        ip("-n", self.space, "link", "set", "eth0", state)

    def kill(self) -> None:
        self.process.kill()
        self.process.wait()
        if self.process.stdout is not None:
            self.process.stdout.close()

    def end(self) -> None:
        self.kill()
        subprocess.run(["ip", "netns", "del", self.space], check=False, capture_output=True)
        subprocess.run(["ip", "link", "del", self.cable], check=False, capture_output=True)


@pytest.fixture
def robots(tmp_path: Path) -> Iterator[list[NetworkedRobot]]:
    made: list[NetworkedRobot] = []
    try:
        for number in (1, 2, 3):
            made.append(NetworkedRobot(tmp_path, number))  # noqa: PERF401  # each is ended
        yield made
    finally:
        for robot in made:
            robot.end()


def test_a_pulled_cable_and_a_kill_lose_nothing_in_three_networks(
    file_fleet: RunningFleet, robots: list[NetworkedRobot]
) -> None:
    fleet = file_fleet
    for robot in robots:
        url = f"https://{robot.host}:{PORT}"
        added = fleet.run("add", url, "--token", "t", "--name", robot.name)
        assert added.returncode == 0, added.stderr
    fleet.start("fleet.watch.SILENT_S = 2.0")
    until(lambda: set(fleet.states().values()) == {"ready"})
    given = [fleet.give(f"{robot.name}: go to the kitchen")[0]["id"] for robot in robots]
    robots[0].plug("down")
    robots[1].kill()
    until(lambda: fleet.states()["r1"] == fleet.states()["r2"] == "robot_silent")
    given += [fleet.give(f"{robot.name}: go to the hall")[0]["id"] for robot in robots]
    fleet.await_state(given[5], "succeeded")  # the third has noticed nothing
    robots[0].plug("up")
    robots[1].start()
    for mission_id in given:
        fleet.await_state(mission_id, "succeeded")
    assert judge(given, [robot.journal for robot in robots], fleet.database) == CLEAN
