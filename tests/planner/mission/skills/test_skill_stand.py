"""A robot stands at a side of something on free floor, turns to face it, or says why not."""

from __future__ import annotations

from typing import Any

import pytest

from planner.mission.skills import DriveLeg, Eyesight, Fail, Finish, Retry, Way, act_of
from planner.mission.skills.skill_state import StandAtState
from planner.perception.snapshot import Sight, Thing
from planner.plan import Code, StandAt
from planner.site import Site
from planner.site.site_view import facts_of
from tests.conftest import ROOT
from tests.planner.mission.skills.scenes import scene
from wire import CameraConfig, Pose2

FACTS = facts_of(Site.load(ROOT / "sites" / "home"))
HERE = Pose2(6.0, 4.75, 0.0)
EYES = Eyesight(CameraConfig(), ("chair", "cup"))
CHAIR = Thing("chair_1", "chair", "red", 7.5, 4.75, 0.4, 0.05, 0.9, 0.0, 0.0, 5, "hallway")


def acted(state: StandAtState | None = None, pose: Pose2 | None = HERE, **step: Any) -> Any:
    asked = StandAt.model_validate(step).model_dump(exclude={"kind"})
    more = {"state": state} if state is not None else {}
    sight = Sight(None, (CHAIR,))
    return act_of(
        scene("stand_at", step=asked, facts=FACTS, pose=pose, eyes=EYES, sight=sight, **more)
    )


def test_it_drives_to_the_side_facing_it_and_tells_how_far_it_came() -> None:
    leg = acted(place="front_door", side="before", distance_m=1.0)
    assert isinstance(leg, DriveLeg)
    assert (leg.way, leg.heading) == (Way.ROUTE, True)
    assert isinstance(leg.then, StandAtState)
    ended = acted(leg.then, pose=Pose2(10.1, 1.35, -1.57), place="front_door", side="before")
    assert isinstance(ended, Finish)
    assert (ended.code, ended.said and ended.said.en) == (
        Code.ARRIVED,
        "I stand 1.0 m before the front door.",
    )


def test_a_spot_without_a_way_is_followed_by_the_next_and_then_by_a_no() -> None:
    act = acted(place="bed", side="beside")
    tried = []
    while isinstance(act, DriveLeg):
        tried.append((act.goal.x_m, act.goal.y_m))
        assert isinstance(act.otherwise, StandAtState)
        act = acted(act.otherwise, place="bed", side="beside")
    assert len(set(tried)) == len(tried) == 2
    assert isinstance(act, Fail)
    assert (act.code, act.reason) == (Code.NO_ROOM, "no_spot")
    assert act.said is not None
    assert act.said.en == "There is no free floor beside the bed that I can get to, so I stay here."
    assert "床旁边" in act.said.zh


@pytest.mark.parametrize(
    ("step", "words"),
    [
        ({"place": "sofa", "side": "behind"}, "no free floor behind the sofa"),
        ({"place": "sofa", "side": "before", "distance_m": 1.0}, "no free floor 1.0 m before"),
        ({"place": "kitchen", "side": "before"}, "a room has no side"),
        ({"place": "attic", "side": "before"}, "attic"),
        ({"object": "cup", "side": "beside"}, "have me find it first"),
        ({"object": "unicorn", "side": "beside"}, "unicorn"),
    ],
)
def test_what_can_not_be_stood_at_says_why(step: dict[str, Any], words: str) -> None:
    act = acted(**step)
    assert isinstance(act, Fail), act
    assert act.said is not None
    assert words in act.said.en
    assert act.said.zh


def test_a_thing_that_was_seen_has_sides_as_seen_from_here() -> None:
    before, behind = (acted(object="red chair", side=side) for side in ("before", "behind"))
    assert before.goal.x_m < CHAIR.x_m < behind.goal.x_m
    facing = acted(object="chair", side="facing", pose=Pose2(6.0, 4.75, 2.0))
    assert isinstance(facing, DriveLeg)
    assert facing.way is Way.SPIN
    assert abs(facing.goal.yaw_rad) < 0.01
    there = acted(object="chair", side="facing")
    assert isinstance(there, Finish), "it faces it already"
    assert there.said is not None
    assert there.said.en == "I face the red chair, 1.5 m away."


def test_who_does_not_know_where_it_is_waits() -> None:
    assert isinstance(acted(pose=None, place="bed", side="beside"), Retry)


@pytest.mark.parametrize(
    "bad",
    [{"side": "before"}, {"place": "bed", "object": "cup", "side": "before"},
     {"place": "bed", "side": "on"}, {"place": "bed", "side": "before", "distance_m": 99.0},
     {"place": "bed", "side": "before", "distance_m": -1.0},
     {"place": "bed", "side": "before", "distance_m": float("nan")}],
)  # fmt: skip
def test_what_is_no_side_is_no_step(bad: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match="validation error"):
        StandAt.model_validate(bad)
