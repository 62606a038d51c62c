"""The conformance kit passes our bridge and can fail others. Told alone: a flood starves others.

The kit's own verdict is its exit status and its JSON; what it says of a bridge without one of its
laws shows that it would notice.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import psutil
import pytest

from tests.e2e.system import ROOT

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(450)]

CARELESS = "tests.pons.conformance.careless"
LIMIT_S = 420.0
"""A short run takes under a minute; on a machine that keeps no time the kit waits for calm and
plays rows again, for three minutes and what is then under way."""


def kit(*words: str, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "pons", "conformance", *words],
        cwd=ROOT,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
        timeout=LIMIT_S,
    )


def test_our_bridge_passes_the_short_run(tmp_path: Path) -> None:
    written = tmp_path / "matrix.json"
    done = kit("--quick", "--json", str(written))
    assert done.returncode == 0, done.stderr + done.stdout
    told = json.loads(written.read_text("utf-8"))
    assert told["passed"] is True
    assert {row["brain"] for row in told["rows"]} == {"velocity", "waypoints"}
    assert len(told["rows"]) >= 10
    assert "0 failed: PASS" in done.stdout


@pytest.mark.parametrize(
    ("left_out", "fault", "column"),
    [
        ("everything", "too_fast", "speed"),
        ("rates", "jerky", "acceleration"),
        ("ages", "stale_seen", "stands"),
        ("lease", "silent", "stands"),
    ],
)
def test_a_bridge_without_one_of_its_laws_fails(
    left_out: str, fault: str, column: str, tmp_path: Path
) -> None:
    written = tmp_path / "matrix.json"
    done = kit("--bridge", CARELESS, "--json", str(written), "--brain", "velocity", fault,
               CARELESS=left_out)  # fmt: skip
    assert done.returncode == 1, done.stderr + done.stdout
    row: dict[str, Any] = json.loads(written.read_text("utf-8"))["rows"][0]
    assert row["passed"] is False
    assert row["cells"][column]["ok"] is False, row
    assert "FAIL" in done.stdout


def test_a_careful_brain_on_the_careless_rig_passes() -> None:
    done = kit("--bridge", CARELESS, "--brain", "velocity", "silent", CARELESS="nothing")
    assert done.returncode == 0, done.stderr + done.stdout


def test_nothing_to_connect_to_is_said(home: Path) -> None:
    done = kit("--connect", PONS_HOME=str(home))
    assert done.returncode == 2
    assert "no_bridge: no status was heard" in done.stderr


def test_an_interrupt_leaves_nothing() -> None:
    before = set(psutil.pids())
    process = subprocess.Popen(
        [sys.executable, "-m", "pons", "conformance", "silent", "killed"],
        cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert process.stderr is not None
    told = iter(process.stderr.readline, "")
    assert any("PASS" in line or "FAIL" in line for line in told), "a first row"
    children = psutil.Process(process.pid).children(recursive=True)
    assert len(children) >= 3
    process.send_signal(signal.SIGINT)
    assert process.wait(15.0) == 130
    process.stderr.close()
    _, alive = psutil.wait_procs(children, timeout=5.0)
    assert not [child for child in alive if child.pid not in before]
