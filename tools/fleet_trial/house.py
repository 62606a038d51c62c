"""Run a house: robots, the wires to them, the service, its database. Kill each; end them all."""

from __future__ import annotations

import asyncio
import ctypes
import multiprocessing
import os
import pwd
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
import psutil

from processes.parent_death import child_command
from tools.fleet_trial.wires import Wire

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable
    from multiprocessing.context import ForkServerProcess

ROOT = Path(__file__).resolve().parents[2]
SITE = ROOT / "sites" / "two_room"
PATIENCE_S = 400.0
_PR_SET_PDEATHSIG = 1  # prctl(2)


def free_port() -> int:
    """Return a port that was free a moment ago."""
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        port: int = taken.getsockname()[1]
        return port


async def until(look: Callable[[], Awaitable[bool]], what: str) -> None:
    """Wait for something.

    Raises:
        TimeoutError: it did not come.
    """
    end_s = time.monotonic() + PATIENCE_S
    while not await look():
        if time.monotonic() > end_s:
            raise TimeoutError(f"waited {PATIENCE_S:g} s in vain for {what}")
        await asyncio.sleep(0.1)


class LinkRobot:
    """Hold one robot's process: forked from a server that has loaded the planner once."""

    def __init__(self, context: Any, home: Path) -> None:
        self.home, self.port, self._context = home, free_port(), context
        self.wire = Wire(self.port)
        self.client = httpx.AsyncClient(
            base_url=f"http://127.0.0.1:{self.port}", trust_env=False, timeout=10.0
        )
        home.mkdir(parents=True, exist_ok=True)
        text = (ROOT / "robot.toml").read_text("utf-8")
        text = re.sub(r'(?m)^id = "r1"', f'id = "{home.name}"', text)
        (home / "robot.toml").write_text(text, "utf-8")
        self._process: ForkServerProcess | None = None

    def start(self) -> None:
        """Begin on the journal that there is."""
        self._process = self._context.Process(target=_be_robot, args=(self.home, self.port))
        self._process.start()

    def kill(self) -> None:
        """Kill it with SIGKILL."""
        if self._process is not None:
            self._process.kill()
            self._process.join()
            self._process = None

    async def answers(self) -> bool:
        """Return whether its API does."""
        try:
            return (await self.client.get("/healthz")).is_success
        except httpx.HTTPError:
            return False

    async def resume_paused(self) -> int:
        """Resume what a killed planner left paused, as its owner does; return how many were."""
        try:
            goals = (await self.client.get("/v1/goals", params={"limit": 8})).json()["goals"]
            paused = [goal["id"] for goal in goals if goal["state"] == "paused"]
            for goal_id in paused:
                await self.client.post(f"/v1/goals/{goal_id}/resume", json={})
        except (httpx.HTTPError, ValueError, KeyError):
            return 1
        return len(paused)


def _be_robot(home: Path, port: int) -> None:
    parent = os.getppid()
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(1)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the trial's, which kills it
    from tools.fleet_trial.link_robot import run_robot

    run_robot(home, SITE, port)


class Postgres:
    """Hold a cluster of one's own on a socket, run by a user without rights."""

    def __init__(self, place: Path) -> None:
        folders = sorted(Path("/usr/lib/postgresql").glob("*/bin"))
        if not folders:
            raise FileNotFoundError("no postgresql here: apt install postgresql")
        self._tools, self._place, self._data = folders[-1], place, place / "data"
        self._user = pwd.getpwnam("nobody" if os.geteuid() == 0 else pwd.getpwuid(os.geteuid())[0])
        self.url = f"postgresql://fleet@/postgres?host={place}"

    def start(self) -> None:
        """Start it, made first where it is not; it recovers from a kill by itself."""
        if not self._data.exists():
            self._place.mkdir(parents=True, exist_ok=True)
            os.chown(self._place, self._user.pw_uid, self._user.pw_gid)
            self._run("initdb", "-U", "fleet", "-A", "trust")
        end_s, options = time.monotonic() + PATIENCE_S, f"-k {self._place} -c listen_addresses="
        while True:
            try:
                self._run("pg_ctl", "-l", str(self._place / "log"), "-w", "-o", options, "start")
            except subprocess.CalledProcessError:  # workers of the killed one are not gone yet
                if time.monotonic() > end_s:
                    raise
                time.sleep(0.2)
            else:
                return

    def kill(self) -> None:
        """Kill the server with SIGKILL."""
        with suppress(OSError, ValueError, IndexError):
            os.kill(int((self._data / "postmaster.pid").read_text().split()[0]), signal.SIGKILL)

    def end(self) -> None:
        """Stop it."""
        with suppress(subprocess.SubprocessError):
            self._run("pg_ctl", "-m", "immediate", "-w", "stop")

    def _run(self, tool: str, *words: str) -> None:
        subprocess.run(
            (str(self._tools / tool), "-D", str(self._data), *words), check=True, cwd="/",
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, user=self._user.pw_uid,
            group=self._user.pw_gid, timeout=PATIENCE_S,
            env={"PATH": os.environ["PATH"], "LC_ALL": "C.UTF-8"},
        )  # fmt: skip


