"""The conformance kit passes our bridge. Told alone: its flood takes what a second robot needs.

The kit's own verdict is its exit status and its JSON.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.e2e.conformance_kit import run_kit

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(450)]


def test_our_bridge_passes_the_short_run(tmp_path: Path) -> None:
    written = tmp_path / "matrix.json"
    done = run_kit("--quick", "--json", str(written))
    assert done.returncode == 0, done.stderr + done.stdout
    told = json.loads(written.read_text("utf-8"))
    assert told["passed"] is True
    assert {row["brain"] for row in told["rows"]} == {"velocity", "waypoints"}
    assert len(told["rows"]) >= 10
    assert "0 failed: PASS" in done.stdout
