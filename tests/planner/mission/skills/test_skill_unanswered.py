"""Check that a person hears why a model did not look, and why a point leads nowhere."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from planner.brain.model_error_codes import reason
from planner.mission.skills import Scene
from planner.mission.skills.actions import UNSEEN, AskImage, Fail, Finish
from planner.mission.skills.go_to_object import go_to_object
from planner.mission.skills.look import NO_DETECTOR, look
from planner.mission.skills.perception import Eyesight, ImageAnswer
from planner.mission.skills.skill_state import (
    GoToObjectState,
    LookStage,
    LookState,
    PointingStage,
)
from planner.mission.skills.state_base import SkillStateBase
from planner.perception import Sight
from planner.plan import Bilingual, Code, say_same
from tests.planner.mission.skills.scenes import scene
from wire import CameraConfig

EYES = Eyesight(CameraConfig(), ("cup",), model=True)
NONE = "no_detector"
ASKED = LookState(stage=LookStage.ASKED)
ANSWER = GoToObjectState(pointing=PointingStage.ANSWER)
SEEN = "I see nothing that I know"


def after(
    state: SkillStateBase, answer: ImageAnswer, sight: Sight = UNSEEN, **step: str
) -> Scene[Any]:
    """Return a scene in which the model was asked."""
    kind = "look" if isinstance(state, LookState) else "go_to_object"
    return scene(kind, step=step, state=state, eyes=EYES, answer=answer, sight=sight)


@pytest.mark.parametrize(
    ("failure", "code"),
    [
        *((c, c) for c in ("pictures_offhost", "no_pictures", "out_of_budget")),
        ("timed_out", "timeout"),
    ],
)
def test_the_detector_speaks_and_says_why(failure: str, code: str) -> None:
    act = look(after(ASKED, ImageAnswer(failure=failure), text="what is there?"))
    assert isinstance(act, Finish)
    assert act.said is not None
    assert act.said.en.startswith(SEEN)
    assert act.said.en.endswith(reason(code).en)
    assert act.said.zh.endswith(reason(code).zh)
    assert act.read is None


def test_what_can_not_be_used_of_a_picture_is_not_called_a_plan() -> None:
    act = look(after(ASKED, ImageAnswer(failure="bad_plan"), text="what is there?"))
    assert isinstance(act, Finish)
    assert act.said is not None
    assert act.said.en.endswith("I could not make sense of the picture.")
    assert act.said.zh.endswith("这张画面我没有看明白。")


@pytest.mark.parametrize(
    "answer", [ImageAnswer(text=say_same("a sofa")), ImageAnswer(failure="camera_silent")]
)
def test_nothing_is_excused_where_nothing_went_wrong(answer: ImageAnswer) -> None:
    act = look(after(ASKED, answer, text="what is there?"))
    assert isinstance(act, Finish)
    assert act.said is not None
    assert act.said.en.startswith(SEEN)
    assert len(act.said.en) < len(SEEN) + 20
    words = Bilingual(
        en="I see nothing that I know. A sofa.",
        zh="没有看到我认识的东西。",
    )
    assert act.read == (words if answer.text is not None else None), "no English in Chinese"


def test_a_model_looks_alone_where_there_is_no_detector() -> None:
    """No gaze would ever end there; a place that is named still has to be looked round in."""
    ahead = scene("look", step={"text": "what is there?"}, eyes=EYES, sight=Sight(blind=NONE))
    act = look(ahead)
    assert isinstance(act, AskImage)
    assert (act.words, act.point) == ("what is there?", False)
    told = look(
        after(
            ASKED,
            ImageAnswer(text=say_same("a man"), seen=True),
            text="有人吗？",
            sight=Sight(blind=NONE),
        )
    )
    assert isinstance(told, Finish)
    assert told.said == NO_DETECTOR, "without a detector nobody has seen that nobody is there"
    assert told.read is not None
    assert told.read.en == "A man."
    for other in (Sight(blind="camera_silent"), Sight()):
        assert not isinstance(look(replace(ahead, sight=other)), AskImage)
    there = scene(
        "look", step={"text": "?", "place": "kitchen"}, eyes=EYES, sight=Sight(blind=NONE)
    )
    assert not isinstance(look(there), AskImage)


@pytest.mark.parametrize(
    ("failure", "code", "told"),
    [
        ("not_in_picture", Code.NOT_FOUND, "not in the picture"),
        ("pictures_offhost", Code.NOT_FOUND, reason("pictures_offhost").en),
        ("no_pictures", Code.NOT_FOUND, reason("no_pictures").en),
        ("point_on_wall", Code.POINT_REFUSED, "wall"),
        ("point_off_map", Code.POINT_REFUSED, "outside"),
    ],
)
def test_a_model_s_point_that_leads_nowhere_says_why(failure: str, code: Code, told: str) -> None:
    act = go_to_object(after(ANSWER, ImageAnswer(failure=failure), object="dragon"))
    assert isinstance(act, Fail)
    assert (act.code, act.reason) == (code, failure)
    assert act.said is not None
    assert told in act.said.en
