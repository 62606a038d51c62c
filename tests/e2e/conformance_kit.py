"""Run the conformance kit as a person does, in a process of its own."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from tests.e2e.system import ROOT

CARELESS = "tests.pons.conformance.careless"
LIMIT_S = 420.0
"""A short run takes under a minute; on a machine that keeps no time the kit waits for calm and
plays rows again, for three minutes and what is then under way."""


def run_kit(*words: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run ``pons conformance`` with these words."""
    return subprocess.run(
        [sys.executable, "-m", "pons", "conformance", *words],
        cwd=ROOT,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
        timeout=LIMIT_S,
    )


def assert_found_careless(left_out: str, fault: str, column: str, folder: Path) -> None:
    """Hold that the kit fails a bridge without one of its laws, in the column that it is for."""
    written = folder / "matrix.json"
    done = run_kit("--bridge", CARELESS, "--json", str(written), "--brain", "velocity", fault,
                   CARELESS=left_out)  # fmt: skip
    assert done.returncode == 1, done.stderr + done.stdout
    row: dict[str, Any] = json.loads(written.read_text("utf-8"))["rows"][0]
    assert row["passed"] is False
    assert row["cells"][column]["ok"] is False, row
    assert "FAIL" in done.stdout
