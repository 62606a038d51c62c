"""Hold each room to its bounds; what it holds may only become less."""

from __future__ import annotations

import subprocess

import pytest

from scripts import rooms
from scripts.names import ROOT, list_sources


def test_no_room_has_grown_and_each_raise_has_its_decision() -> None:
    try:
        sources = list_sources()
    except (FileNotFoundError, subprocess.CalledProcessError):
        pytest.skip("not a git checkout")
    bounds = rooms.read_bounds(rooms.KNOWN.read_text("utf-8"))
    assert rooms.find_grown(rooms.count_rooms(sources), bounds) == []
    raised = {room.decision for room in bounds.values() if room.decision}
    assert {
        number for number in raised if not list((ROOT / "docs/adr").glob(f"{number}-*"))
    } == set()


def test_a_file_that_one_neighbour_alone_imports_is_found() -> None:
    sources = {
        "maps/a.py": "from maps.b import x\nfrom maps.d import y",
        "maps/b.py": "x = 1",
        "maps/c.py": "import maps.d",
        "maps/d.py": "y = 1",
        "wire/e.py": "z = 1",
        "sim/f.py": "from wire import e",
        "tests/maps/test_d.py": "from maps.b import x",
    }
    assert rooms.find_lone_files(sources) == ["maps/b.py"]


def test_rooms_of_a_large_package_are_counted_each_for_itself() -> None:
    sources = {"planner/api/a.py": "1\n2\n", "planner/b.py": "1\n", "sim/site/c.py": "1\n"}
    found = rooms.count_rooms(sources)
    assert {name: room.lines for name, room in found.items()} == {
        "planner/api": 2, "planner": 1, "sim": 1,
    }  # fmt: skip


def test_a_room_may_shrink_and_not_grow() -> None:
    bound = {"sim": rooms.RoomCount(10, 1)}
    assert rooms.find_grown({"sim": rooms.RoomCount(9, 0)}, bound) == []
    for grown in (rooms.RoomCount(11, 1), rooms.RoomCount(10, 2)):
        assert len(rooms.find_grown({"sim": grown}, bound)) == 1
    assert len(rooms.find_grown({"new": rooms.RoomCount(1)}, bound)) == 1
