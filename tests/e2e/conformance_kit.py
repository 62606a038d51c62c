"""Run the conformance kit as a person does, in a process of its own."""

from __future__ import annotations

import os
import subprocess
import sys

from tests.e2e.system import ROOT

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
