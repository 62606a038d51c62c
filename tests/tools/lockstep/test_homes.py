"""Hold that homes drawn for stories are allowed, and as large as they are asked to be."""

from __future__ import annotations

from pathlib import Path

import pytest

from sim.site import load_home
from tools.lockstep.homes import wing_home


@pytest.mark.parametrize("count", [8, 12])
def test_a_home_of_many_rooms_has_them_all_and_a_hallway(tmp_path: Path, count: int) -> None:
    home = load_home(wing_home(tmp_path, count))
    assert len(home.rooms) == count + 1
    assert all("hallway" in door.between for door in home.doors)
