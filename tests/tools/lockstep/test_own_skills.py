"""A skill that is saved under way is driven by its words, with the real planner and bridge."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.skill_files.folder import read_folder
from tests.known import known
from tools.lockstep import LockstepWorld
from wire import Pose2

pytestmark = pytest.mark.timeout(120)
ROUND = """
en = "do the evening round"
zh = "做晚间巡视"
steps = [{kind = "go_to", place = "kitchen"},
  {kind = "say", text = {en = "All is well.", zh = "一切正常。"}}]
"""


def test_a_skill_saved_under_way_is_driven_by_its_words(tmp_path: Path) -> None:
    world = LockstepWorld(site="two_room", seed=3, start=Pose2(1.0, 4.2, 0.0))
    places = world.planner.missions.memory
    first = world.say("go to the sofa")
    world.run(1.0)
    (tmp_path / "evening_round.toml").write_text(ROUND, "utf-8")
    places.keep_skills(read_folder(tmp_path, places.vocabulary).skills)
    second = world.say("do the evening round")
    world.run_until(lambda _: second.has_ended, limit_s=90.0)
    assert (first.state, second.state) == ("succeeded", "succeeded")
    assert world.room == "kitchen"
    assert world.contacts == 0
    plan = known(second.record.plan)
    assert [step.kind for step in plan.steps] == ["go_to", "say"]
    assert "All is well." in world.planner.said
    third = world.say("不要做晚间巡视")
    world.run_until(lambda _: third.has_ended, limit_s=20.0)
    assert third.state == "refused"
    (tmp_path / "evening_round.toml").unlink()
    places.keep_skills(read_folder(tmp_path, places.vocabulary).skills)
    gone = world.say("do the evening round")
    world.run(2.0)
    assert gone.state != "running"
    assert world.standing
