"""A disk that is really full costs the record, not the drive; with room it records again."""

from __future__ import annotations

import errno
import os
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from bridge.recording.recorder import Recorder
from bridge.recording.writer_process import Sizes
from bridge.replay import replay
from tests.bridge.recording.test_recorder import CONFIG, Driver, recordings

pytestmark = pytest.mark.nightly(keep=1)


SIZES = Sizes(rotate_bytes=1 << 20, cap_bytes=1 << 30)


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """Mount a disk of 8 MB; only root may."""
    disk = tmp_path / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=8m", "tmpfs", str(disk)]
    done = subprocess.run(mount, capture_output=True, text=True, check=False)
    if done.returncode:
        pytest.skip(f"no small disk to fill: {done.stderr.strip()}")
    yield disk
    subprocess.run(["umount", "-l", str(disk)], check=True)


def fill(path: Path) -> None:
    """Take all that is left, as another program's logs would."""
    with path.open("wb", buffering=0) as file:
        size = 1 << 20
        while size:
            try:
                file.write(os.urandom(size))
            except OSError as error:
                if error.errno != errno.ENOSPC:
                    raise
                size //= 2


def test_it_says_so_drives_on_and_records_again_when_there_is_room(small_disk: Path) -> None:
    folder, stranger = small_disk / "recordings", small_disk / "log"
    recorder = Recorder(folder, CONFIG, SIZES)
    driver = Driver(recorder)
    try:
        assert driver.until(lambda: not recorder.trouble)
        fill(stranger)
        assert driver.until(lambda: recorder.trouble.startswith("disk_full: "))
        assert str(folder) in recorder.trouble
        before, lost = driver.ticks, recorder.gaps
        driver.turn(100)
        assert driver.ticks == before + 100, "the loop goes on"
        assert recorder.gaps >= lost + 90
        assert recorder.trouble.startswith("disk_full: ")
        stranger.unlink()
        assert driver.until(lambda: not recorder.trouble)
        driver.turn(50)
        assert recorder.close()
        files = recordings(folder)
        assert len(files) == 2
        report = replay(files)
        assert report.differing == 0
        assert report.gaps >= recorder.gaps > 0
        assert report.ticks + report.gaps == driver.ticks
    finally:
        recorder.close()


def test_a_disk_full_from_the_start_is_said_by_its_code(small_disk: Path) -> None:
    fill(small_disk / "log")
    recorder = Recorder(small_disk / "recordings", CONFIG, SIZES)
    driver = Driver(recorder)
    try:
        assert driver.until(lambda: recorder.trouble.startswith("disk_full: "))
        assert recorder.gaps > 0
    finally:
        recorder.close()


def test_a_folder_that_is_none_is_said_with_its_reason(tmp_path: Path) -> None:
    (tmp_path / "recordings").write_text("a file in its place")
    recorder = Recorder(tmp_path / "recordings", CONFIG, SIZES)
    driver = Driver(recorder)
    try:
        assert driver.until(lambda: "exists" in recorder.trouble)
        assert recorder.trouble.startswith("recorder_down: ")
        (tmp_path / "recordings").unlink()
        assert driver.until(lambda: not recorder.trouble)
    finally:
        recorder.close()
