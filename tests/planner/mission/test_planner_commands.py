"""What the planner itself is told: where the robot is, and an order's steps to keep as a skill."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from pathlib import Path

import pytest

from maps.growing_map import GROWING_MAP
from planner.language.commands import HereCommand, KeepSkill
from planner.mission.effects import AskBrain
from planner.mission.errors import MissionError
from planner.mission.events import Command, Planned
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
from planner.site import Site
from planner.site.known_places import KnownPlaces
from planner.skill_files.folder import SkillFolder
from planner.skill_files.keep import SkillKeeper
from tests.planner.mission.fakes import FACTS
from wire import HintCode, HintVerdict, PoseHint

SITE = Site.load(Path(__file__).resolve().parents[3] / "sites" / "two_room")
MISSION = Mission(id="g1", order=1, text="you are in the kitchen", language=Language.EN,
                  state=GoalState.PLANNING, created_unix_s=0.0, updated_unix_s=0.0)  # fmt: skip


class Missions:
    """Know no goals."""

    book = MissionState(FACTS)
    status_age_s = 0.0

    def obey(self, command: Command) -> MissionError | None:
        raise AssertionError(command)


class Localizer:
    """Answer each hint with one verdict, or not at all."""

    def __init__(self, code: HintCode | None, *, speaks: bool = True) -> None:
        self.code = code
        self.localizer: object | None = self if speaks else None

    async def hint(self, hint: PoseHint) -> HintVerdict | None:
        return None if self.code is None else HintVerdict(id=hint.id, code=self.code, score=0.4)


async def think(ask: AskBrain) -> Planned:
    raise AssertionError(ask)


def hinted(localizer: Localizer, site: Site = SITE) -> object:
    commands = PlannerCommands(think, KnownPlaces(site), Missions(), localizer)
    return asyncio.run(commands.carry_out(HereCommand("kitchen"), MISSION))


def test_a_place_that_a_scan_confirms_is_answered() -> None:
    said = hinted(Localizer("accepted"))
    assert isinstance(said, AnswerPlan)
    assert said.text.en == "What I see fits: that is where I am."


@pytest.mark.parametrize(
    ("localizer", "why"),
    [
        (Localizer("moving"), "I am moving; stop me first"),
        (Localizer("does_not_fit"), "what I see does not fit there"),
        (Localizer("no_scan"), "I have seen nothing yet that I could check it by"),
        (Localizer(None), "I could not check it"),
        (Localizer("accepted", speaks=False), "I can't be told where I am"),
    ],
)
def test_a_word_that_changed_nothing_is_refused_and_says_why(
    localizer: Localizer, why: str
) -> None:
    said = hinted(localizer)
    assert isinstance(said, Refuse)
    assert said.code is Code.HINT_REFUSED
    assert said.reason.en == f"I do not take myself to be there: {why}."
    assert said.reason.zh.startswith("我不能确认自己在那里：")


def test_while_a_map_grows_nobody_is_asked(tmp_path: Path) -> None:
    (tmp_path / GROWING_MAP).touch()
    said = hinted(Localizer("accepted"), replace(SITE, folder=tmp_path))
    assert isinstance(said, Refuse)
    assert said.code is Code.HINT_REFUSED
    assert "a map is being made" in said.reason.en
    assert "正在建图" in said.reason.zh


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
