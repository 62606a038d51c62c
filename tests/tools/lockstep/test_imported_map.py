"""A sentence drives a map that others made: imported, a room named, simulated from its cells."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from planner.plan import GoalState
from pons import site
from pons.settings import LaunchSettings, site_of
from pons_assets import ROBOT_FILE
from tests.known import known
from tools.lockstep import LockstepWorld

pytestmark = pytest.mark.nightly


SHARED = Path(__file__).resolve().parents[4] / "shared" / "data" / "maps"
LIMIT_S = 120.0


def imported(tmp_path: Path, plan: Path, *words: str) -> Path:
    settings = LaunchSettings(tmp_path / "home", ROBOT_FILE, tmp_path, "127.0.0.1", 1)
    assert site.run(settings, ["import", str(plan), "mine", *words]) == 0
    assert site.run(settings, ["name", "mine", "room_1", "great hall", "--zh", "大厅"]) == 0
    return site_of("mine", settings.home)


def drives_to_the_hall(folder: Path, text: str) -> None:
    world = LockstepWorld(site=folder, seed=2)
    goal = world.say(text)
    world.run_until(lambda _: goal.has_ended, LIMIT_S)
    assert goal.state is GoalState.SUCCEEDED
    hall = known(world.scene.site.place("great_hall"))
    assert hall.contains(world.truth.x_m, world.truth.y_m)
    assert world.contacts == 0


def test_our_own_map_without_its_declaration(tmp_path: Path, repository: Path) -> None:
    for name in ("map.yaml", "map.pgm"):
        shutil.copy(repository / "sites" / "two_room" / name, tmp_path)
    words = ("--start", "1.5", "1.8", "90")
    drives_to_the_hall(imported(tmp_path, tmp_path / "map.yaml", *words), "去大厅")


def test_a_house_of_others(tmp_path: Path) -> None:
    plan = SHARED / "aws_small_house" / "map.yaml"
    if not plan.is_file():
        pytest.skip("no foreign maps beside this checkout (../shared/data/maps)")
    drives_to_the_hall(imported(tmp_path, plan), "go to the great hall")
