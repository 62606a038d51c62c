"""What viewers are shown may be missing, the record never; words say how the disk is."""

from __future__ import annotations

import json
from pathlib import Path

import psutil
import pytest

from bridge.recording import foxglove_messages, pipe_frames
from bridge.recording import writer as writer_module
from bridge.recording.__main__ import ThinnerStart
from bridge.recording.mcap_reader import McapReader
from bridge.recording.pipe_frames import BadFrame, Splitter, frame
from bridge.recording.writer import Writer
from tests.bridge.core.scripted import World
from tests.bridge.recorded import SCHEMAS, UNIX_S, stream_of
from tests.bridge.test_replay import taken


def make(folder: Path, rotate_bytes: int = 1 << 20) -> Writer:
    return Writer(folder, "b1", rotate_bytes, 1 << 40, foxglove_messages.UnixClock(UNIX_S))


def feed(writer: Writer, stream: bytes) -> None:
    for kind, payload in Splitter().feed(stream):
        writer.take(kind, payload, UNIX_S)


def stream() -> bytes:
    world = World(keep=True)
    world.run(0.5)
    return stream_of(world.core, taken(world))


def test_words_follow_the_file(tmp_path: Path) -> None:
    writer = make(tmp_path, rotate_bytes=20_000)
    assert writer.beat() == b"N\n", "no file yet"
    data = stream()
    feed(writer, data)
    assert writer.beat() in {b"W\n", b"R\n"}
    for _ in range(20):
        ticks = [
            f for f in Splitter().feed(data) if f[0] not in {pipe_frames.BOOT, pipe_frames.STATE}
        ]
        for kind, payload in ticks:
            writer.take(kind, payload, UNIX_S)
    assert writer.beat() == b"R\n", "full: a segment is wanted"
    assert len(list(tmp_path.iterdir())) == 1, "but none is torn apart"
    feed(writer, data)
    assert len(list(tmp_path.iterdir())) == 2
    writer.close()


def test_nothing_is_written_before_a_segment(tmp_path: Path) -> None:
    writer = make(tmp_path)
    for kind, payload in Splitter().feed(stream()):
        if kind != pipe_frames.BOOT:
            writer.take(kind, payload, UNIX_S)
    assert writer.beat() == b"N\n"
    writer.close()
    assert list(tmp_path.iterdir()) == []


def test_what_no_viewer_can_be_shown_is_recorded_all_the_same(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    writer = make(tmp_path)
    odd = json.dumps({"of": "another shape"}).encode()
    head = [frame(pipe_frames.SCHEMAS, json.dumps(SCHEMAS).encode()),
            frame(pipe_frames.TICK, pipe_frames.TICK_OF.pack(7, 1.0)),
             frame(pipe_frames.BOOT, odd)]  # fmt: skip
    kinds = (pipe_frames.STATUS, pipe_frames.ODOMETRY, pipe_frames.EVENT, pipe_frames.ODOMETRY)
    feed(writer, b"".join([*head, *(frame(kind, odd) for kind in kinds)]))
    writer.close()
    (path,) = tmp_path.iterdir()
    with McapReader(path) as box:
        got = [(raw.topic, raw.sequence, raw.data) for raw in box.messages()]
    names = ["boot", "status", "odometry", "event", "odometry"]
    assert got == [(f"/pons/{name}", 7, odd) for name in names]
    assert caplog.text.count("recorder_unsaid") == 4, "once each"


def test_a_disk_that_is_nearly_full_is_said_and_looked_at_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    writer = make(tmp_path)
    monkeypatch.setattr(writer_module, "free_bytes", lambda _: 1 << 20)
    data = stream()
    feed(writer, data)
    assert writer.beat().startswith(b"Fdisk_full: disk full, 1024 KiB free")
    assert writer.beat().startswith(b"Fdisk_full")
    monkeypatch.undo()
    assert writer.beat().startswith(b"F"), "what was true when it failed"
    assert writer.beat() == b"N\n"
    feed(writer, data)
    assert writer.beat() == b"W\n"
    writer.close()


def test_a_stream_out_of_step_is_refused_and_half_a_frame_waits() -> None:
    splitter = Splitter()
    data = frame(pipe_frames.EVENT, b"12345")
    assert list(splitter.feed(data[:7])) == []
    assert list(splitter.feed(data[7:] + data[:3])) == [(pipe_frames.EVENT, b"12345")]
    assert list(splitter.feed(data[3:])) == [(pipe_frames.EVENT, b"12345")]
    with pytest.raises(BadFrame):
        list(splitter.feed(b"?" + bytes(20)))
    with pytest.raises(BadFrame):
        list(splitter.feed(pipe_frames.EVENT + b"\xff" * 8))


def test_a_word_is_one_short_line() -> None:
    said = pipe_frames.word(pipe_frames.FAILING, "disk_full: two\nlines " + "x" * 1000)
    assert said.count(b"\n") == 1
    assert len(said) <= pipe_frames.WORD_MOST + 2


def test_a_thinner_that_is_ended_is_gone_at_once(tmp_path: Path) -> None:
    thinner = ThinnerStart([str(tmp_path), "b1", "9000000", "20000"])
    thinner.end()  # none was begun
    thinner.start()
    (process,) = psutil.Process().children()
    thinner.end()
    assert not process.is_running()
