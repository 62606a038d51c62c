"""Measure the service beside 30 robots' doors: ``python -m tests.fleet.measure [--orders 10000]``.

Prints its share of a core and memory at rest, how long it takes to accept orders at 5 a second and
until a robot's journal has them, to stop all, and what a flood does. With ``--evil slow`` the last
robot is hostile, as the stub knows how: the other 29 are measured. The doors are real servers in
one process of their own, so that what thirty planners cost is not measured. Run it alone.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import sqlite3
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from pathlib import Path

import httpx
import psutil

from fleet.robots import add_robot
from fleet.service import own_home
from fleet.store import FleetStore
from tests.fleet.conftest import ROOT, RunningFleet, until
from tests.fleet.robot_stub import make_server
from tests.known import known

ROBOTS = 30
REST_S, STEADY_S, STOPS = 30.0, 40.0, 20
STEADY_HZ = 5.0


def serve_doors(folder: Path) -> None:
    """Be the process of all doors; their ports are printed in one line."""
    servers = [make_server(folder, f"r{number}", 0) for number in range(1, ROBOTS + 1)]
    for server in servers:
        threading.Thread(target=server.serve_forever, daemon=True).start()
    print(*(server.server_address[1] for server in servers), flush=True)
    sys.stdin.read()


def share_of_core(process: psutil.Process, seconds: float) -> float:
    """Return which share of one core a process takes."""
    before = sum(process.cpu_times()[:2])
    time.sleep(seconds)
    return (sum(process.cpu_times()[:2]) - before) / seconds


def megabytes(process: psutil.Process) -> float:
    return process.memory_info().rss / 1e6


def describe(times_s: list[float]) -> str:
    """Return median, 99th percentile and the worst, in milliseconds."""
    cuts = statistics.quantiles(times_s, n=100, method="inclusive")
    return f"p50 {1e3 * cuts[49]:.1f}  p99 {1e3 * cuts[98]:.1f}  max {1e3 * max(times_s):.1f} ms"


def give(fleet: RunningFleet, text: str) -> tuple[float, int]:
    began_s = time.monotonic()
    try:
        status = fleet.client.post("/v1/missions", json={"text": text}).status_code
    except httpx.HTTPError:
        status = 0
    return time.monotonic() - began_s, status


def written_at(folder: Path) -> dict[str, float]:
    """Return when each mission was first in a robot's journal [unix s]."""
    found: dict[str, float] = {}
    for file in folder.glob("*.journal"):
        with closing(sqlite3.connect(file)) as disk:
            found |= dict(disk.execute("SELECT key, at_unix_s FROM keys").fetchall())
    return found


def measure_stops(fleet: RunningFleet, service: psutil.Process) -> str:
    """Stop all some times; the processor's time includes half a second of rest each."""
    taken_s, missed, before_s = [], 0, sum(service.cpu_times()[:2])
    for _ in range(STOPS):
        began_s = time.monotonic()
        missed += len(fleet.client.post("/v1/stop").json()["not_reached"])
        taken_s.append(time.monotonic() - began_s)
        time.sleep(0.5)
    each_ms = 1e3 * (sum(service.cpu_times()[:2]) - before_s) / STOPS
    return (
        f"{describe(taken_s)}  n {STOPS}, {missed} not reached, {each_ms:.0f} ms of processor each"
    )


def report(fleet: RunningFleet, folder: Path, orders: int) -> None:
    """Measure and print."""
    service = psutil.Process(known(fleet.process).pid)
    until(lambda: list(fleet.states().values()).count("ready") >= ROBOTS - 1, 600.0)
    time.sleep(5.0)
    rest = share_of_core(service, REST_S)
    print(f"at rest, {ROBOTS} robots: {100 * rest:.1f} % of a core, {megabytes(service):.0f} MB")
    steady: list[float] = []
    told_unix_s: dict[str, float] = {}
    busy = sum(service.cpu_times()[:2])
    for number in range(int(STEADY_S * STEADY_HZ)):
        began_s = time.monotonic()
        (mission,) = fleet.give(f"r{1 + number % (ROBOTS - 1)}: go to the hall {number}")
        told_unix_s[mission["id"]] = time.time()
        steady.append(taken_s := time.monotonic() - began_s)
        time.sleep(max(0.0, 1.0 / STEADY_HZ - taken_s))
    busy = (sum(service.cpu_times()[:2]) - busy) / STEADY_S
    print(f"accepted at {STEADY_HZ:g}/s: {describe(steady)}  n {len(steady)}, {100 * busy:.1f} %"
          f" of a core, {megabytes(service):.0f} MB")  # fmt: skip
    time.sleep(5.0)
    late_s = [at - told_unix_s[key] for key, at in written_at(folder).items() if key in told_unix_s]
    print(f"accept to the robot's journal: {describe([max(0.0, s) for s in late_s])}"
          f"  n {len(late_s)} of {len(told_unix_s)}")  # fmt: skip
    print(f"stop all: {measure_stops(fleet, service)}")
    if not orders:
        return
    began_s = time.monotonic()
    with ThreadPoolExecutor(16) as many:
        flood = list(many.map(lambda number: give(fleet, f"r1: go to the hall {number}"),
                              range(orders)))  # fmt: skip
    rate = orders / (time.monotonic() - began_s)
    taken = sum(status == 202 for _, status in flood)
    times_s = [taken_s for taken_s, _ in flood]
    print(f"{orders} at once by 16: {taken} accepted, {rate:.0f}/s, {describe(times_s)},"
          f" {megabytes(service):.0f} MB")  # fmt: skip
    began_s = time.monotonic()
    told = fleet.client.post("/v1/stop").json()
    print(f"stop all in the flood: {len(told['confirmed'])} confirmed,"
          f" {1e3 * (time.monotonic() - began_s):.0f} ms")  # fmt: skip


def main() -> None:
    """Run the doors, the service and the measurement in a folder of its own."""
    parser = argparse.ArgumentParser(prog="python -m tests.fleet.measure", description=__doc__)
    parser.add_argument("--orders", type=int, default=10_000, help="in the flood")
    parser.add_argument("--evil", help="how the last robot is hostile: slow, endless, never, …")
    parser.add_argument("--doors", type=Path, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.doors is not None:
        serve_doors(given.doors)
        return
    print(f"load {os.getloadavg()[0]:.1f}")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        words = [sys.executable, "-m", "tests.fleet.measure", "--doors", name]
        doors = subprocess.Popen(words, cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        fleet = RunningFleet(folder / "home", f"sqlite:///{folder / 'fleet.sqlite'}")
        fleet.client.timeout = httpx.Timeout(120.0)
        try:
            add_all(fleet, ports := known(doors.stdout).readline().split())
            fleet.start()
            if given.evil is not None:
                httpx.post(f"http://127.0.0.1:{int(ports[-1])}/stub", json={"evil": given.evil})
            report(fleet, folder, given.orders)
        finally:
            fleet.kill()
            doors.kill()
            doors.communicate()


def add_all(fleet: RunningFleet, ports: list[bytes]) -> None:
    """Add each door as a robot."""
    store, home = FleetStore(fleet.database), own_home(fleet.home)
    for number, port in enumerate(ports, 1):
        url = f"http://127.0.0.1:{int(port)}"
        asyncio.run(add_robot(store, home, url, "", f"r{number}"))
    store.close()


if __name__ == "__main__":
    main()
