"""What was seen is kept in one file: whole, of this map, and never younger than it is."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import psutil
import pytest

from planner.perception import Thing
from planner.perception.object_store import FILE, ThingStore
from tests.planner.perception.watching import MAP_ID


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (b"{", "objects_unreadable"),
        (b"\xff\x00", "objects_unreadable"),
        (b'{"map_id": "0000000000000000", "things": []}', "objects_of_another_map"),
        (b'{"map_id": "%s", "things": [1]}' % MAP_ID.encode(), "objects_unreadable"),
    ],
)
def test_a_file_that_is_not_ours_is_said_and_left(
    text: bytes, said: str, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / FILE).write_bytes(text)
    assert ThingStore.in_home(tmp_path, MAP_ID).load(1.0) == ()
    assert said in caplog.text


def test_a_clock_set_back_makes_nothing_younger_than_now(tmp_path: Path) -> None:
    thing = Thing("cup_1", "cup", "red", 1.0, 2.0, 0.5, 0.05, 0.9, 100.0, 90.0, 3, None)
    assert ThingStore(tmp_path / FILE, MAP_ID, wall=lambda: 9_000.0).save((thing,), 100.0)
    for wall_s, seen_s in ((8_000.0, 50.0), (9_010.0, 40.0), (9e9, 50.0 - 365 * 86_400)):
        (back,) = ThingStore(tmp_path / FILE, MAP_ID, wall=partial(float, wall_s)).load(50.0)
        assert back.seen_s == pytest.approx(seen_s)
        assert back.first_s <= back.seen_s
    blocked = ThingStore(tmp_path / FILE / "below", MAP_ID)
    assert not blocked.save((thing,), 100.0)


def test_nobody_else_may_read_what_was_seen(tmp_path: Path) -> None:
    path = tmp_path / FILE
    for there in (path, path.with_suffix(".new")):  # of an older version, and of a crash
        there.write_bytes(b"{}")
        there.chmod(0o644)
    assert ThingStore(path, MAP_ID).save((), 100.0)
    assert path.stat().st_mode & 0o777 == 0o600


def test_a_file_of_another_user_costs_no_descriptor(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(_descriptor: int, _mode: int) -> None:
        raise PermissionError(1, "Operation not permitted")

    monkeypatch.setattr("planner.perception.object_store.os.fchmod", refuse)
    store, here = ThingStore(tmp_path / FILE, MAP_ID), psutil.Process()
    assert not store.save((), 100.0)
    before = here.num_fds()
    assert not store.save((), 100.0)
    assert here.num_fds() == before
