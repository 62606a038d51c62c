"""Names sort by time; the oldest go when there are too many, and the newest never."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from bridge.recording import rotation as folder_module
from bridge.recording.rotation import next_path, prune

GIB = 1 << 30


def put(folder: Path, name: str, size: int, age_s: float) -> Path:
    path = folder / name
    path.write_bytes(bytes(size))
    os.utime(path, (2e9 - age_s, 2e9 - age_s))
    return path


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_a_name_holds_utc_boot_and_number(tmp_path: Path) -> None:
    assert next_path(tmp_path, "b1", 1_700_000_000.9).name == "20231114T221320Z-b1-000.mcap"
    (tmp_path / "20231114T221320Z-b1-000.mcap").touch()
    assert next_path(tmp_path, "b1", 1_700_000_001.0).name == "20231114T221321Z-b1-001.mcap"
    (tmp_path / "20231114T221321Z-b1-002.mcap").touch()
    assert next_path(tmp_path, "b1", 1_700_000_001.0).name == "20231114T221321Z-b1-003.mcap"


def test_the_oldest_go_until_there_is_room_for_one_more(tmp_path: Path) -> None:
    for age in range(5):
        put(tmp_path, f"t-b{age}-000.mcap", 100, age_s=age)
    gone = prune(tmp_path, "now", cap_bytes=400, room_bytes=150)
    assert [path.name for path in gone] == ["t-b4-000.mcap", "t-b3-000.mcap", "t-b2-000.mcap"]
    assert prune(tmp_path, "now", cap_bytes=400, room_bytes=150) == []


def test_this_boots_own_go_last_whatever_the_clock_says(tmp_path: Path) -> None:
    put(tmp_path, "t-now-000.mcap", 100, age_s=1e9)
    put(tmp_path, "t-now-001.mcap", 100, age_s=1e9)
    put(tmp_path, "t-old-000.mcap", 100, age_s=0)
    prune(tmp_path, "now", cap_bytes=200, room_bytes=50)
    assert names(tmp_path) == ["t-now-001.mcap"]


def test_recordings_of_before_count_and_go_and_strangers_stay(tmp_path: Path) -> None:
    put(tmp_path, "b-000.jsonl.gz", 1000, age_s=9)
    put(tmp_path, "notes.txt", 1000, age_s=99)
    put(tmp_path, "t-b-000.mcap", 10, age_s=1)
    prune(tmp_path, "now", cap_bytes=100, room_bytes=10)
    assert names(tmp_path) == ["notes.txt", "t-b-000.mcap"]


def test_a_disk_that_is_nearly_full_takes_the_old_but_not_the_newest_two(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for age in range(5):
        put(tmp_path, f"t-b{age}-000.mcap", 100, age_s=age)
    monkeypatch.setattr(folder_module, "free_bytes", lambda _: 1 << 20)
    prune(tmp_path, "now", cap_bytes=GIB, room_bytes=100)
    assert names(tmp_path) == ["t-b0-000.mcap", "t-b1-000.mcap"]
