"""The conformance kit fails a bridge without one of its laws, and leaves nothing behind.

What it says of such a bridge shows that it would notice. Where the machine keeps no time beside
other stories it waits and plays a row again.
"""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import psutil
import pytest

from tests.e2e.conformance_kit import CARELESS, assert_found_careless, run_kit
from tests.e2e.system import ROOT

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(450)]


@pytest.mark.parametrize(
    ("left_out", "fault", "column"),
    [
        ("rates", "jerky", "acceleration"),
        ("ages", "stale_seen", "stands"),
        ("lease", "silent", "stands"),
    ],
)
def test_a_bridge_without_one_of_its_laws_fails(
    left_out: str, fault: str, column: str, tmp_path: Path
) -> None:
    assert_found_careless(left_out, fault, column, tmp_path)


def test_a_careful_brain_on_the_careless_rig_passes() -> None:
    done = run_kit("--bridge", CARELESS, "--brain", "velocity", "silent", CARELESS="nothing")
    assert done.returncode == 0, done.stderr + done.stdout


def test_nothing_to_connect_to_is_said(home: Path) -> None:
    done = run_kit("--connect", PONS_HOME=str(home))
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
