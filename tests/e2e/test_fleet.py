"""Tell what a person meets who tries the fleet: the demo, and a robot over TLS with its pin."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import psutil
import pytest

from pons.robot_processes import free_port
from tests.e2e.polling import until
from tests.e2e.system import ROOT, TWO_ROOM, System, new_home
from tests.fleet.conftest import RunningFleet

pytestmark = [pytest.mark.home, pytest.mark.timeout(600), pytest.mark.nightly]

UP_LIMIT_S = 300.0


def family(process: subprocess.Popen[str]) -> list[psutil.Process]:
    """Return a process and all that it has started, however deep."""
    top = psutil.Process(process.pid)
    return [top, *top.children(recursive=True)]


def test_the_demo_drives_three_robots_by_one_sentence_and_leaves_nothing(tmp_path: Path) -> None:
    port = free_port()
    environment = {**os.environ, "PONS_SITE": str(TWO_ROOM), "PONS_FLEET_PORT": str(port),
                   "TMPDIR": "/tmp", "LC_ALL": "C.UTF-8"}  # fmt: skip
    environment.pop("PONS_FLEET_DB", None)
    log = tmp_path / "demo.log"
    with log.open("w") as opened:
        demo = subprocess.Popen(
            [sys.executable, "-m", "pons", "fleet", "demo"], cwd=ROOT, env=environment,
            stdout=opened, stderr=opened, text=True, start_new_session=True,
        )  # fmt: skip
    started: list[psutil.Process] = []
    try:
        url = f"http://127.0.0.1:{port}"
        until(lambda: f": {url}\n" in log.read_text(), UP_LIMIT_S, "ready", log.read_text)
        folder = Path(log.read_text().split("state in ")[1].split(")")[0])
        started = family(demo)
        said = subprocess.run(
            [sys.executable, "-m", "pons", "fleet", "--json", "say", "everybody go home"], cwd=ROOT,
            env=environment, capture_output=True, text=True, check=True, timeout=60,
        )  # fmt: skip
        missions = json.loads(said.stdout)["missions"]
        assert len(missions) == 3

        def robots_that_are_home() -> set[str]:
            found = [httpx.get(f"{url}/v1/missions/{each['id']}", trust_env=False).json()
                     for each in missions]  # fmt: skip
            return {each["robot"] for each in found if each["state"] == "succeeded"}

        until(lambda: robots_that_are_home() == {"r1", "r2", "r3"}, 120.0, "all home")
    finally:
        demo.send_signal(signal.SIGINT)
        demo.wait(60)
    assert demo.returncode == 0, log.read_text()
    assert not [process for process in started if process.is_running()]
    assert not folder.exists()


@pytest.fixture
def fleet(tmp_path: Path) -> Iterator[RunningFleet]:
    """Return a fleet on a file, running."""
    made = RunningFleet(tmp_path / "home", f"sqlite:///{tmp_path / 'fleet.sqlite'}")
    try:
        made.start("fleet.watch.SILENT_S = 2.0")
        yield made
    finally:
        made.kill()
        made.client.close()


def state_of(fleet: RunningFleet, name: str) -> Any:
    robots = fleet.client.get("/v1/robots").json()["robots"]
    return next((robot["state"] for robot in robots if robot["name"] == name), None)


def test_a_robot_over_tls_is_pinned_by_its_authority_and_another_one_gets_nothing(
    fleet: RunningFleet,
) -> None:
    with new_home() as first_home, new_home() as second_home:
        robot = System(Path(first_home), TWO_ROOM, PONS_TLS="1")
        other = System(Path(second_home), TWO_ROOM, PONS_TLS="1")
        other.port = robot.port
        try:
            robot.start()
            made = robot.pons("people", "add", "fleet", "--role", "dispatcher", "--json")
            token = json.loads(made.stdout)["token"]
            shown = robot.pons("tls").stdout
            sha256 = next(word for word in shown.split() if word.count(":") == 31)
            url = f"https://127.0.0.1:{robot.port}"
            wrong = fleet.run("add", url, "--token", token, "--sha256", "00" * 32)
            assert (wrong.returncode, "pin_mismatch" in wrong.stderr) == (3, True), wrong
            words = ("add", url, "--token", token, "--name", "hall", "--sha256", sha256)
            added = fleet.run(*words)
            assert added.returncode == 0, added
            assert "authority SHA-256" in added.stdout
            until(lambda: state_of(fleet, "hall") == "ready", 30.0, "ready")
            (mission,) = fleet.give("hall: go home")
            assert fleet.await_state(mission["id"], "succeeded")["robot"] == "hall"

            robot.end()
            (robot.home / "tls" / "planner.pem").unlink()  # a year later it is renewed
            robot.start()
            until(lambda: state_of(fleet, "hall") == "ready", 30.0, "ready after the renewal")

            robot.end()
            other.start()
            until(lambda: state_of(fleet, "hall") == "pin_mismatch", 30.0, "the pin's refusal")
            fleet.give("hall: go home")
            until(lambda: state_of(fleet, "hall") == "pin_mismatch", 5.0, "the pin's refusal")
            asked = httpx.get(f"{url}/v1/goals", verify=False, trust_env=False)
            assert asked.json()["goals"] == []
        finally:
            robot.destroy()
            other.destroy()
