"""What a person is told at the end of a goal, with the real planner, bridge and physics."""

from __future__ import annotations

from math import atan2
from pathlib import Path

import pytest

from planner.brain.image_questions import ImageDescription, ImageQuestion, ImageSighting, NotThere
from planner.brain.scripted import ScriptedBrain
from planner.plan import Bilingual, BrainTag, Code, Find, GoTo, Look, Say, Step, StepPlan
from tests.known import known
from tools.lockstep import LockstepWorld
from tools.lockstep.homes import stock_home
from wire import Pose2, wrap

ARMCHAIR = Bilingual(en="No: only an armchair at a bare wall.", zh="没有，只有墙边的扶手椅。")
ANNA: dict[str, object] = {"anna": {"at": [2.4, 4.3]}}

KITCHEN, BY_THE_DOOR = Pose2(1.5, 1.9, 0.0), Pose2(1.5, 4.0, -1.57)

pytestmark = [pytest.mark.timeout(120), pytest.mark.nightly(keep=1)]


class Denying:
    """Be a vision model that is shown whatever was kept and sees nobody in it."""

    tag = BrainTag(name="denying", version="1")
    shown: tuple[str, ...] = ()

    async def describe(self, asked: ImageQuestion) -> ImageDescription:
        self.shown = tuple(view.direction.en for view in asked.views)
        return ImageDescription(ARMCHAIR, seen=False, brain=self.tag)

    async def point(self, asked: ImageQuestion) -> NotThere:
        return NotThere(self.tag)

    async def seek(self, asked: ImageQuestion) -> ImageSighting:
        return ImageSighting(False, 0, 0, 0, 0.9, self.tag)


def seeing(home: Path, start: Pose2, *steps: Step) -> tuple[LockstepWorld, Denying]:
    """Return a world that sees, and whose brain says this plan."""
    brain = ScriptedBrain([StepPlan(steps=steps)] * 4)
    world, model = LockstepWorld(site=home, seed=3, start=start, brain=brain), Denying()
    world.open_eyes(looker=model)
    return world, model


@pytest.mark.parametrize("question", ["客厅里有人吗？", "is there anybody in the living room?"])
def test_somebody_who_was_seen_is_told_whatever_a_model_denies(
    tmp_path: Path, repository: Path, question: str
) -> None:
    home = stock_home(tmp_path, repository / "sites" / "two_room", {}, ANNA)
    world, model = seeing(home, KITCHEN, Look(question=question, place="living_room"))
    goal = world.say(question)
    world.run_until(lambda _: goal.has_ended, limit_s=120.0)
    outcome = known(goal.record.outcome)
    assert outcome.code is Code.SEEN
    assert outcome.message.en == (
        "Yes, I see a person in the living room. But at a second look I am less sure: "
        "only an armchair at a bare wall."
    )
    assert outcome.message.zh.startswith("有，在客厅看到一个人。不过再看一眼")
    assert len(set(model.shown)) == 6, "the robot has turned all round"


def test_behind_a_blocked_door_nobody_arrives_and_nothing_is_denied(
    tmp_path: Path, repository: Path
) -> None:
    home = stock_home(tmp_path, repository / "sites" / "two_room", {}, {"anna": {"at": [2.2, 2.3]}})
    world, model = seeing(home, BY_THE_DOOR)
    world.place_obstacle(1.5, 3.0)
    look = StepPlan(steps=(Look(question="is anybody there?", place="kitchen"),))
    dinner = StepPlan(steps=(Say(text="dinner is ready"),))
    world.think_with(
        ScriptedBrain([StepPlan(steps=(GoTo(place="kitchen"), *dinner.steps)), dinner])
    )
    told: list[Bilingual] = []
    for order in ("to the kitchen, then say dinner is ready; else say it here", "look there"):
        goal = world.say(order)
        world.run_until(lambda _, goal=goal: goal.has_ended, limit_s=240.0)  # type: ignore[misc]
        outcome = known(goal.record.outcome)
        told.append(outcome.message)
        world.think_with(ScriptedBrain([look] * 3))
    errand, looked = told
    assert errand.en.startswith("The way to the kitchen is blocked by something 0.")
    assert "m wide at the door between the living room and the kitchen, since " in errand.en
    assert errand.en.endswith(". Instead: I said “dinner is ready”.")
    assert "Arrived" not in errand.en
    assert looked.en == "I found no way to the kitchen."
    assert model.shown == ()


VASE = (0.4, 4.2)
"""A kind that no detector here knows: only the model sees it, from where it is in the picture."""


class Seeking(Denying):
    """Be a vision model that sees one vase, and writes where it is in the picture."""

    def __init__(self) -> None:
        self.poses: list[Pose2] = []

    async def seek(self, asked: ImageQuestion) -> ImageSighting:
        pose = known(asked.picture.base_in_map)
        assert asked.words == "vase"
        self.poses.append(pose)
        left_rad = wrap(atan2(VASE[1] - pose.y_m, VASE[0] - pose.x_m) - pose.yaw_rad)
        shows = pose.y_m > 3.2 and abs(left_rad) < 0.55
        third = round(-left_rad / 0.4) if shows else None
        left, middle, right = (int(third == side) for side in (-1, 0, 1))
        return ImageSighting(third is not None, left, middle, right, 0.9, self.tag)


def test_a_kind_that_only_a_model_knows_is_found_direction_by_direction(
    tmp_path: Path, repository: Path
) -> None:
    """The whole way: from the kitchen through the door, a picture each, until one shows it."""
    home = stock_home(tmp_path, repository / "sites" / "two_room", {}, {})
    brain = ScriptedBrain([StepPlan(steps=(Find(object="vase"),))])
    world, model = LockstepWorld(site=home, seed=3, start=KITCHEN, brain=brain), Seeking()
    world.open_eyes(looker=model)
    goal = world.say("find my vase")
    world.run_until(lambda _: goal.has_ended, limit_s=240.0)
    outcome, plan = goal.record.outcome, goal.record.plan
    assert outcome is not None
    assert plan is not None
    assert outcome.code is Code.FOUND, outcome
    assert outcome.message.en.endswith(" pictures).")
    assert "I see “vase” before me in the living room" in outcome.message.en
    bill = known(plan.steps[0].bill)
    assert bill.pictures == len(model.poses) > 6, "all of the kitchen first"
    headings = [round(pose.yaw_rad, 1) for pose in model.poses[:6]]
    assert len(set(headings)) == 6, "another direction each time"
    facing = wrap(atan2(VASE[1] - world.truth.y_m, VASE[0] - world.truth.x_m) - world.truth.yaw_rad)
    assert abs(facing) < 0.6, "it stands, facing it"
    assert world.contacts == 0
