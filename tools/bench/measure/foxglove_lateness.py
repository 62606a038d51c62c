"""Measure what a live view and a window on all its topics do to the lateness of a 100 Hz tick.

Slices with and without ``pons foxglove`` alternate, each with a robot of its own that stands; the
ratio is taken pair by pair. The window runs in this process and reads all that it is sent.
"""

from __future__ import annotations

import asyncio
import json
import os
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from threading import Thread
from typing import TYPE_CHECKING, Any

from websockets.asyncio.client import connect

from pons.robot_processes import free_port
from tools.bench.context import until
from tools.bench.figures import percentile
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import BenchRobot

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tools.bench.context import BenchLab

NAME = "foxglove_lateness"
TITLE = "lateness of a 100 Hz tick with a live view, against without"
LONG_ONLY = True
PAIRS = 12
SLICE_S = 6.0
SUBPROTOCOL: Any = "foxglove.sdk.v1"


def measure(lab: BenchLab) -> list[ReportRow]:
    """Take pairs of slices, the first of each in turn; compare their p99."""
    pairs = list(lab.slices("pair", PAIRS, lambda i: _pair(lab, i)))
    rows = [
        row_of(f"p99 of a slice, {name}", "us", "", [percentile(p[name], 0.99) for p in pairs])
        for name in ("without", "with")
    ]
    ratios = [percentile(p["with"], 0.99) / percentile(p["without"], 0.99) for p in pairs]
    heard = f"{median(p['messages'] for p in pairs):.0f} messages a slice" if pairs else ""
    rows.append(row_of("p99 with over without", "ratio", "p50 <= 1.05", ratios, heard))
    shares = [p["core_share"] for p in pairs]
    rows.append(row_of("its process, of a core", "ratio", "p50 <= 0.1", shares))
    return rows


def _pair(lab: BenchLab, index: int) -> dict[str, Any]:
    taken: dict[str, Any] = {}
    for shows in (False, True) if index % 2 == 0 else (True, False):
        taken.update(_slice(lab, shows=shows))
    return taken


def _slice(lab: BenchLab, *, shows: bool) -> dict[str, Any]:
    with lab.folder() as home, BenchRobot(home, "two_room", tapped=True) as robot:
        until(lambda: robot.status is not None, 20.0, "the bridge's first status")
        if not shows:
            time.sleep(SLICE_S)
            return {"without": _late_us(robot)}
        with _live_view(robot) as (process, seen):
            until(lambda: seen, 30.0, "the first message to the window")
            before, began = len(seen), _used_s(process.pid)
            time.sleep(SLICE_S)
            share = (_used_s(process.pid) - began) / SLICE_S
            return {"with": _late_us(robot), "messages": len(seen) - before, "core_share": share}


def _late_us(robot: BenchRobot) -> list[float]:
    late_us: list[float] = robot.end_bridge()["late_us"]
    return late_us[-round(SLICE_S * 100) :]


def _used_s(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text("ascii").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


@contextmanager
def _live_view(robot: BenchRobot) -> Iterator[tuple[subprocess.Popen[bytes], list[int]]]:
    """Run ``pons foxglove`` and a window on all topics; lend the lengths of what it is sent."""
    port, settings = free_port(), robot.settings
    seen: list[int] = []
    environment = {
        **os.environ, "PONS_HOME": str(settings.home), "PONS_PORT": str(settings.port),
        "PONS_ROBOT": str(settings.robot), "PONS_SITE": str(settings.site),
    }  # fmt: skip
    words = [sys.executable, "-m", "pons", "foxglove", "--port", str(port)]
    with subprocess.Popen(words, env=environment, stdout=subprocess.DEVNULL) as process:
        window = Thread(target=lambda: asyncio.run(_watch(port, seen)), daemon=True)
        window.start()
        try:
            yield process, seen
        finally:
            process.terminate()
            window.join(10.0)


async def _watch(port: int, seen: list[int]) -> None:
    """Be a window that has subscribed to every topic, until it is hung up on."""
    end_s = time.monotonic() + 30.0
    while time.monotonic() < end_s:
        try:
            async with connect(
                f"ws://127.0.0.1:{port}", subprotocols=[SUBPROTOCOL], compression=None
            ) as socket:
                async for message in socket:
                    if isinstance(message, bytes):
                        seen.append(len(message))
                        continue
                    said = json.loads(message)
                    if said["op"] == "advertise":
                        wanted = [
                            {"id": each["id"], "channelId": each["id"]} for each in said["channels"]
                        ]
                        asked = {"op": "subscribe", "subscriptions": wanted}
                        await socket.send(json.dumps(asked))
                return
        except OSError:
            await asyncio.sleep(0.1)