class House:
    """Hold all of one trial's processes; leaving the context kills them."""

    def __init__(self, folder: Path, robots: int, kind: str) -> None:
        context: Any = multiprocessing.get_context("forkserver")
        context.set_forkserver_preload(["tools.fleet_trial.link_robot"])
        self.folder = folder
        self.robots = [LinkRobot(context, folder / f"r{n:02}") for n in range(1, robots + 1)]
        self.postgres: Postgres | None = None
        self.database = f"sqlite:///{folder / 'fleet.sqlite'}"
        if kind == "postgres":  # names of sockets are short, and nobody may enter the folder
            marker = folder / "postgres"
            if not marker.exists():
                marker.write_text(tempfile.mkdtemp(prefix="pg-", dir="/tmp"))
            self.postgres = Postgres(Path(marker.read_text()))
            self.database = self.postgres.url
        self.port = free_port()
        self.client = httpx.AsyncClient(
            base_url=f"http://127.0.0.1:{self.port}", trust_env=False, timeout=15.0
        )
        self._service: subprocess.Popen[bytes] | None = None
        self._environment = {
            **os.environ, "PONS_HOME": str(folder), "PONS_FLEET_DB": self.database,
            "PONS_FLEET_PORT": str(self.port),
        }  # fmt: skip

    @property
    def homes(self) -> list[Path]:
        """Return the robots' homes."""
        return [robot.home for robot in self.robots]

    async def start(self) -> None:
        """Start all, and take the robots in."""
        if self.postgres is not None:
            await asyncio.to_thread(self.postgres.start)
        for robot in self.robots:
            robot.start()
        for robot in self.robots:
            await until(robot.answers, f"{robot.home.name} (its log is in {robot.home})")
        await self._add_all()
        await self.start_service()
        await until(self._are_all_ready, "all robots to be ready")

    async def _add_all(self) -> None:
        """Run ``pons fleet add`` for each, in one process: its start takes longest."""
        added = self.folder / "added"
        acts = [
            ["add", f"http://127.0.0.1:{await robot.wire.start()}", "--name", robot.home.name,
             *["--again"] * added.exists()]
            for robot in self.robots
        ]  # fmt: skip
        code = f"from fleet.__main__ import main; import sys; sys.exit(max(map(main, {acts})))"
        adding = await asyncio.create_subprocess_exec(
            sys.executable, "-c", code, cwd=ROOT, env=self._environment, stdout=subprocess.DEVNULL
        )
        if await adding.wait():
            raise RuntimeError("pons fleet add was refused")
        added.touch()

    async def start_service(self) -> None:
        """Start the service, and wait until it answers."""
        self._begin()
        await until(self._answers, "the service")

    def _begin(self) -> None:
        with (self.folder / "fleet.log").open("ab") as log:
            self._service = subprocess.Popen(
                child_command("fleet", "up"), cwd=ROOT, env=self._environment, stdout=log,
                stderr=log, start_new_session=True,  # its share of a busy machine is its own
            )  # fmt: skip

    def kill_service(self) -> None:
        """Kill it with SIGKILL."""
        if self._service is not None:
            self._service.kill()
            self._service.wait()

    def service_cost(self) -> tuple[float, float]:
        """Return the seconds of processor that the service has used, and its memory [MB]."""
        running = psutil.Process(self._service.pid if self._service is not None else 0)
        times = running.cpu_times()
        return times.user + times.system, running.memory_info().rss / 1e6

    async def _answers(self) -> bool:
        if self._service is not None and self._service.poll() is not None:
            self._begin()  # one that ended by itself, as a service manager does
        try:
            return bool((await self.client.get("/healthz")).is_success)
        except httpx.HTTPError:
            return False

    async def _are_all_ready(self) -> bool:
        try:
            robots = (await self.client.get("/v1/robots")).json()["robots"]
        except (httpx.HTTPError, ValueError, KeyError):
            return False
        return len(self.robots) == sum(1 for robot in robots if robot["state"] == "ready")

    async def close(self, *, keep: bool) -> None:
        """Kill all; ``keep`` leaves files, so that the trial may go on from them."""
        self.kill_service()
        await self.client.aclose()
        for robot in self.robots:
            robot.kill()
            robot.wire.close()
            await robot.client.aclose()
        if self.postgres is not None:
            await asyncio.to_thread(self.postgres.end)
            if not keep:
                shutil.rmtree(Path(self.postgres.url.partition("host=")[2]), ignore_errors=True)
        if not keep:
            shutil.rmtree(self.folder, ignore_errors=True)
