"""Ticks are recorded by another process, and its troubles never reach the loop."""

from __future__ import annotations

import gc
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from bridge.core import Inbox, LoopFacts, initial, step
from bridge.recorder import (
    BadRecording,
    Frame,
    Gap,
    Header,
    Recorder,
    StateFrame,
    TickFrame,
    config_of,
    read_recording,
)
from bridge.recorder.process import WriterProcess
from bridge.replay import replay
from tests.bridge.ground import ROOT, core_config, run_core, until
from tests.wire.examples import EXAMPLES
from wire import Scan, Stop

CONFIG = core_config()


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


@pytest.fixture
def make(tmp_path: Path) -> Iterator[Callable[..., Recorder]]:
    made: list[Recorder] = []

    def start(**sizes: int) -> Recorder:
        made.append(Recorder(tmp_path, CONFIG, **sizes))
        return made[-1]

    yield start
    for recorder in made:
        if recorder.writer_pid is not None and recorder.ok:
            os.kill(recorder.writer_pid, signal.SIGCONT)
        recorder.close()


def recordings(folder: Path) -> list[Path]:
    return sorted(folder.glob("*.jsonl.gz"))


def frames(folder: Path) -> list[Frame]:
    return [frame for path in recordings(folder) for frame in read_recording(path)]


def test_what_was_recorded_is_read_back_exactly(
    make: Callable[..., Recorder], tmp_path: Path
) -> None:
    recorder = make()
    given: list[tuple[Inbox, float]] = []

    def take(state: object, inbox: Inbox, now_s: float, decision: object) -> None:
        recorder.tick(state, inbox, now_s, decision)  # type: ignore[arg-type]  # run_core's own
        given.append((inbox, now_s))

    run_core(CONFIG, inboxes(50), take)
    assert recorder.close()
    header, state, *ticks = frames(tmp_path)
    assert isinstance(header, Header)
    assert config_of(header) == CONFIG
    assert isinstance(state, StateFrame)
    assert state.state == initial(CONFIG, 100.0)
    assert [(t.inbox, t.now_s) for t in ticks if isinstance(t, TickFrame)] == given


def test_long_runs_have_segments_and_files(
    make: Callable[..., Recorder], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("bridge.recorder.recorder.SEGMENT_TICKS", 10)
    recorder = make(rotate_bytes=1)
    run_core(CONFIG, inboxes(35), recorder.tick)
    assert recorder.close()
    assert len(recordings(tmp_path)) == 4
    reports = [replay(path) for path in recordings(tmp_path)]
    assert [report.ticks for report in reports] == [10, 10, 10, 5]
    assert [report.differing for report in reports] == [0, 0, 0, 0]


def test_a_frozen_writer_costs_counted_ticks_and_the_record_goes_on(
    make: Callable[..., Recorder], tmp_path: Path
) -> None:
    recorder = make(pipe_bytes=65_536)
    assert until(lambda: recorder.ok)
    assert recorder.writer_pid is not None
    os.kill(recorder.writer_pid, signal.SIGSTOP)
    state = run_core(CONFIG, inboxes(400), recorder.tick)
    lost = recorder.gaps
    assert 0 < lost < 400
    assert not recorder.ok
    os.kill(recorder.writer_pid, signal.SIGCONT)
    now_s = state.now_s

    def taken() -> bool:
        nonlocal state, now_s
        now_s += CONFIG.period_s
        decision = step(CONFIG, state, Inbox(), now_s)
        recorder.tick(state, Inbox(), now_s, decision)
        state = decision.state
        return recorder.ok

    assert until(taken)
    assert recorder.close()
    (path,) = recordings(tmp_path)
    gaps = [frame for frame in read_recording(path) if isinstance(frame, Gap)]
    assert sum(gap.ticks for gap in gaps) == recorder.gaps >= lost
    report = replay(path)
    assert report.differing == 0
    assert report.gaps == recorder.gaps
    assert report.ticks >= 400 - lost


def test_a_killed_writer_is_seen_and_replaced_only_when_asked(
    make: Callable[..., Recorder], tmp_path: Path
) -> None:
    recorder = make()
    run_core(CONFIG, inboxes(20), recorder.tick)
    first = recorder.writer_pid
    assert first is not None
    assert until(lambda: bool(recordings(tmp_path)))
    os.kill(first, signal.SIGKILL)
    assert until(lambda: not recorder.ok)
    run_core(CONFIG, inboxes(20), recorder.tick)
    assert recorder.gaps == 20
    assert recorder.writer_pid == first
    recorder.rest(now_s=1.0)
    assert recorder.writer_pid != first
    run_core(CONFIG, inboxes(5), recorder.tick)
    assert recorder.ok
    assert recorder.close()
    assert replay(recordings(tmp_path)[-1]).ticks == 5
    assert replay(recordings(tmp_path)[-1]).gaps == 20


def test_a_writer_that_cannot_start_is_tried_once_a_second(
    make: Callable[..., Recorder], monkeypatch: pytest.MonkeyPatch
) -> None:
    tries = []

    def fail(*_: object, **__: object) -> WriterProcess:
        tries.append(1)
        raise BlockingIOError(11, "Resource temporarily unavailable")

    monkeypatch.setattr("bridge.recorder.recorder.WriterProcess", fail)
    recorder = make()
    for tick in range(250):
        recorder.rest(10.0 + tick * 0.01)
    assert not recorder.ok
    assert recorder.writer_pid is None
    assert len(tries) == 1 + 3
    assert not recorder.close()


def test_memory_stays_flat_behind_a_dead_writer(make: Callable[..., Recorder]) -> None:
    recorder = make()
    assert recorder.writer_pid is not None
    os.kill(recorder.writer_pid, signal.SIGKILL)
    assert until(lambda: not recorder.ok)
    run_core(CONFIG, inboxes(50), recorder.tick)
    gc.collect()
    before = len(gc.get_objects())
    run_core(CONFIG, inboxes(500), recorder.tick)
    gc.collect()
    assert len(gc.get_objects()) - before < 100


DYING = """
import os, signal, sys
from pathlib import Path
from tests.bridge.ground import core_config, run_core
from bridge.core import EMPTY
from bridge.recorder import Recorder
config = core_config()
recorder = Recorder(Path(sys.argv[1]), config)
run_core(config, [EMPTY] * 304, recorder.tick)
os.kill(os.getpid(), signal.SIGKILL)
"""


def test_what_is_not_yet_handed_over_goes_out_at_the_end(
    make: Callable[..., Recorder], tmp_path: Path
) -> None:
    recorder = make()
    run_core(CONFIG, inboxes(3), recorder.tick)
    assert recorder.close()
    assert replay(recordings(tmp_path)[0]).ticks == 3


def test_what_a_dead_writer_did_not_take_is_counted_to_the_last_tick(
    make: Callable[..., Recorder],
) -> None:
    recorder = make()
    assert recorder.writer_pid is not None
    os.kill(recorder.writer_pid, signal.SIGKILL)
    assert until(lambda: not recorder.ok)
    run_core(CONFIG, inboxes(13), recorder.tick)
    recorder.close()
    assert recorder.gaps == 13


def test_a_killed_bridge_leaves_everything_it_handed_over(tmp_path: Path) -> None:
    done = subprocess.run([sys.executable, "-c", DYING, str(tmp_path)], cwd=ROOT, check=False)
    assert done.returncode == -signal.SIGKILL

    def whole() -> bool:
        """Four of 304 were not handed over: five go at a time."""
        try:
            return sum(isinstance(frame, TickFrame) for frame in frames(tmp_path)) == 300
        except BadRecording:
            return False

    assert until(whole)
