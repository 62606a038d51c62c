"""The simulator as a real process: it speaks, obeys, stops by itself and ends cleanly."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from sim.__main__ import main
from tests.known import known
from wire import DriveCommand, DriveState, Pose2, SimControl, SimTruth, distance, keys
from wire.keys import Party
from wire.session import Session, open_session

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=1)]
LIMIT_S = 20.0


def simulator(repository: Path, home: Path, *more: str) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "sim", "--site", "sites/two_room", "--home", str(home), *more]
    return subprocess.Popen(command, cwd=repository, stderr=subprocess.PIPE, text=True)


@pytest.fixture
def sim(repository: Path, tmp_path: Path) -> Iterator[subprocess.Popen[str]]:
    process = simulator(repository, tmp_path)
    yield process
    if process.poll() is None:
        process.send_signal(signal.SIGCONT)
        process.kill()
    process.communicate(timeout=LIMIT_S)


class Bench:
    """Be the bridge and the judge of one simulator."""

    def __init__(self, bridge: Session, judge: Session) -> None:
        self._commands = bridge.publisher(keys.DRIVE_COMMAND)
        self._states = bridge.subscriber(keys.DRIVE_STATE)
        self._scans = bridge.subscriber(keys.SCAN)
        self._imus = bridge.subscriber(keys.IMU)
        self._truths = judge.subscriber(keys.SIM_TRUTH)
        self._controls = judge.publisher(keys.SIM_CONTROL)
        self.seq = 0
        self.heard: set[str] = set()
        self.slowest_factor = 1.0
        self._state: DriveState | None = None
        self._truth: SimTruth | None = None

    @property
    def state(self) -> DriveState:
        return known(self._state)

    @property
    def truth(self) -> SimTruth:
        return known(self._truth)

    def hears(self) -> bool:
        return self._state is not None and self._truth is not None

    def until(self, done: Callable[[], bool], *, drive: float | None = None) -> None:
        """Listen, and drive at a wheel speed if given, until done."""
        end_s = time.monotonic() + LIMIT_S
        while not done():
            assert time.monotonic() < end_s, f"nothing came of it; heard {self.heard}"
            if drive is not None:
                self.seq += 1
                self._commands.put(
                    DriveCommand(
                        boot="b", seq=self.seq, left_radps=drive, right_radps=drive, enable=True
                    )
                )
            self._listen()
            time.sleep(0.01)

    def _listen(self) -> None:
        self._state = self._states.newest() or self._state
        self._truth = self._truths.newest() or self._truth
        if self._truth is not None:
            self.slowest_factor = min(self.slowest_factor, self._truth.real_time_factor)
        for name, subscriber in (("scan", self._scans), ("imu", self._imus)):
            if subscriber.newest() is not None:
                self.heard.add(name)

    def place(self, pose: Pose2) -> None:
        self._controls.put(SimControl(id="t1", place_robot=pose))

    def moved(self, metres: float) -> bool:
        return distance(self.truth.base_in_map, Pose2(0.9, 0.8, 0.0)) > metres


@pytest.fixture
def bench(sim: subprocess.Popen[str], tmp_path: Path) -> Iterator[Bench]:
    with (
        open_session(Party.BRIDGE, "r1", tmp_path) as bridge,
        open_session(Party.JUDGE, "r1", tmp_path) as judge,
    ):
        bench = Bench(bridge, judge)
        bench.until(bench.hears)
        yield bench


def test_it_obeys_stops_in_silence_and_ends_on_sigterm(
    sim: subprocess.Popen[str], bench: Bench
) -> None:
    bench.until(lambda: bench.moved(0.05) and bench.heard == {"scan", "imu"}, drive=2.0)
    assert (bench.state.echo_boot, bench.state.enabled) == ("b", True)
    bench.until(lambda: bench.state.timed_out is True)
    bench.until(lambda: not bench.state.enabled)
    target = Pose2(1.5, 4.2, 1.0)
    bench.place(target)
    bench.until(lambda: distance(bench.truth.base_in_map, target) < 0.01)
    sim.send_signal(signal.SIGTERM)
    assert sim.wait(LIMIT_S) == 0


def test_it_goes_before_others_where_it_may_and_refuses_a_second_simulator(
    sim: subprocess.Popen[str], bench: Bench, repository: Path, tmp_path: Path
) -> None:
    ask = "import os; os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(1))"
    asked = subprocess.run([sys.executable, "-c", ask], stderr=subprocess.DEVNULL, check=False)
    expected = os.SCHED_FIFO if asked.returncode == 0 else os.SCHED_OTHER
    assert os.sched_getscheduler(sim.pid) == expected
    second = simulator(repository, tmp_path)
    _, said = second.communicate(timeout=LIMIT_S)
    assert second.returncode == 2
    assert f"already_running: a robot with pid {sim.pid}" in said
    bench.until(lambda: bench.moved(0.02), drive=2.0)


def test_after_a_freeze_it_skips_and_obeys_nothing_from_before(
    sim: subprocess.Popen[str], bench: Bench
) -> None:
    bench.until(lambda: bench.moved(0.05), drive=2.0)
    before = bench.state
    os.kill(sim.pid, signal.SIGSTOP)
    newest_before, frozen_s = bench.seq, time.monotonic()
    bench.until(lambda: time.monotonic() > frozen_s + 0.6, drive=2.0)
    os.kill(sim.pid, signal.SIGCONT)
    bench.until(lambda: bench.state.stamp_s > before.stamp_s + 1.2)
    assert bench.state.echo_seq <= newest_before
    assert (bench.state.timed_out, bench.state.enabled) == (True, False)
    ticks_s = (bench.state.seq - before.seq) * 0.01
    assert ticks_s < bench.state.stamp_s - before.stamp_s - 0.4, "time was skipped"
    assert bench.slowest_factor < 0.9
    bench.until(lambda: bench.state.enabled, drive=1.0)


@pytest.mark.usefixtures("signals_kept")
def test_a_missing_site_is_refused_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["--site", "sites/nowhere", "--home", str(tmp_path)]) == 2
    said = capsys.readouterr().err
    assert said.startswith("sim: home_missing: ")
    assert said.count("\n") == 1
