"""Make recordings for tests as the bridge does, without a process: frames, writer, file."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from bridge.core import BridgeState, CoreConfig, Decision, Inbox
from bridge.recording import foxglove_messages, pipe_frames
from bridge.recording.encode import schema_frame, segment_frames, tick_frames
from bridge.recording.format import core_of, schemas
from bridge.recording.writer import Writer

Taken = tuple[BridgeState, Inbox, float, Decision]
SCHEMAS = schemas()
CORE = core_of(SCHEMAS)
UNIX_S = 1_700_000_000.0


def stream_of(
    config: CoreConfig,
    ticks: Sequence[Taken],
    *,
    segments_at: Iterable[int] = (),
    missing: range = range(0),
) -> bytes:
    """Return what a recorder sends: a segment first, at these places, and after what is missing."""
    out = [schema_frame(SCHEMAS)]
    fresh = {0, missing.stop, *segments_at}
    for number, (state, inbox, now_s, decision) in enumerate(ticks):
        if number in missing:
            continue
        if number in fresh:
            out.append(segment_frames(config, CORE, state))
        tick_frames(out, state, inbox, now_s, decision)
    return b"".join(out)


def cut_short(writer: Writer) -> None:
    """Leave its file as a killed process does."""
    file, writer._file = writer._file, None
    assert file is not None
    file.abandon()


def written(
    folder: Path, stream: bytes, *, boot: str = "boot1", rotate_bytes: int = 64 << 20,
    beat_every: int = 500, closed: bool = True,
) -> list[Path]:  # fmt: skip
    """Write a stream as the writing process would; return the files, oldest first."""
    before = set(folder.glob("*.mcap"))
    writer = Writer(folder, boot, rotate_bytes, 1 << 40, foxglove_messages.UnixClock(UNIX_S))
    for number, (kind, payload) in enumerate(pipe_frames.Splitter().feed(stream)):
        writer.take(kind, payload, UNIX_S)
        if number % beat_every == beat_every - 1:
            writer.beat()
    writer.beat()
    if closed:
        writer.close()
    else:
        cut_short(writer)
    return sorted(set(folder.glob("*.mcap")) - before)
