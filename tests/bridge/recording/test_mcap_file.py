"""A file is whole, or cut where its last flush was; what is damaged is refused by name."""

from __future__ import annotations

import errno
import fcntl
import resource
import struct
import tracemalloc
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest
import zstandard

from bridge.recording import mcap_file as file_module
from bridge.recording.mcap_file import McapFile
from bridge.recording.mcap_reader import MAGIC, MOST_BYTES, BadRecording, McapReader, _decompress
from bridge.recording.topics import RecordedTopic, topics
from tests.bridge.recorded import SCHEMAS

TOPICS = topics(SCHEMAS)


def filled(path: Path, topics: Mapping[str, RecordedTopic] = TOPICS) -> McapFile:
    box = McapFile(path, topics)
    for number in range(300):
        box.add("/pons/inbox", number * 10, number, b'{"n":%d}' % number)
        if number % 50 == 49:
            box.flush()
    return box


def numbers(path: Path) -> list[int]:
    with McapReader(path) as box:
        return [raw.sequence for raw in box.messages()]


def test_a_closed_file_gives_everything_in_order(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    filled(path).close()
    with McapReader(path) as box:
        assert box.complete
        assert [raw.sequence for raw in box.messages()] == list(range(300))
        assert {frozenset(chunk.topics) for chunk in box.chunks} == {frozenset({"/pons/inbox"})}


def test_a_reader_tells_a_file_being_written_from_one_that_was_left(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    writing = filled(path)
    for _ in range(2):  # who looks leaves no trace
        with McapReader(path) as box:
            assert (box.complete, box.growing) == (False, True)
    writing.abandon()
    with McapReader(path) as box:
        assert (box.complete, box.growing) == (False, False)
    whole = tmp_path / "b.mcap"
    filled(whole).close()
    with McapReader(whole) as box:
        assert (box.complete, box.growing) == (True, False)


@pytest.mark.parametrize("broken", ["writer", "reader"])
def test_without_locks_a_file_is_read_as_cut_short(
    broken: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise OSError(errno.ENOLCK, "No locks available")

    path = tmp_path / "a.mcap"
    with monkeypatch.context() as patched:
        if broken == "writer":
            patched.setattr(fcntl, "flock", refuse)
        writing = filled(path)
    with monkeypatch.context() as patched:
        if broken == "reader":
            patched.setattr(fcntl, "flock", refuse)
        with McapReader(path) as box:
            assert (box.complete, box.growing) == (False, False)
            assert len(list(box.messages())) == 300
    writing.abandon()


def test_a_file_cut_anywhere_gives_the_chunks_that_are_whole(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    inbox = {"/pons/inbox": TOPICS["/pons/inbox"]}  # all schemas would be most of the file
    filled(path, inbox).close()
    data, lengths = path.read_bytes(), []
    for size in [*range(8, len(data), 97), len(data) - 1]:
        path.write_bytes(data[:size])
        got = numbers(path)
        assert got == list(range(len(got)))
        assert len(got) % 50 == 0
        lengths.append(len(got))
    assert lengths == sorted(lengths)
    assert lengths[-1] == 300


def test_zeros_that_a_power_loss_left_end_the_file(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    filled(path).abandon()
    path.write_bytes(path.read_bytes() + bytes(4096))
    assert numbers(path) == list(range(300))


def test_a_last_chunk_that_never_reached_the_disk_is_left_out(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    filled(path).abandon()
    with McapReader(path) as box:
        last = box.chunks[-1]
    data = bytearray(path.read_bytes())
    data[last.at + 60 : last.at + last.size] = bytes(last.size - 60)
    path.write_bytes(data)
    assert numbers(path) == list(range(250))


def test_damage_inside_a_closed_file_is_said(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    filled(path).close()
    with McapReader(path) as box:
        chunk = box.chunks[2]
    data = bytearray(path.read_bytes())
    data[chunk.at + chunk.size - 4] ^= 0xFF
    path.write_bytes(data)
    with pytest.raises(BadRecording, match=rf"recording_damaged: .*byte {chunk.at}"):
        numbers(path)
    data[chunk.at - 9] = 0x66
    path.write_bytes(data)
    with pytest.raises(BadRecording, match="recording_damaged"):
        numbers(path)


@pytest.mark.parametrize(
    ("content", "code"),
    [
        (b"plain text, and more of it", "recording_not_mcap"),
        (b"\x1f\x8b\x08 as gzip begins", "recording_of_old_format"),
    ],
)
def test_what_is_no_recording_is_refused(content: bytes, code: str, tmp_path: Path) -> None:
    path = tmp_path / "bad"
    path.write_bytes(content)
    with pytest.raises(BadRecording) as refused:
        numbers(path)
    assert refused.value.code == code
    assert str(path) in refused.value.detail


def test_a_file_cut_in_its_first_bytes_is_empty_and_no_error(tmp_path: Path) -> None:
    for size in range(8):
        (tmp_path / "a.mcap").write_bytes(b"\x89MCAP0\r\n"[:size])
        assert numbers(tmp_path / "a.mcap") == []


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(BadRecording, match=r"recording_missing: .*gone"):
        numbers(tmp_path / "gone")


@pytest.fixture
def short_files() -> Iterator[None]:
    """Let the system refuse every byte beyond 20 000 of a file, as a full disk does."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.usefixtures("short_files")
def test_a_write_that_fails_leaves_whole_chunks_and_no_open_file(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    box = McapFile(path, TOPICS)
    count = 0

    def until_refused() -> None:
        nonlocal count
        while True:
            box.add("/pons/inbox", count, count, b"%d" % (count**9) * 20)
            count += 1
            box.flush()

    with pytest.raises(OSError, match="File too large"):
        until_refused()
    box.abandon()
    box.abandon()
    assert numbers(path) == list(range(count - 1))
    assert path.stat().st_size <= 20_000


def test_a_file_that_cannot_be_begun_leaves_nothing_behind(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(_: Path) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(file_module, "_sync_folder", fail)
    with pytest.raises(OSError, match="No space"):
        McapFile(tmp_path / "a.mcap", TOPICS)
    assert list(tmp_path.iterdir()) == []


def test_a_file_is_never_written_over(tmp_path: Path) -> None:
    (tmp_path / "a.mcap").write_bytes(b"somebody's")
    with pytest.raises(FileExistsError):
        McapFile(tmp_path / "a.mcap", TOPICS)
    assert (tmp_path / "a.mcap").read_bytes() == b"somebody's"


@pytest.mark.parametrize("said", [1 << 26, 999])
def test_a_frame_that_unpacks_to_more_than_its_chunk_says_is_never_unpacked(
    said: int, tmp_path: Path
) -> None:
    """A frame's own word on its size outranks a limit given to the library: 1 GB came out once."""
    path = tmp_path / "a.mcap"
    packed = zstandard.compress(bytes(said))
    name = b"zstd"
    body = struct.pack("<QQQI", 0, 0, 1_000, 0) + struct.pack("<I", len(name)) + name
    body += struct.pack("<Q", len(packed)) + packed
    path.write_bytes(MAGIC + struct.pack("<BQ", 0x06, len(body)) + body)
    tracemalloc.start()
    try:
        with McapReader(path) as box:
            box.complete = True
            with pytest.raises(BadRecording, match=f"a frame of {said} bytes in a chunk of 1000"):
                box.read(box.chunks[0])
        assert tracemalloc.get_traced_memory()[1] < 8_000_000
    finally:
        tracemalloc.stop()


def test_a_chunk_too_large_to_be_one_is_not_read(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    length = MOST_BYTES + 1
    with path.open("wb") as file:
        file.write(MAGIC + struct.pack("<BQ", 0x06, length))
        file.truncate(len(MAGIC) + 9 + length)
    with McapReader(path) as box:
        box.complete = True
        with pytest.raises(BadRecording, match="bytes, packed"):
            box.read(box.chunks[0])


def test_a_frame_that_does_not_say_its_size_is_bounded_by_its_chunk() -> None:
    silent = zstandard.ZstdCompressor(write_content_size=False)
    assert _decompress(silent.compress(bytes(100)), 100) == bytes(100)
    with pytest.raises(zstandard.ZstdError):
        _decompress(silent.compress(bytes(1 << 20)), 100)
