"""A brain of a stranger drives through the bridge, and a stop holds it while it goes on asking."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.e2e.judge import Judge
from tests.e2e.polling import until
from tests.e2e.system import ROOT, System

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(150), pytest.mark.nightly]


@pytest.fixture
def without_a_planner(home: Path) -> Iterator[System]:
    """Run the robot as a person who brings a brain of his own."""
    system = System(home)
    system.arguments = ("--no-planner",)
    try:
        system.launch()
        until(lambda: "without a planner" in system.read_log(), 40.0, "ready", system.read_log)
        yield system
        system.end()
    finally:
        system.destroy()


def test_a_strangers_brain_drives_and_a_stop_holds_it(without_a_planner: System) -> None:
    system = without_a_planner
    with Judge(system.home) as judge:
        brain = subprocess.Popen(
            [sys.executable, "examples/external_brain.py", "--home", str(system.home),
             "--v", "0.2", "--w", "0.5", "--seconds", "30"],
            cwd=ROOT, stdout=subprocess.PIPE, text=True,
        )  # fmt: skip
        try:
            judge.until_moving(0.15)
            owner = judge.status.owner
            assert owner is not None
            assert owner.kind == "external"
            done = system.pons("stop")
            assert done.returncode == 0, done.stderr
            judge.until_standing(5.0)
            judge.assert_never_moves(1.0)
            assert judge.status.held is not None, "it goes on asking, and is not obeyed"
            done = system.pons("resume")
            assert done.returncode == 0, done.stderr
            judge.until_moving(0.15)
        finally:
            brain.kill()
            brain.communicate()
        judge.until_standing(5.0)
        judge.assert_no_contact()
