"""Only a plain file of a bounded size is read, whatever lies in its place."""

from __future__ import annotations

import errno
import os
import socket
from pathlib import Path

import pytest

from wire.plain_file import read_plain_file


def refused(path: Path, most_bytes: int = 100) -> OSError:
    with pytest.raises(OSError, match=path.name) as caught:
        read_plain_file(path, most_bytes)
    return caught.value


def test_a_plain_file_is_read_up_to_its_bound(tmp_path: Path) -> None:
    path = tmp_path / "map.pgm"
    path.write_bytes(b"x" * 100)
    assert read_plain_file(path, 100) == b"x" * 100
    (tmp_path / "link").symlink_to(path)
    assert read_plain_file(tmp_path / "link", 100) == b"x" * 100
    path.write_bytes(b"x" * 101)
    assert refused(path).errno == errno.EFBIG


def test_a_huge_file_costs_no_more_memory_than_its_bound(tmp_path: Path) -> None:
    path = tmp_path / "map.pgm"
    with path.open("wb") as file:
        file.truncate(1 << 40)
    error = refused(path)
    assert (error.errno, "more than 100 bytes" in str(error.strerror)) == (errno.EFBIG, True)


def test_a_file_that_grows_while_it_is_read_is_refused() -> None:
    path = Path("/proc/self/maps")
    assert path.stat().st_size == 0
    assert refused(path).errno == errno.EBUSY


@pytest.mark.timeout(10)
def test_a_device_a_pipe_a_folder_and_a_socket_are_no_plain_files(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(str(tmp_path / "socket"))
    for path in (Path("/dev/zero"), tmp_path / "pipe"):
        error = refused(path)
        assert (error.errno, error.strerror) == (errno.EINVAL, "it is not a regular file")
    refused(tmp_path / "socket")
    refused(tmp_path / "gone")
    with pytest.raises(OSError, match=r"regular|directory"):
        read_plain_file(tmp_path, 100)
    listener.close()
