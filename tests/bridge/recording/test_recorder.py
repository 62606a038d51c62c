"""Ticks are recorded by another process, and its troubles never reach the loop."""

from __future__ import annotations

import gc
import itertools
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

import pytest

from bridge.core import BridgeState, Decision, Inbox, LoopFacts, initial, step
from bridge.recording.__main__ import NICE
from bridge.recording.recorder import Recorder
from bridge.recording.recording_reader import (
    BadRecording,
    Frame,
    Header,
    StateFrame,
    TickFrame,
    config_of,
    read_recording,
)
from bridge.recording.writer_process import Sizes, WriterProcess
from bridge.replay import replay
from tests.bridge.ground import ROOT, core_config, run_core
from tests.processes.nice_values import leads_its_session, stand_of
from tests.waiting import until
from tests.wire.examples import EXAMPLES
from wire import Scan, Stop

pytestmark = pytest.mark.nightly(keep=6)


CONFIG = core_config()
SOON_S = 0.1
"""For who need not wait until a dead writer is replaced; one test holds how long that takes."""


def inboxes(count: int) -> list[Inbox]:
    scan, stop = EXAMPLES[Scan], EXAMPLES[Stop]
    assert isinstance(scan, Scan)
    assert isinstance(stop, Stop)
    return [
        Inbox(
            stops=(stop,) if number == 3 else (),
            scan=scan if number % 10 == 0 else None,
            loop=LoopFacts(late_s=number / 7),
        )
        for number in range(count)
    ]


class Driver:
    """Turn the core and record it, ten ticks a turn, as long as a test likes."""

    def __init__(self, recorder: Recorder) -> None:
        self.recorder = recorder
        self.state: BridgeState = initial(CONFIG, 100.0)
        self.ticks = 0

    def turn(self, count: int = 10) -> None:
        for _ in range(count):
            now_s = self.state.now_s + CONFIG.period_s
            decision = step(CONFIG, self.state, Inbox(), now_s)
            self.recorder.tick(self.state, Inbox(), now_s, decision)
            self.state = decision.state
            self.ticks += 1

    def wait(self, count: int) -> None:
        """Hand the same tick over again and again, as time goes on, where nobody takes it."""
        decision = step(CONFIG, self.state, Inbox(), self.state.now_s + CONFIG.period_s)
        for _ in range(count):
            self.ticks += 1
            now_s = 100.0 + self.ticks * CONFIG.period_s
            self.recorder.tick(self.state, Inbox(), now_s, decision)

    def until(self, done: Callable[[], bool]) -> bool:
        """Turn at about real pace: health is judged by the loop's own time."""

        def once() -> bool:
            self.turn(1)
            return done()

        return until(once)


@pytest.fixture
def make(tmp_path: Path) -> Iterator[Callable[..., Recorder]]:
    made: list[Recorder] = []

    def start(sizes: Sizes | None = None, **more: int) -> Recorder:
        made.append(Recorder(tmp_path, CONFIG, sizes, **more))
        return made[-1]

    yield start
    for recorder in made:
        if recorder.writer_pid is not None:
            with suppress(ProcessLookupError):
                os.kill(recorder.writer_pid, signal.SIGCONT)
        recorder.close()


def recordings(folder: Path) -> list[Path]:
    return sorted(folder.glob("*.mcap"), key=lambda path: path.name.rsplit("-", 1)[1])


def frames(folder: Path) -> list[Frame]:
    return [frame for path in recordings(folder) for frame in read_recording(path)]


def pid_of(recorder: Recorder) -> int:
    assert recorder.writer_pid is not None
    return recorder.writer_pid


def kill(recorder: Recorder) -> None:
    """Kill the writer and wait until it is dead, as the kernel sees it."""
    os.kill(pid_of(recorder), signal.SIGKILL)
    os.waitid(os.P_PID, pid_of(recorder), os.WEXITED | os.WNOWAIT)


