"""Record an hour of driving as the bridge does, replay it, and count the ticks that differ.

Lockstep drives a seeded robot through the whole home; the real recorder hands its ticks to its real
process, which writes files of the smallest size that an owner may set, so that many begin. Each
slice is five simulated minutes and runs by itself.
"""

from __future__ import annotations

import os
import time
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bridge.core import step
from bridge.recording.recorder import Recorder
from bridge.recording.writer_process import Sizes
from bridge.replay import replay
from tools.bench.report import ReportRow
from tools.lockstep import LockstepWorld
from wire import Mode

if TYPE_CHECKING:
    from bridge.core import BridgeState, CoreConfig, Decision, Inbox
    from tools.bench.context import BenchLab

NAME = "replay_hour"
TITLE = "black box: an hour recorded, read and replayed"
LONG_ONLY = True
SLICES = 12
SLICE_TICKS = 30_000
SIZES = Sizes(rotate_bytes=4 << 20, cap_bytes=1 << 40)
TOURS = (
    "go to the kitchen, then the bedroom, then the living room, then the study",
    "去卫生间，然后去客厅，再去厨房，最后去卧室",
    "go to the sofa",
)
BACKLOG_BYTES = 200_000
"""Lockstep runs many times faster than a robot: it waits for the disk as no robot may."""


class RecordedStep:
    """Be the core's step and hand each tick to a recorder."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.recorder: Recorder | None = None
        self.active = 0

    def __call__(
        self, config: CoreConfig, state: BridgeState, inbox: Inbox, now_s: float
    ) -> Decision:
        decision = step(config, state, inbox, now_s)
        if self.recorder is None:
            self.recorder = Recorder(self._folder, config, SIZES)
        self.recorder.tick(state, inbox, now_s, decision)
        self.active += decision.state.mode is Mode.ACTIVE
        while self.recorder.backlog_bytes > BACKLOG_BYTES:
            time.sleep(0.001)
        return decision


def measure(lab: BenchLab) -> list[ReportRow]:
    """Record and replay slice after slice."""
    runs = list(lab.slices("drive", SLICES, lambda index: _drive(lab, index)))
    total = {name: sum(run[name] for run in runs) for name in runs[0]} if runs else {}
    ticks = total.get("ticks", 0)
    hours = ticks / 360_000
    note = (
        f"{ticks} ticks = {hours:.2f} h in {total.get('files', 0)} files, "
        f"{total.get('gaps', 0)} gaps, {total.get('active', 0) / 360_000:.2f} h of it driving"
    )
    whole = len(runs) == SLICES and total["gaps"] == 0
    size = f"{total['bytes'] / hours / 1e6:.0f}" if hours else "none"
    cpu = f"{100 * total['writer_s'] / (ticks / 100):.2f}" if hours else "none"
    return [
        ReportRow("differing ticks", "", "0", value=str(total.get("differing", "none")), note=note,
            valid=whole),
        ReportRow("recording", "MB/h", "", value=size),
        ReportRow("writing process, at 100 ticks/s", "% CPU", "", value=cpu),
    ]  # fmt: skip


def _drive(lab: BenchLab, index: int) -> dict[str, float]:
    """Record one slice and replay its files as one run."""
    with lab.folder() as folder:
        taken = RecordedStep(folder)
        world = LockstepWorld(site="home", seed=100 + index, step=taken)
        tours = cycle(TOURS[index % len(TOURS) :] + TOURS[: index % len(TOURS)])
        goal: Any = None
        while world.tick_count < SLICE_TICKS:
            if goal is None or goal.has_ended:
                goal = world.say(next(tours))
            world.tick()
        recorder = taken.recorder
        if recorder is None or recorder.writer_pid is None:
            raise OSError("no writing process could be started")
        writer_s = _cpu_s(recorder.writer_pid)
        recorder.close()
        files = sorted(folder.glob("*.mcap"), key=lambda path: path.stem.rsplit("-", 1)[1])
        report = replay(files)
        return {
            "ticks": report.ticks,
            "differing": report.differing,
            "gaps": report.gaps + recorder.gaps,
            "files": len(files),
            "bytes": sum(path.stat().st_size for path in files),
            "active": taken.active,
            "writer_s": writer_s,
        }


def _cpu_s(pid: int) -> float:
    """Return the CPU time of a process, proc(5)."""
    fields = Path(f"/proc/{pid}/stat").read_text("ascii").rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
