"""What was seen is kept in one table: whole, of this map, and never younger than it is."""

from __future__ import annotations

import resource
from functools import partial
from pathlib import Path

import pytest

from planner.perception import Thing
from planner.perception.object_store import FILE, ThingStore
from planner.state_database import FILE as DATABASE
from planner.state_database import StateDatabase
from tests.planner.perception.watching import MAP_ID, store_in

CUP = Thing("cup_1", "cup", "red", 1.0, 2.0, 0.5, 0.05, 0.9, 100.0, 90.0, 3, None)
STORED = (
    b'{"id": "cup_1", "label": "cup", "color": "red", "x_m": 1.0, "y_m": 2.0, "z_m": 0.5,'
    b' "sigma_m": 0.05, "confidence": 0.9, "seen": 9000.0, "first": 8990.0, "sightings": 3,'
    b' "room": null}'
)


def old_file(things: bytes = STORED, map_id: str = MAP_ID, version: bytes = b"1") -> bytes:
    return b'{"version": %s, "map_id": "%s", "things": [%s]}' % (version, map_id.encode(), things)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (b"{", "objects_unreadable"),
        (b"\xff\x00", "objects_unreadable"),
        (old_file()[:-30], "objects_unreadable"),
        (old_file(version=b"2"), "objects_unreadable"),
        (old_file(b"1"), "objects_unreadable"),
        (old_file(STORED + b"," + STORED), "objects_unreadable"),
        (old_file(map_id="0" * 16), "objects_of_another_map"),
    ],
)
def test_an_old_file_that_is_not_ours_is_said_and_put_beside(
    text: bytes, said: str, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / FILE).write_bytes(text)
    assert ThingStore.in_home(tmp_path, MAP_ID).load(1.0) == ()
    assert said in caplog.text
    assert (tmp_path / "objects.json.old").read_bytes() == text
    assert not (tmp_path / FILE).exists()


def test_the_file_of_the_layout_before_is_taken_over_once(tmp_path: Path) -> None:
    (tmp_path / FILE).write_bytes(old_file())
    wall = partial(float, 9_000.0)
    for _ in range(2):
        assert store_in(tmp_path, wall).load(100.0) == (CUP,)
    assert {path.name for path in tmp_path.glob("objects*")} == {"objects.json.old"}
    assert store_in(tmp_path, wall).save((), 100.0)
    assert store_in(tmp_path, wall).load(100.0) == ()


def test_a_row_that_is_not_ours_is_said_and_costs_no_start(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    store = ThingStore.in_home(tmp_path, MAP_ID)
    assert store.save((CUP,), 100.0)
    with StateDatabase(tmp_path).change() as connection:
        connection.execute("UPDATE objects SET record = ?", ('{"id": 1}',))
    assert store.load(1.0) == ()
    assert "objects_unreadable" in caplog.text
    assert store.save((CUP,), 100.0)
    assert len(store.load(100.0)) == 1


def test_a_clock_set_back_makes_nothing_younger_than_now(tmp_path: Path) -> None:
    assert store_in(tmp_path, lambda: 9_000.0).save((CUP,), 100.0)
    for wall_s, seen_s in ((8_000.0, 50.0), (9_010.0, 40.0), (9e9, 50.0 - 365 * 86_400)):
        (back,) = store_in(tmp_path, partial(float, wall_s)).load(50.0)
        assert back.seen_s == pytest.approx(seen_s)
        assert back.first_s <= back.seen_s


def test_a_disk_that_refuses_is_said_and_keeps_what_was(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    store = store_in(tmp_path, lambda: 9_000.0)
    assert store.save((CUP,), 100.0)
    most = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, most[1]))
    try:
        assert not store.save((), 100.0)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, most)
    assert "objects_unwritable" in caplog.text
    assert store.load(100.0) == (CUP,)
    blocked = tmp_path / "blocked"
    blocked.write_text("no folder")
    assert not ThingStore.in_home(blocked, MAP_ID).save((), 100.0)


def test_nobody_else_may_read_what_was_seen(tmp_path: Path) -> None:
    path = tmp_path / DATABASE
    path.write_bytes(b"")
    path.chmod(0o644)
    store = ThingStore.in_home(tmp_path, MAP_ID)
    assert store.save((CUP,), 100.0)
    assert {each.stat().st_mode & 0o777 for each in tmp_path.iterdir()} == {0o600}