def test_what_was_recorded_is_read_back_exactly(
    make: Callable[..., Recorder], tmp_path: Path
) -> None:
    recorder = make()
    given: list[tuple[Inbox, float]] = []

    def take(state: BridgeState, inbox: Inbox, now_s: float, decision: Decision) -> None:
        recorder.tick(state, inbox, now_s, decision)
        given.append((inbox, now_s))

    run_core(CONFIG, inboxes(50), take)
    assert recorder.close()
    header, state, *ticks = frames(tmp_path)
    assert isinstance(header, Header)
    assert config_of(header) == CONFIG
    assert isinstance(state, StateFrame)
    assert state.state == initial(CONFIG, 100.0)
    assert [(t.inbox, t.now_s) for t in ticks if isinstance(t, TickFrame)] == given


def test_it_is_down_until_the_writer_has_spoken_and_then_fine(
    make: Callable[..., Recorder],
) -> None:
    recorder = make()
    assert recorder.trouble == "recorder_down: the writing process begins a file"
    driver = Driver(recorder)
    assert driver.until(lambda: recorder.trouble == "")


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_the_writer_stands_behind_the_bridge_and_does_not_outlive_it(
    make: Callable[..., Recorder],
) -> None:
    recorder = make()
    driver = Driver(recorder)
    assert driver.until(lambda: not recorder.trouble)
    pid = pid_of(recorder)
    assert leads_its_session(pid)
    assert stand_of(pid) == stand_of(os.getpid()).behind(NICE)
    os.kill(pid, signal.SIGSTOP)
    assert recorder._writer is not None
    assert not recorder._writer.join(0.0)
    assert os.waitpid(pid, 0) == (pid, signal.SIGKILL)


def test_a_full_file_is_followed_by_another_that_replays_alone(
    make: Callable[..., Recorder], tmp_path: Path
) -> None:
    recorder = make(Sizes(rotate_bytes=20_000, cap_bytes=1 << 30))
    driver = Driver(recorder)
    assert driver.until(lambda: len(recordings(tmp_path)) >= 3)
    assert recorder.close()
    files = recordings(tmp_path)
    assert [replay([path]).differing for path in files] == [0] * len(files)
    whole = replay(files)
    assert (whole.ticks, whole.differing, whole.gaps) == (driver.ticks, 0, 0)


def test_a_frozen_writer_costs_counted_ticks_and_the_record_goes_on(
    make: Callable[..., Recorder], tmp_path: Path
) -> None:
    recorder = make(pipe_bytes=65_536)
    driver = Driver(recorder)
    assert driver.until(lambda: not recorder.trouble)
    until(lambda: recorder._pipe.waiting_bytes() == 0)  # a busy writer is behind
    os.kill(pid_of(recorder), signal.SIGSTOP)
    driver.turn(400)
    lost = recorder.gaps
    assert 0 < lost < 400
    assert "ticks are missing" in recorder.trouble
    driver.turn(300)
    assert "silent" in recorder.trouble
    os.kill(pid_of(recorder), signal.SIGCONT)
    assert driver.until(lambda: not recorder.trouble)
    assert recorder.close()
    report = replay(recordings(tmp_path))
    assert report.differing == 0
    assert report.gaps == recorder.gaps >= lost
    assert report.ticks + report.gaps == driver.ticks


