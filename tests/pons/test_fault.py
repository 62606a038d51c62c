"""Break the simulator's real process by the command, as a person in a second shell does."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from pons import fault
from pons.__main__ import main
from tests.known import known
from wire import SimTruth
from wire.keys import SIM_TRUTH, Party
from wire.session import open_session

LIMIT_S = 20.0


def command(repository: Path, home: Path, *words: str) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "pons", "fault", *words],
        cwd=repository,
        env={**os.environ, "PONS_HOME": str(home)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def ask(repository: Path, home: Path, *words: str) -> tuple[int, str]:
    process = command(repository, home, *words)
    out, err = process.communicate(timeout=LIMIT_S)
    return process.returncode, out + err


@pytest.fixture
def sim(repository: Path, tmp_path: Path) -> Iterator[subprocess.Popen[bytes]]:
    words = [sys.executable, "-m", "sim", "--site", "sites/two_room", "--home", str(tmp_path)]
    process = subprocess.Popen(words, cwd=repository, stderr=subprocess.DEVNULL)
    yield process
    process.kill()
    process.wait(LIMIT_S)


def until(done: Callable[[], bool]) -> None:
    end_s = time.monotonic() + LIMIT_S
    while not done():
        assert time.monotonic() < end_s
        time.sleep(0.01)


@pytest.fixture
def nowhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the command look for a simulator where there is none."""
    monkeypatch.setenv("PONS_HOME", str(tmp_path))


@pytest.mark.usefixtures("nowhere")
def test_an_unknown_fault_is_answered_with_those_that_exist(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["fault", "lidar_of"]) == 2
    said = capsys.readouterr().err
    assert "fault_unknown: lidar_of" in said
    assert "lidar_off" in said


@pytest.mark.usefixtures("nowhere")
@pytest.mark.parametrize("seconds", ["0", "-1", "nan", "inf", "soon"])
def test_a_time_that_is_none_is_refused(capsys: pytest.CaptureFixture[str], seconds: str) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["fault", "slip", f"--for={seconds}"])
    assert ended.value.code == 2
    assert f"{seconds!r}; expected" in capsys.readouterr().err


@pytest.mark.usefixtures("nowhere")
def test_without_a_simulator_it_says_so(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(fault, "LIMIT_S", 0.1)
    assert main(["fault", "slip"]) == 1
    assert capsys.readouterr().err.split(":")[0] == "no_simulator"


@pytest.mark.nightly
@pytest.mark.e2e
def test_faults_stand_until_mended_and_ctrl_c_mends_them(
    repository: Path, tmp_path: Path, sim: subprocess.Popen[bytes]
) -> None:
    with open_session(Party.JUDGE, "r1", tmp_path) as session:
        truths = session.subscriber(SIM_TRUTH)
        newest: list[SimTruth] = []

        def broken(*names: str) -> bool:
            truth = truths.newest()
            newest[:] = [truth] if truth is not None else newest
            return bool(newest) and set(newest[0].faults) == set(names)

        until(broken)
        assert ask(repository, tmp_path, "lidar_off", "slip") == (0, "broken: lidar_off, slip\n")
        until(lambda: broken("lidar_off", "slip"))
        assert ask(repository, tmp_path) == (0, "all is mended\n")
        until(broken)
        process = command(repository, tmp_path, "cliff", "--for", "30")
        until(lambda: broken("cliff"))
        assert known(process.stdout).readline() == "broken: cliff\n"
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=LIMIT_S)
        assert (process.returncode, out) == (0, "all is mended\n")
        until(broken)
    assert sim.poll() is None
