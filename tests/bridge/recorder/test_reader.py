"""A recording is read as far as it goes, and what is none is refused by name."""

from __future__ import annotations

import gzip
from pathlib import Path

import pytest

from bridge.core import EMPTY, BridgeState, Decision, Inbox
from bridge.recorder import BadRecording, Frame, read_recording
from bridge.recorder.format import TickFrame, segment_lines, tick_line
from tests.bridge.ground import core_config, run_core

CONFIG = core_config()


def packed(lines: bytes) -> bytes:
    """Return the same bytes whenever it is asked: test ids are made of them."""
    return gzip.compress(lines, mtime=0)


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    lines: list[bytes] = []

    def take(state: BridgeState, inbox: Inbox, now_s: float, decision: Decision) -> None:
        if not lines:
            lines.append(segment_lines(CONFIG, 0, state))
        frame = TickFrame(
            tick=state.tick, now_s=now_s, inbox=inbox, command=decision.command,
            mode=decision.state.mode, reasons=decision.reasons,
        )  # fmt: skip
        lines.append(tick_line(frame))

    run_core(CONFIG, [EMPTY] * 40, take)
    path = tmp_path_factory.mktemp("r") / "r.jsonl.gz"
    path.write_bytes(packed(b"".join(lines)))
    return path


def prefix(path: Path) -> list[Frame]:
    return list(read_recording(path))


def test_a_file_cut_anywhere_gives_its_whole_lines(recording: Path, tmp_path: Path) -> None:
    whole, data = prefix(recording), recording.read_bytes()
    assert len(whole) == 42
    cut = tmp_path / "cut"
    lengths = []
    for size in range(20, len(data), len(data) // 25):
        cut.write_bytes(data[:size])
        got = prefix(cut)
        assert got == whole[: len(got)]
        lengths.append(len(got))
    assert lengths == sorted(lengths)
    assert lengths[-1] > 2


@pytest.mark.parametrize(
    ("content", "code"),
    [
        (b"plain text", "recording_not_gzip"),
        (packed(b"not json\n"), "recording_invalid"),
        (packed(b'{"kind":"tick"}\n'), "recording_invalid"),
        (packed(b'{"kind":"gap","ticks":3}\n'), "recording_headless"),
        (packed(b'{"kind":"header","version":2,"config":{}}\n'), "recording_invalid"),
    ],
)
def test_what_is_no_recording_is_refused(content: bytes, code: str, tmp_path: Path) -> None:
    path = tmp_path / "bad"
    path.write_bytes(content)
    with pytest.raises(BadRecording) as refused:
        prefix(path)
    assert refused.value.code == code
    assert str(path) in refused.value.detail


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(BadRecording, match=r"recording_missing: .*gone"):
        prefix(tmp_path / "gone")


def test_a_line_without_end_does_not_fill_the_memory(tmp_path: Path) -> None:
    path = tmp_path / "long"
    path.write_bytes(packed(b"x" * (5 << 20)))
    with pytest.raises(BadRecording, match="exceeds"):
        prefix(path)
