"""Measure from a fresh clone to the printed URL, as a person sees it: clone, ``make run``, read."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import time
from typing import TYPE_CHECKING, Any

from pons.machine import ROOT
from pons.robot_processes import free_port
from tools.bench.context import MeasurementFailure
from tools.bench.report import ReportRow, row_of

if TYPE_CHECKING:
    from pathlib import Path

    from tools.bench.context import BenchLab

NAME = "clone_to_url"
TITLE = "clone to printed URL"
LONG_ONLY = True
LIMIT_S = 600.0
_URL = re.compile(r"ready after .*http://")


def measure(lab: BenchLab) -> list[ReportRow]:
    """Clone, run, read the URL, Ctrl-C; each time from nothing but the package caches."""
    runs = list(lab.slices("clone", 3, lambda index: _clone(lab)))
    took = [run["took_s"] for run in runs]
    left = [run["exit"] for run in runs]
    return [row_of("clone -> URL", "s", "<= 120", took, f"exit after Ctrl-C: {left}")]


def _clone(lab: BenchLab) -> dict[str, Any]:
    with lab.folder() as folder:
        began_s = time.monotonic()
        clone = folder / "pons"
        subprocess.run(["git", "clone", "-q", str(ROOT), str(clone)], check=True)
        port = str(free_port())
        environment = {k: v for k, v in os.environ.items() if not k.startswith("PONS_")}
        environment |= {"PONS_PORT": port}
        log = folder / "run.log"
        with log.open("w") as out:
            run = subprocess.Popen(
                ["make", "run"], cwd=clone, env=environment, stdout=out, stderr=out,
                stdin=subprocess.DEVNULL, start_new_session=True,
            )  # fmt: skip
        try:
            _until_url(run, log, began_s)
            took_s = time.monotonic() - began_s
            os.killpg(run.pid, signal.SIGINT)
            return {"took_s": took_s, "exit": run.wait(timeout=30.0)}
        finally:
            if run.poll() is None:
                os.killpg(run.pid, signal.SIGKILL)
                run.wait()


def _until_url(run: subprocess.Popen[bytes], log: Path, began_s: float) -> None:
    while not _URL.search(log.read_text("utf-8", "replace")):
        if run.poll() is not None or time.monotonic() - began_s > LIMIT_S:
            raise MeasurementFailure(
                f"make run gave no URL; it said:\n{log.read_text('utf-8')[-2000:]}"
            )
        time.sleep(0.1)
