"""A model's point is told to a person and driven to upon a plain yes alone."""

from __future__ import annotations

from math import hypot, pi
from typing import Any

import pytest

from planner.mission.skills import (
    AskImage,
    DriveLeg,
    Eyesight,
    Fail,
    Observe,
    Question,
    SkillAction,
    act_of,
)
from planner.mission.skills.go_to_object import NEAREST_M, SIDES_RAD
from planner.mission.skills.perception import ImageAnswer
from planner.mission.skills.skill_state import GoToObjectState, PointingStage
from planner.plan import Bilingual, Code
from tests.planner.mission.skills.scenes import scene
from wire import CameraConfig, Pose2

EYES = Eyesight(CameraConfig(), ("cup",), model=True)
AT = (4.0, 0.5, 0.4)
PROPOSED, AGAIN = PointingStage.PROPOSED, PointingStage.AGAIN
ANSWER = GoToObjectState(pointing=PointingStage.ANSWER)
ASKED = GoToObjectState(pointing=PROPOSED, pointed=AT)


def going(reply: str | None = None, **more: Any) -> SkillAction:
    """Return what a goal to the guitar does next, where a person answered so."""
    step = {"object": "guitar", "answer": reply}
    return act_of(scene("go_to_object", step=step, **({"eyes": EYES, "state": ASKED} | more)))


def test_a_point_is_proposed_before_anything_moves() -> None:
    act = going(state=ANSWER, answer=ImageAnswer(at=AT))
    assert act == Question(
        Bilingual(
            en="I think “guitar” is 4.0 m away, straight ahead (in the kitchen). "
            "Shall I drive there?",
            zh="“guitar”好像在正前方 4.0 米处（kitchen）。要我开过去吗？",
        ),
        ASKED,
    )
    assert going() == act, "nobody answered, and the robot was perhaps restarted"


@pytest.mark.parametrize(
    ("yaw", "en", "zh"),
    [
        (0.0, "straight ahead", "正前方"),
        (-pi / 4, "ahead on the left", "左前方"),
        (pi / 4, "ahead on the right", "右前方"),
        (-pi / 2, "on the left", "左侧"),
        (pi / 2, "on the right", "右侧"),
        (-3 * pi / 4, "behind on the left", "左后方"),
        (3 * pi / 4, "behind on the right", "右后方"),
        (pi, "behind me", "正后方"),
    ],
)
def test_it_is_told_as_seen_from_the_robot(yaw: float, en: str, zh: str) -> None:
    at = (9.0, 0.0, 0.4)
    act = going(pose=Pose2(7.0, 0.0, yaw), state=ASKED.but(pointed=at))
    assert isinstance(act, Question)
    assert f"is 2.0 m away, {en}. Shall" in act.text.en, "in no room that is known"
    assert f"{zh} 2.0 米处。" in act.text.zh


def test_a_yes_drives_to_the_point_that_was_told_and_asks_no_model_again() -> None:
    for eyes in (EYES, Eyesight(CameraConfig(), ("cup",)), Eyesight(CameraConfig(), ("guitar",))):
        act = going("yes", eyes=eyes)
        assert isinstance(act, DriveLeg)
        assert act.goal.x_m == pytest.approx(4.0 - 0.8, abs=0.05)
        assert isinstance(act.then, GoToObjectState)
        assert act.then.at == AT


@pytest.mark.parametrize("stage", [PROPOSED, AGAIN])
def test_a_no_ends_it(stage: PointingStage) -> None:
    act = going("no, thanks", state=ASKED.but(pointing=stage))
    assert isinstance(act, Fail)
    assert (act.code, act.reason) == (Code.POINT_REFUSED, "point_declined")
    assert act.said is not None
    assert act.said.en == "You did not say yes, so I do not drive there."


def test_what_is_neither_is_asked_once_more_and_is_then_a_no() -> None:
    act = going("what is it?")
    assert isinstance(act, Question)
    assert act.text.en.startswith("Please answer yes or no. I think “guitar”")
    assert act.text.zh.startswith("请回答“是”或“不”。")
    assert act.state is not None
    assert going(state=act.state) == act, "interrupted"
    assert isinstance(going("hm", state=act.state), Fail)
    assert isinstance(going("yes", state=act.state), DriveLeg)


def test_an_answer_to_another_question_is_none_to_this_point() -> None:
    assert isinstance(going("yes", state=GoToObjectState()), Observe)
    assert isinstance(going("yes", state=ANSWER), AskImage)
    fresh = going("yes", state=ANSWER, answer=ImageAnswer(at=AT))
    assert isinstance(fresh, Question)


def test_it_stands_where_the_thing_is_seen_from_and_tries_the_nearest_such_point_last() -> None:
    """The map is the route search's: each leg says what its end is to see, and how near."""
    legs: list[DriveLeg] = []
    act = going("yes", state=ASKED.but(at=AT))
    while isinstance(act, DriveLeg):
        legs.append(act)
        assert (act.sees, act.sees_from_m) == (AT[:2], NEAREST_M)
        act = going("yes", state=act.otherwise)
    assert len(legs) == len(SIDES_RAD) + 1
    assert all(hypot(leg.goal.x_m - 4.0, leg.goal.y_m - 0.5) > 0.7 for leg in legs[:-1])
    assert (legs[-1].goal.x_m, legs[-1].goal.y_m) == AT[:2], "large furniture: from where it can"
    assert isinstance(act, Fail)
    assert act.code is Code.NO_ROUTE
