"""The writer cuts files at headers, keeps them under the cap, and loses no whole line."""

from __future__ import annotations

import gzip
import json
import os
from pathlib import Path

import pytest

from bridge.core import initial
from bridge.recorder import writer as writer_file
from bridge.recorder.format import segment_lines
from bridge.recorder.writer import HEADER, Writer, main, prune
from tests.bridge.ground import core_config

HEAD = HEADER + b',"n":%d}\n'


def files(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def text(path: Path) -> bytes:
    with gzip.open(path) as file:
        return file.read()


def noise(size: int) -> bytes:
    return os.urandom(size).hex().encode() + b"\n"


def test_its_header_is_the_formats_own() -> None:
    config = core_config()
    assert segment_lines(config, 0, initial(config, 1.0)).startswith(HEADER)


def test_lines_are_joined_across_reads_and_half_a_line_is_left_out(tmp_path: Path) -> None:
    writer = Writer(tmp_path, "b", rotate_bytes=1 << 20, cap_bytes=1 << 30)
    stream = HEAD % 1 + b'{"a":1}\n{"b":2}\n{"half":'
    for start in range(0, len(stream), 3):
        writer.feed(stream[start : start + 3])
    writer.close()
    assert text(tmp_path / "b-000.jsonl.gz") == HEAD % 1 + b'{"a":1}\n{"b":2}\n'


def test_nothing_is_written_before_a_header(tmp_path: Path) -> None:
    writer = Writer(tmp_path, "b", rotate_bytes=1 << 20, cap_bytes=1 << 30)
    writer.feed(b'{"a":1}\n')
    writer.close()
    assert files(tmp_path) == []


def test_a_full_file_ends_at_the_next_header_only(tmp_path: Path) -> None:
    writer = Writer(tmp_path, "b", rotate_bytes=1_000, cap_bytes=1 << 30)
    long = noise(4_000)
    writer.feed(HEAD % 1 + long)
    writer.flush()
    writer.feed(b'{"still":"here"}\n' + HEAD % 2 + b'{"a":1}\n')
    writer.close()
    assert files(tmp_path) == ["b-000.jsonl.gz", "b-001.jsonl.gz"]
    assert text(tmp_path / "b-000.jsonl.gz") == HEAD % 1 + long + b'{"still":"here"}\n'
    assert text(tmp_path / "b-001.jsonl.gz") == HEAD % 2 + b'{"a":1}\n'


def test_a_second_writer_of_a_run_overwrites_nothing(tmp_path: Path) -> None:
    for number in (1, 2):
        writer = Writer(tmp_path, "b", rotate_bytes=1 << 20, cap_bytes=1 << 30)
        writer.feed(HEAD % number)
        writer.close()
    assert [text(tmp_path / name) for name in files(tmp_path)] == [HEAD % 1, HEAD % 2]


def test_the_oldest_recordings_go_when_the_cap_is_reached(tmp_path: Path) -> None:
    for age, name in enumerate(["new", "mid", "old"]):
        path = tmp_path / f"{name}-000.jsonl.gz"
        path.write_bytes(b"z" * 1_000)
        os.utime(path, (1_000 - age, 1_000 - age))
    (tmp_path / "notes.txt").write_bytes(b"z" * 9_000)
    prune(tmp_path, 2_000, keep=tmp_path / "none")
    assert files(tmp_path) == ["mid-000.jsonl.gz", "new-000.jsonl.gz", "notes.txt"]
    prune(tmp_path, 0, keep=tmp_path / "mid-000.jsonl.gz")
    assert files(tmp_path) == ["mid-000.jsonl.gz", "notes.txt"]


def test_what_was_flushed_can_be_read_without_a_close(tmp_path: Path) -> None:
    writer = Writer(tmp_path, "b", rotate_bytes=1 << 20, cap_bytes=1 << 30)
    writer.feed(HEAD % 1 + b'{"a":1}\n')
    writer.flush()
    with (tmp_path / "b-000.jsonl.gz").open("rb") as raw, gzip.open(raw) as file:
        assert json.loads(file.readline())["kind"] == "header"
        assert file.readline() == b'{"a":1}\n'
    writer.close()


def test_a_disk_that_fails_ends_the_writer_with_a_word(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(writer_file, "be_humble", lambda: None)
    (tmp_path / "taken").write_text("a file, not a folder")
    assert main([str(tmp_path / "taken"), "b", "1", "1"]) == 1
    assert "recorder_failed" in capfd.readouterr().err
