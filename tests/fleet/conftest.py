"""Start robots and the service as real processes, and Postgres where it is installed."""

from __future__ import annotations

import asyncio
import json
import os
import socket
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path
from typing import Any, Self

import httpx
import pytest

from fleet.robots import add_robot
from fleet.service import own_home
from fleet.store import FleetStore
from tests.fleet.postgres import Cluster, running_cluster
from tests.known import known

ROOT = Path(__file__).resolve().parents[2]
PATIENCE_S = 90.0


def until(look: Callable[[], Any], patience_s: float = PATIENCE_S) -> Any:
    """Return what is looked for once it is there."""
    end_s = time.monotonic() + patience_s
    while True:
        found = look()
        if found:
            return found
        if time.monotonic() > end_s:
            raise TimeoutError(f"waited {patience_s:g} s in vain")
        time.sleep(0.05)


def free_port() -> int:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        port: int = taken.getsockname()[1]
        return port


class StubRobot:
    """Hold a robot's process; killed and begun again it has the same port and journal."""

    def __init__(self, folder: Path, name: str) -> None:
        self.folder, self.name, self.port = folder, name, free_port()
        self.url = f"http://127.0.0.1:{self.port}"
        self.journal = folder / f"{name}.journal"
        self.start()

    def start(self) -> None:
        words = [sys.executable, "-m", "tests.fleet.robot_stub", str(self.folder), self.name]
        self.process = subprocess.Popen(
            [*words, str(self.port)], cwd=ROOT, stdout=subprocess.PIPE, text=True
        )
        known(self.process.stdout).readline()

    def kill(self) -> None:
        self.process.kill()
        self.process.wait()
        if self.process.stdout is not None:
            self.process.stdout.close()

    def goals(self) -> list[tuple[str, str]]:
        """Return the text and state of each goal on its disk."""
        return self._read("SELECT text, state FROM goals")

    def acts(self, act: str) -> int:
        """Return how often its journal notes an act: begun, stop."""
        return len(self._read("SELECT seq FROM acts WHERE act=?", act))

    def _read(self, query: str, *values: str) -> list[Any]:
        with closing(sqlite3.connect(self.journal)) as disk:
            return disk.execute(query, values).fetchall()

    def rule(self, **rules: Any) -> None:
        """Change how it behaves; a kill forgets it."""
        httpx.post(f"{self.url}/stub", json=rules, trust_env=False).raise_for_status()


class RunningFleet:
    """Hold the service's process and a client of its API."""

    def __init__(self, home: Path, database: str) -> None:
        self.home, self.database, self.port = home, database, free_port()
        self.environment = {**os.environ, "PONS_HOME": str(home), "PONS_FLEET_DB": database,
                            "PONS_FLEET_PORT": str(self.port)}  # fmt: skip
        self.client = httpx.Client(
            base_url=f"http://127.0.0.1:{self.port}", trust_env=False, timeout=20.0
        )
        self.process: subprocess.Popen[bytes] | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.kill()
        self.client.close()

    def run(self, *words: str) -> subprocess.CompletedProcess[str]:
        """Run ``pons fleet`` with these words."""
        return subprocess.run(
            [sys.executable, "-m", "fleet", *words], cwd=ROOT, env=self.environment,
            capture_output=True, text=True, check=False, timeout=PATIENCE_S,
        )  # fmt: skip

    def add(self, *robots: StubRobot) -> None:
        """Add robots as ``pons fleet add`` does."""
        folder = own_home(self.home)
        store = FleetStore(self.database)
        try:
            for robot in robots:
                asyncio.run(add_robot(store, folder, robot.url, "", None))
        finally:
            store.close()
        if self.process is not None:
            self.await_ready(*robots)

    def start(self, *settings: str) -> None:
        """Start it, with constants set to others: ``fleet.watch.SILENT_S = 1.0``."""
        lines = ["import fleet.page_api, fleet.watch, fleet.workflow, fleet.__main__", *settings]
        code = "\n".join([*lines, "fleet.__main__.main(['up'])"])
        self.process = subprocess.Popen(
            [sys.executable, "-c", code], cwd=ROOT, env=self.environment
        )
        until(self.answers)

    def answers(self) -> bool:
        """Return whether it serves."""
        try:
            return bool(self.client.get("/healthz").is_success)
        except httpx.HTTPError:
            return False

    def kill(self) -> None:
        if self.process is not None:
            self.process.kill()
            self.process.wait()
            self.process = None

    def end(self) -> None:
        """Ask it to end, as a service manager does."""
        if self.process is not None:
            self.process.terminate()
            self.process.wait(PATIENCE_S)
            self.process = None

    def give(
        self, text: str, status: int = 202, key: str = "", **more: Any
    ) -> list[dict[str, Any]]:
        headers = {"idempotency-key": key} if key else {}
        answer = self.client.post("/v1/missions", json={"text": text, **more}, headers=headers)
        assert answer.status_code == status, answer.text
        missions: list[dict[str, Any]] = answer.json().get("missions", [])
        return missions

    def mission(self, mission_id: str) -> dict[str, Any]:
        found: dict[str, Any] = self.client.get(f"/v1/missions/{mission_id}").json()
        return found

    def await_state(self, mission_id: str, *states: str) -> dict[str, Any]:
        def look() -> dict[str, Any] | None:
            found = self.mission(mission_id)
            return found if found["state"] in states else None

        try:
            found: dict[str, Any] = until(look)
        except TimeoutError:
            pytest.fail(f"not {states}: {json.dumps(self.mission(mission_id))}")
        return found

    def states(self) -> dict[str, str]:
        """Return the state of each robot, or its trouble."""
        robots = self.client.get("/v1/robots").json()["robots"]
        return {robot["name"]: robot["state"] for robot in robots}

    def await_ready(self, *robots: StubRobot) -> None:
        names = {robot.name for robot in robots}
        until(lambda: names <= {name for name, at in self.states().items() if at == "ready"})


def fleet_on_file(folder: Path) -> RunningFleet:
    return RunningFleet(folder / "home", f"sqlite:///{folder / 'fleet.sqlite'}")


@pytest.fixture
def make_robot(tmp_path: Path) -> Iterator[Callable[[str], StubRobot]]:
    """Return a maker of robots; all end with the test."""
    made: list[StubRobot] = []

    def make(name: str) -> StubRobot:
        made.append(StubRobot(tmp_path, name))
        return made[-1]

    yield make
    for robot in made:
        robot.kill()


@pytest.fixture(scope="session")
def postgres() -> Iterator[Cluster]:
    """Return a cluster of our own, for databases of tests that leave it running."""
    with running_cluster() as cluster:
        yield cluster


@pytest.fixture(scope="module")
def fleet(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningFleet]:
    """Return a fleet on SQLite that runs for all stories of a file; each names its own robots."""
    folder = tmp_path_factory.mktemp("fleet")
    with fleet_on_file(folder) as running:
        running.start("fleet.watch.SILENT_S = 2.0")
        yield running


@pytest.fixture
def file_fleet(tmp_path: Path) -> Iterator[RunningFleet]:
    """Return a fleet of its own on a file, not yet started."""
    with fleet_on_file(tmp_path) as made:
        yield made


@pytest.fixture(params=["sqlite", "postgres"])
def own_fleet(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[RunningFleet]:
    """Return a fleet without robots, not yet started, on each kind of database."""
    if request.param == "sqlite":
        made = fleet_on_file(tmp_path)
    else:
        cluster: Cluster = request.getfixturevalue("postgres")
        made = RunningFleet(tmp_path / "home", cluster.make_database())
    with made as running:
        yield running
