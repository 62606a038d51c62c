"""How far a search may go: by the site's size, by the plan's rest, and never beyond a grant."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from planner.bridge_client.ownership import GRANT_METRES, GRANT_SECONDS
from planner.mission.skills import DriveLeg, Eyesight, Fail, Finish, Question
from planner.mission.skills.count import count
from planner.mission.skills.find import find
from planner.mission.skills.perception import PictureLimits
from planner.mission.skills.search_bounds import (
    GRANT_M,
    GRANT_S,
    LEAST_M,
    LEAST_PICTURES,
    LEAST_S,
    MOST_KEPT_M,
    MOST_M,
    MOST_S,
    bound_pictures,
    bound_search,
    way_after_m,
)
from planner.mission.skills.skill_state import CountState, FindState
from planner.plan import Bilingual, Code, StepRole
from planner.site.site_view import SiteView, Target
from tests.planner.mission.skills.looking import EYES, looking
from tests.planner.mission.skills.scenes import scene
from wire import CameraConfig, Pose2

HALL = "r0"


def home(rooms: int, side_m: float = 4.0) -> SiteView:
    """Return a home of square rooms in rows of three."""
    targets = {}
    for n in range(rooms):
        x_m, y_m = side_m * (n % 3), side_m * (n // 3)
        box = ((x_m, y_m), (x_m + side_m, y_m), (x_m + side_m, y_m + side_m), (x_m, y_m + side_m))
        name = Bilingual(en=f"room {n}", zh=f"房间{n}")
        middle = Pose2(x_m + side_m / 2, y_m + side_m / 2, 0.0)
        targets[f"r{n}"] = Target(f"r{n}", True, name, middle, box)
    return SiteView(targets, home="r0")


def test_the_bounds_grow_with_the_home_and_stay_between_a_small_homes_and_a_grant() -> None:
    assert (GRANT_M, GRANT_S) == (GRANT_METRES, GRANT_SECONDS)
    for sides in ((3.0,) * 40, (4.0,) * 40, (12.0,) * 12):
        before = bound_search(home(0, sides[0]))
        for rooms, side_m in enumerate(sides):
            now = bound_search(home(rooms, side_m))
            assert before.begin_m <= now.begin_m
            assert before.seconds <= now.seconds
            assert LEAST_M <= now.begin_m <= now.end_m == MOST_M < GRANT_M
            assert LEAST_S <= now.seconds <= MOST_S == GRANT_S
            before = now
        assert before.begin_m == MOST_M, "a large home has all that a grant allows"
        assert before.seconds == MOST_S


@pytest.mark.parametrize("left_m", [60.0, 40.0, 12.0, 0.5, -3.0])
def test_no_search_drives_more_than_its_goal_may_yet(left_m: float) -> None:
    bounds = bound_search(home(9), left_m)
    assert 0.0 <= bounds.begin_m <= bounds.end_m <= max(0.0, left_m)


def test_the_way_that_comes_afterwards_is_kept() -> None:
    assert way_after_m((0.0, 0.0), ()) == 0.0
    assert way_after_m((0.0, 0.0), (((4.0, 0.0),), ((2.0, 0.0),))) == pytest.approx(6.0)
    assert way_after_m((0.0, 0.0), (((90.0, 0.0),),)) == MOST_KEPT_M


@pytest.mark.parametrize("kind", ["find", "count"])
def test_a_way_is_not_begun_from_which_the_plans_rest_is_out_of_reach(kind: str) -> None:
    """In room 0 all was looked at; room 1 is 4 m on, and then it is far to where the plan goes."""
    state = (FindState if kind == "find" else CountState)(
        here=(2.0, 2.0), order=("r0", "r1"), spots=("here",), rooms=("r0",)
    )
    skill = find if kind == "find" else count
    for afterwards, drives in (((), True), ((((2.0, 2.0),),), True), ((((-14.0, 2.0),),), False)):
        scene_ = scene(
            kind, step={"object": "red cup"}, facts=home(2, 4.0), pose=Pose2(2.0, 2.0, 0.0),
            eyes=EYES, state=state, spent_m=30.0, left_m=50.0, afterwards=afterwards, now_s=1.0,
        )  # fmt: skip
        act = skill(scene_)
        assert isinstance(act, DriveLeg) is drives, afterwards
        if isinstance(act, DriveLeg):
            assert act.limit_m is not None
            assert act.limit_m <= 50.0 - 30.0, "the leg ends before the grant does"


def test_pictures_are_bounded_by_the_rooms_unless_the_owner_says() -> None:
    def most(rooms: int, limits: PictureLimits) -> int:
        eyes = Eyesight(CameraConfig(), ("cup",), model=True, pictures=limits)
        return bound_pictures(scene("find", facts=home(rooms), eyes=eyes))

    by_site = PictureLimits(96, by_site=True)
    counts = [most(rooms, by_site) for rooms in range(30)]
    assert counts == sorted(counts)
    assert counts[0] == LEAST_PICTURES
    assert counts[7] >= 7 * EYES.views
    assert counts[-1] == 96
    assert most(9, PictureLimits(5)) == 5
    assert most(9, PictureLimits(10, by_site=True)) == 10, "the goal's calls hold"


def ended(kind: str, **more: Any) -> Any:
    state = (FindState if kind == "find" else CountState)(
        here=(2.0, 2.0), order=("r0", "r1", "r2"), spots=("here",), rooms=("r0",)
    )
    fields: dict[str, Any] = {"state": state, "facts": home(3), "spent_m": 60.0, **more}
    return looking(kind, **fields)


@pytest.mark.parametrize("kind", ["find", "count"])
def test_rooms_that_were_not_looked_in_are_named_and_offered(kind: str) -> None:
    told = ended(kind)
    assert isinstance(told, Fail | Finish)
    assert told.said is not None
    assert "I saw no red cup." in told.said.en
    assert "I did not look in the room 1 and room 2." in told.said.en
    assert "房间1" in told.said.zh
    assert "房间2" in told.said.zh
    assert "0" not in told.said.en.replace("room 0", ""), "none in half a home is no number"
    asked = ended(kind, offers=True)
    assert isinstance(asked, Question)
    assert told.said.en in asked.text.en
    assert asked.text.en.endswith("Shall I look in the room 1 and room 2, too? Say yes or no.")
    assert asked.text.zh.endswith("要我接着看房间1和房间2吗？请回答是或否。")
    assert asked.state is not None
    again = ended(kind, offers=True, state=asked.state)
    assert again == told, "nobody is asked twice"


def test_a_count_of_nothing_in_half_a_home_has_no_value() -> None:
    half = ended("count")
    assert isinstance(half, Finish)
    assert (half.code, half.figures["count"]) == (Code.COUNTED, None)
    done = ("here", "r1/0", "r2/0", "r0/near", "r1/near", "r2/near")
    state = CountState(here=(2.0, 2.0), order=("r0",), spots=done, rooms=("r0",))
    whole = ended("count", state=state, spent_m=0.0)
    assert isinstance(whole, Finish)
    assert whole.figures["count"] == 0, "none in all that was to be looked at"


def test_a_find_that_ran_out_takes_the_persons_else_and_says_so() -> None:
    when = {"object": "red cup", "role": StepRole.WHEN}
    ran_out = ended("find", step=when, has_else=True, offers=False)
    assert isinstance(ran_out, Finish)
    assert ran_out.figures["holds"] is False
    assert ran_out.said is not None
    assert ran_out.said.en.endswith("So I do what you said for that case.")
    assert "I did not look in the room 1 and room 2." in ran_out.said.en
    assert "没找到" in ran_out.said.zh
    bare = ended("find", step=when)
    assert isinstance(bare, Finish)
    assert bare.said is not None
    assert "So I do" not in bare.said.en
    until = ended("find", step={"object": "red cup", "role": StepRole.UNTIL}, has_else=False)
    assert isinstance(until, Finish)
    assert until.figures["holds"] is None, "of a round that saw half a home nothing is known"
    nowhere = FindState(here=(2.0, 2.0), order=("r0", "r1"), shut=("r0", "r1"))
    unknown = ended("find", step=when, has_else=True, state=nowhere)
    assert isinstance(unknown, Fail)
    assert unknown.code is Code.UNSURE, "nobody has searched yet"


def test_the_rooms_come_first_where_the_metres_would_not_last_for_every_corner() -> None:
    """A large room has several spots; with few metres left the other rooms come before them."""
    large = home(3, 8.0)
    state = FindState(here=(4.0, 4.0), order=("r0", "r1", "r2"), spots=("here",), rooms=("r0",))

    def next_room(left_m: float) -> bool:
        act = find(
            scene("find", step={"object": "red cup"}, facts=large, pose=Pose2(4.0, 4.0, 0.0),
                  eyes=EYES, state=state, left_m=left_m, now_s=1.0)
        )  # fmt: skip
        assert isinstance(act, DriveLeg)
        return act.goal.x_m > 8.0

    assert not next_room(60.0)
    assert next_room(40.0)


def test_a_site_without_outlines_is_bounded_too() -> None:
    bare = {k: replace(t, polygon=None) for k, t in home(12).targets.items()}
    assert bound_search(SiteView(bare, home=HALL)).begin_m >= LEAST_M
