"""Hold that the rig of ``pons up`` finds its processes, says why it ended, and leaves nothing."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest

from pons.robot_processes import ProcessGone
from tests.e2e.pons_up import PonsUp

LIMIT_S = 20.0
SLEEPS = [sys.executable, "-c", "import time; time.sleep(60)"]


@pytest.fixture
def rig(tmp_path: Path) -> Iterator[PonsUp]:
    rig = PonsUp(tmp_path / "home", tmp_path / "no_site", tmp_path / "up.log", PONS_TLS="1")
    yield rig
    rig.destroy()


def sleeper(home: Path) -> subprocess.Popen[bytes]:
    return subprocess.Popen(SLEEPS, env={**os.environ, "PONS_HOME": str(home)})


def test_what_was_started_for_a_home_is_found_and_ended_and_nothing_else(
    rig: PonsUp, tmp_path: Path
) -> None:
    ours, others = sleeper(rig.home), sleeper(tmp_path / "another")
    try:
        assert [one.pid for one in rig.processes()] == [ours.pid]
        rig.destroy()
        assert ours.wait(LIMIT_S) == -signal.SIGKILL
        assert rig.processes() == []
        assert others.poll() is None
    finally:
        for process in (ours, others):
            process.kill()
            process.wait()


def test_an_end_before_the_greeting_is_told_in_its_own_words(rig: PonsUp) -> None:
    with pytest.raises(ProcessGone):
        rig.has_greeted()
    rig.launch()
    assert rig.up is not None
    assert rig.tree() == [psutil.Process(rig.up.pid), *rig.tree()[1:]]
    rig.up.wait(LIMIT_S)
    with pytest.raises(ProcessGone, match="no_site"):
        rig.has_greeted()
    assert "no_site" in "\n".join(rig.tails(5)["up"])


def test_it_has_greeted_once_its_own_url_stands_in_the_log(rig: PonsUp) -> None:
    rig.up = sleeper(rig.home)
    assert not rig.has_greeted()
    rig.log.write_text(f"at http://127.0.0.1:{rig.port}\n")
    assert not rig.has_greeted(), "it speaks TLS"
    rig.log.write_text(f"at https://127.0.0.1:{rig.port}\n")
    assert rig.has_greeted()
    rig.end_by(signal.SIGTERM, LIMIT_S)
    assert rig.up is None
    assert rig.tree() == []
    rig.end_by(signal.SIGTERM, LIMIT_S)  # once more changes nothing


def test_logs_that_are_old_are_left_out(rig: PonsUp) -> None:
    logs = rig.home / "logs"
    logs.mkdir(parents=True)
    for name, age_s in (("bridge", 0.0), ("planner", 900.0)):
        (logs / f"{name}.log").write_text("one\ntwo\nthree\n")
        at_s = time.time() - age_s
        os.utime(logs / f"{name}.log", (at_s, at_s))
    assert rig.tails(2) == {"bridge": ["two", "three"], "planner": ["two", "three"]}
    assert rig.tails(2, time.time() - 60.0) == {"bridge": ["two", "three"]}
