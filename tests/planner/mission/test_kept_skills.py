"""An order's steps are kept as a skill by a sentence, or it is said why not."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest

from planner.language.commands import KeepSkill
from planner.mission.planner_commands import PlannerCommands
from planner.mission.state import Mission, MissionState
from planner.plan import (
    AnswerPlan,
    Code,
    GoalState,
    GoTo,
    Language,
    Refuse,
    Say,
    StepPlan,
    plan_record,
)
from planner.site.known_places import KnownPlaces
from planner.skill_files.folder import SkillFolder
from planner.skill_files.keep import SkillKeeper
from tests.planner.mission.fakes import FACTS
from tests.planner.mission.test_planner_commands import MISSION, SITE, Localizer, Missions, think

STEPS = (GoTo(place="kitchen"), Say(text="All is well."))
DONE = Mission(
    id="g0", order=0, text="go to the kitchen and say all is well", language=Language.EN,
    state=GoalState.SUCCEEDED, created_unix_s=0.0, updated_unix_s=0.0,
    plan=plan_record(StepPlan(steps=STEPS)),
)  # fmt: skip


def _keep(home: Path, name: str, *before: Mission) -> AnswerPlan | Refuse:
    missions = Missions()
    missions.book = MissionState(FACTS, missions={each.id: each for each in (*before, MISSION)})
    places = KnownPlaces(SITE)
    commands = PlannerCommands(think, places, missions, Localizer(None))
    folder = SkillFolder(home, lambda: places.vocabulary)
    commands.skills = SkillKeeper(folder)
    return asyncio.run(commands.carry_out(KeepSkill(name), MISSION))


@pytest.mark.parametrize(
    ("name", "file"), [("evening round", "evening_round.toml"), ("晚间巡视", "skill_")]
)
def test_the_steps_of_the_order_before_are_kept(tmp_path: Path, name: str, file: str) -> None:
    told = _keep(tmp_path, name, DONE)
    assert isinstance(told, AnswerPlan)
    assert name in told.text.en
    assert "go to the kitchen" in told.text.en
    assert "去厨房" in told.text.zh
    [kept] = (tmp_path / "skills").iterdir()
    assert kept.name.startswith(file)


def test_what_can_not_be_kept_is_refused_with_its_reason(tmp_path: Path) -> None:
    refused = _keep(tmp_path, "evening round")
    assert isinstance(refused, Refuse)
    assert refused.code is Code.SKILL_NOT_KEPT
    assert "no order before" in refused.reason.en
    asked = DONE.model_copy(update={"state": GoalState.REFUSED})
    assert isinstance(_keep(tmp_path, "evening round", asked), Refuse)
    taken = _keep(tmp_path, "stop", DONE)
    assert isinstance(taken, Refuse)
    assert "means something else already" in taken.reason.en
    assert taken.reason.zh