def test_a_killed_writer_is_said_and_replaced_also_while_driving(
    make: Callable[..., Recorder], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("bridge.recording.recorder.REVIVE_FIRST_S", SOON_S)
    recorder = make()
    driver = Driver(recorder)
    assert driver.until(lambda: not recorder.trouble)
    first = pid_of(recorder)
    os.kill(first, signal.SIGKILL)
    assert driver.until(lambda: bool(recorder.trouble))
    assert recorder.trouble == "recorder_down: the writing process has died"
    assert driver.until(lambda: not recorder.trouble)
    assert pid_of(recorder) != first
    assert recorder.gaps > 0
    driver.turn(10)
    assert recorder.close()
    report = replay(recordings(tmp_path))
    assert report.differing == 0
    assert report.gaps >= recorder.gaps, "what the dead one had taken and not written counts too"


def test_a_writer_that_dies_at_once_is_replaced_ever_more_slowly(
    make: Callable[..., Recorder], monkeypatch: pytest.MonkeyPatch
) -> None:
    tries: list[int] = []

    def fail(*_: object, **__: object) -> WriterProcess:
        tries.append(driver.ticks)
        raise BlockingIOError(11, "Resource temporarily unavailable")

    recorder = make()
    driver = Driver(recorder)
    kill(recorder)
    monkeypatch.setattr("bridge.recording.recorder.WriterProcess", fail)
    driver.wait(10_000)
    assert recorder.writer_pid is None
    apart_s = [(b - a) / 100 for a, b in itertools.pairwise(tries)]
    assert apart_s == pytest.approx([2.0, 4.0, 8.0, 16.0, 30.0, 30.0][: len(apart_s)], abs=0.5)
    assert len(apart_s) >= 5
    assert recorder.gaps == 10_000


def test_memory_stays_flat_behind_a_dead_writer(
    make: Callable[..., Recorder], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("bridge.recording.recorder.REVIVE_FIRST_S", 1e6)
    recorder = make()
    kill(recorder)
    run_core(CONFIG, inboxes(50), recorder.tick)
    gc.collect()
    before = len(gc.get_objects())
    run_core(CONFIG, inboxes(500), recorder.tick)
    gc.collect()
    assert len(gc.get_objects()) - before < 100


def test_what_is_not_yet_handed_over_goes_out_at_the_end(
    make: Callable[..., Recorder], tmp_path: Path
) -> None:
    recorder = make()
    run_core(CONFIG, inboxes(3), recorder.tick)
    assert recorder.close()
    assert replay(recordings(tmp_path)).ticks == 3


def test_what_a_dead_writer_did_not_take_is_counted_to_the_last_tick(
    make: Callable[..., Recorder],
) -> None:
    recorder = make()
    kill(recorder)
    run_core(CONFIG, inboxes(13), recorder.tick)
    recorder.close()
    assert recorder.gaps == 13


DYING = """
import os, signal, sys
from pathlib import Path
from tests.bridge.ground import core_config, run_core
from bridge.core import EMPTY
from bridge.recording.recorder import Recorder
config = core_config()
recorder = Recorder(Path(sys.argv[1]), config)
run_core(config, [EMPTY] * 304, recorder.tick)
os.kill(os.getpid(), signal.SIGKILL)
"""


def test_a_killed_bridge_leaves_everything_it_handed_over(tmp_path: Path) -> None:
    done = subprocess.run([sys.executable, "-c", DYING, str(tmp_path)], cwd=ROOT, check=False)
    assert done.returncode == -signal.SIGKILL

    def whole() -> bool:
        """Four of 304 were not handed over: twenty go at a time."""
        try:
            return sum(isinstance(frame, TickFrame) for frame in frames(tmp_path)) == 300
        except BadRecording:
            return False

    until(whole)


ALL_KILLED = """
import os, signal, sys, time
from pathlib import Path
from tests.bridge.recording.test_recorder import CONFIG, Driver
from bridge.recording.recorder import Recorder
recorder = Recorder(Path(sys.argv[1]), CONFIG)
driver = Driver(recorder)
driver.until(lambda: not recorder.trouble)
for _ in range(150):
    driver.turn(1)
    time.sleep(0.01)
print(driver.ticks, flush=True)
os.kill(recorder.writer_pid, signal.SIGKILL)
os.kill(os.getpid(), signal.SIGKILL)
"""


def test_with_all_killed_at_once_all_but_the_last_second_is_there(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-c", ALL_KILLED, str(tmp_path)],
        cwd=ROOT, check=False, capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == -signal.SIGKILL, done.stderr
    report = replay(recordings(tmp_path))
    assert (report.differing, report.gaps) == (0, 0)
    assert int(done.stdout) - 100 <= report.ticks <= int(done.stdout)


@pytest.mark.parametrize(
    ("module", "foreign"),
    [
        ("bridge.__main__", ("mcap", "zstandard", "lz4")),
        ("bridge.recording.__main__", ("pydantic", "wire", "bridge.core", "zenoh")),
    ],
)
def test_loop_and_writing_process_load_nothing_of_each_other(
    module: str, foreign: tuple[str, ...]
) -> None:
    code = f"import sys, {module}; sys.exit(any(name in sys.modules for name in {foreign!r}))"
    assert subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=False).returncode == 0
