"""What a look answers by what was seen, where it can't tell, and why a model did not look."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from planner.brain.model_error_codes import reason
from planner.perception.snapshot import Sight, Thing
from planner.plan import Bilingual, Code, StepRole, say_same
from planner.site.site_view import SiteView, Target
from planner.skills import Eyesight, Fail, Finish, ImageAnswer, Observe, Scene, act_of
from planner.skills.actions import UNSEEN, AskImage
from planner.skills.go_to_object import go_to_object
from planner.skills.look import NO_DETECTOR, look
from planner.skills.skill_state import (
    GoToObjectState,
    LookStage,
    LookState,
    PointingStage,
    SkillStateBase,
)
from tests.planner.mission.fakes import FACTS
from tests.planner.skills.looking import NOW_S, at, sight
from tests.planner.skills.scenes import said_of, scene
from wire import CameraConfig, Pose2

CLASSES = ("cup", "bottle", "table", "chair", "person", "box")


TABLE, CHAIR = at("table", 1.6, 0.4), at("chair", 2.2, 0.5)
ON_IT, BELOW, AWAY = at("cup", 1.7, 0.8), at("cup", 1.9, 0.05), at("cup", 3.2, 0.8)
VAGUE = at("cup", 1.7, 0.0, sigma_m=0.8)
BEFORE = {"seen_s": NOW_S - 60.0}


def asked(question: str, *things: Thing, **more: Any) -> Any:
    fields = {"eyes": Eyesight(CameraConfig(), CLASSES), "sight": sight(*things), "now_s": NOW_S}
    fields |= {"state": LookState(here=(0.0, 0.0), stage=LookStage.GAZED), "spent_s": 5.0}
    step = {"text": question, "place": more.pop("place", None), "role": more.pop("role", None)}
    return act_of(scene("look", step=step, **{**fields, **more}))


@pytest.mark.parametrize(
    ("things", "en", "zh"),
    [
        ((TABLE, ON_IT), "Yes, I see a cup on the table.", "有，在桌子上看到一个杯子。"),
        (
            (TABLE, ON_IT, BELOW),
            "Yes, I see a cup on the table.",
            "有，在桌子上看到一个杯子。",
        ),
        (
            (TABLE, AWAY),
            "No, I see no cup on the table. I see a cup elsewhere.",
            "没有，在桌子上没有看到杯子。我在别处看到一个杯子。",
        ),
        ((TABLE,), "No, I see no cup on the table.", "没有，在桌子上没有看到杯子。"),
        (
            (AWAY,),
            "I can't tell: I see a cup, but no table.",
            "我不能确定：看到一个杯子，但没有看到桌子。",
        ),
        (
            (),
            "I can't tell: I see no cup and no table.",
            "我不能确定：没有看到杯子，也没有看到桌子。",
        ),
        (
            (TABLE, VAGUE),
            "I can't tell: I see a cup, but not well enough where.",
            "我不能确定：看到一个杯子，但位置不够清楚。",
        ),
    ],
)
def test_it_is_said_whether_a_thing_stands_there_or_that_it_cannot_be_told(
    things: tuple[Thing, ...], en: str, zh: str
) -> None:
    for question in ("is the cup on the table?", "桌子上有杯子吗"):
        told = asked(question, *things)
        assert isinstance(told, Finish)
        assert (said_of(told).en, said_of(told).zh) == (en, zh)


@pytest.mark.parametrize(
    ("question", "things", "en"),
    [
        ("is there a cup under the table", (TABLE, ON_IT, BELOW), "Yes, I see a cup under the t"),
        ("is there a cup next to the table", (TABLE, at("cup", 2.8, 0.1)), "Yes, I see a cup near"),
        ("is there a cup on the shelf", (ON_IT,), "I see a cup, but I can't tell by sight whether"),
        ("is there a cup on the shelf", (), "I can't tell: I see no cup."),
        ("what is on the table?", (TABLE, CHAIR, ON_IT, AWAY), "I see a cup on the table."),
        ("what is on the table?", (TABLE, CHAIR), "I see nothing that I know on the table."),
        ("what is on the table?", (CHAIR,), "I can't tell: I see no table."),
        ("is there a cup on the floor", (BELOW, ON_IT), "Yes, I see a cup on the floor."),
        ("is there a cup on the floor", (ON_IT,), "No, I see no cup on the floor. I see a cup el"),
        ("is there a cup on the floor", (VAGUE,), "I can't tell: I see a cup, but not well"),
        ("is there a cup?", (ON_IT, AWAY), "Yes, I see two cups."),
    ],
)
def test_every_relation_is_judged_or_said_to_be_beyond_sight(
    question: str, things: tuple[Thing, ...], en: str
) -> None:
    told = asked(question, *things)
    assert told.said.en.startswith(en)


def test_no_is_said_of_a_neighbour_that_is_seen_now_and_not_of_one_that_is_remembered() -> None:
    remembered = at("table", 1.6, 0.4, **BEFORE)
    assert asked("is the cup on the table?", remembered).said.en.startswith("I can't tell")
    yes = asked("is the cup on the table?", remembered, ON_IT)
    assert yes.said.en == "Yes, I see a cup on the table."
    unsure = at("table", 1.6, 0.4, confidence=0.4)
    assert asked("is the cup on the table?", unsure, ON_IT).said.en.startswith("I can't tell")


def test_a_place_is_told_and_its_tables_alone_count() -> None:
    kitchen = at("table", 5.0, 0.4, room="kitchen"), at("cup", 5.0, 0.8, room="kitchen")
    done = {"place": "kitchen", "pose": Pose2(5.0, 0.0, 0.0)}
    told = asked("is there a cup on the table in the kitchen", *kitchen, TABLE, ON_IT, **done)
    assert told.said.en == "Yes, I see a cup on the table in the kitchen."
    told = asked("is there a cup on the table in the kitchen", TABLE, ON_IT, **done)
    assert told.said.en == "I can't tell: I see no cup and no table in the kitchen."


@pytest.mark.parametrize(
    ("question", "en", "zh"),
    [
        (
            "is there a cup on the table",
            "Yes, I see a cup on the table.",
            "有，在桌子上看到一个杯子。",
        ),
        ("is there a cup", "Yes, I see a cup near the table.", "有，在桌子附近看到一个杯子。"),
        ("桌子旁边有杯子吗", "Yes, I see a cup near the table.", "有，在桌子附近看到一个杯子。"),
    ],
)
def test_a_place_that_is_the_neighbour_itself_is_named_once(
    question: str, en: str, zh: str
) -> None:
    place = Target("table", False, Bilingual(en="table", zh="桌子"), Pose2(1.6, 0.0, 0.0))
    facts = SiteView({**FACTS.targets, "table": place}, home="table")
    told = asked(question, TABLE, ON_IT, at("cup", 5.0, 0.8), place="table", facts=facts)
    assert (said_of(told).en, said_of(told).zh) == (en, zh)


def test_how_a_place_is_that_is_the_thing_itself_is_told_without_naming_it_twice() -> None:
    place = Target("table", False, Bilingual(en="table", zh="桌子"), Pose2(1.6, 0.0, 0.0))
    facts = SiteView({**FACTS.targets, "table": place}, home="table")
    told = asked("is the table clean?", ON_IT, place="table", facts=facts)
    assert told.said == Bilingual(
        en="I can't tell: I see no table.", zh="我不能确定：没有看到桌子。"
    )


def test_an_unknown_kind_is_asked_about_once_a_step(monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[str] = []
    look = sys.modules["planner.skills.look"]  # its door has the function by that name
    tell: Callable[..., Bilingual | None] = look.tell_unknown

    def noted(scene: Any, question: str) -> Bilingual | None:
        calls.append(question)
        return tell(scene, question)

    monkeypatch.setattr(look, "tell_unknown", noted)
    state = LookState()
    for _ in range(60):
        act = asked("look around: is there a cup?", ON_IT, state=state)
        if isinstance(act, Finish):
            break
        assert not isinstance(act, Fail)
        state = act.then or state
        assert isinstance(act, Observe) or act.then is not None
    assert len(calls) == 1


def test_who_told_late_what_they_know_still_says_that_they_do_not_know_it() -> None:
    begun = asked("is there a piano?", ON_IT, state=LookState())
    assert isinstance(begun, Fail)
    assert begun.code is Code.OBJECT_UNKNOWN
    late = asked("is there a piano?", ON_IT)
    assert isinstance(late, Finish)
    assert "“piano”" in said_of(late).en


@pytest.mark.parametrize("things", [(), (ON_IT,)])
@pytest.mark.parametrize("question", ["is there a cup in the garage", "is the cup empty"])
def test_what_is_unclear_or_a_state_is_told_neither_yes_nor_no(
    question: str, things: tuple[Thing, ...]
) -> None:
    said = asked(question, *things).said
    assert "I can't tell" in said.en
    assert "不能确定" in said.zh or "看不出来" in said.zh
    unsure = asked(question, *things, role=StepRole.WHEN)
    assert (unsure.code, unsure.figures.get("holds")) == (Code.UNSURE, None)


@pytest.mark.parametrize("things", [(), (ON_IT,)])
@pytest.mark.parametrize("seen", [True, False])
def test_the_branch_on_a_state_is_the_one_that_is_told(
    seen: bool, things: tuple[Thing, ...]
) -> None:
    """A cup is there, and the model says of its state what the branch goes by."""
    eyes = Eyesight(CameraConfig(), CLASSES, model=True)
    word = "Yes" if seen else "No"
    answer = ImageAnswer(say_same(f"{word}, it is."), seen)
    state = LookState(here=(0.0, 0.0), stage=LookStage.ASKED, faced=(0.0,))
    told = asked(
        "is the cup empty", *things, eyes=eyes, answer=answer, state=state, role=StepRole.WHEN
    )
    assert told.figures["holds"] is seen
    assert "cup" in told.said.en
    assert not told.said.en.startswith(("Yes", "No,"))
    assert f"{word}, it is." in told.read.en


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
    assert said_of(act).en.startswith(SEEN)
    assert said_of(act).en.endswith(reason(code).en)
    assert said_of(act).zh.endswith(reason(code).zh)
    assert act.read is None


def test_what_can_not_be_used_of_a_picture_is_not_called_a_plan() -> None:
    act = look(after(ASKED, ImageAnswer(failure="bad_plan"), text="what is there?"))
    assert isinstance(act, Finish)
    assert said_of(act).en.endswith("I could not make sense of the picture.")
    assert said_of(act).zh.endswith("这张画面我没有看明白。")


@pytest.mark.parametrize(
    "answer", [ImageAnswer(text=say_same("a sofa")), ImageAnswer(failure="camera_silent")]
)
def test_nothing_is_excused_where_nothing_went_wrong(answer: ImageAnswer) -> None:
    act = look(after(ASKED, answer, text="what is there?"))
    assert isinstance(act, Finish)
    assert said_of(act).en.startswith(SEEN)
    assert len(said_of(act).en) < len(SEEN) + 20
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
    assert told in said_of(act).en
