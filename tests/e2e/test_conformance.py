"""The conformance kit passes our bridge, and fails one without laws. Told alone.

A flood takes what a second robot needs; and a bridge that passes everything on to the wheels runs
away from itself where it starts slowly. The kit's own verdict is its exit status and its JSON.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.e2e.conformance_kit import assert_found_careless, run_kit

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


def test_a_bridge_that_passes_everything_on_fails(tmp_path: Path) -> None:
    assert_found_careless("everything", "too_fast", "speed", tmp_path)
