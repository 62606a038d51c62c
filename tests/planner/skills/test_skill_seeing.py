"""What skills that look make of a sight; a model's point is driven to upon a plain yes alone."""

from __future__ import annotations

from dataclasses import replace
from math import hypot, pi
from typing import Any

import pytest

from planner.plan import Bilingual, Code, say_same
from planner.settings.model import ModelSettings
from planner.site.site_view import SiteView, Target
from planner.skills import (
    AskImage,
    DriveLeg,
    Eyesight,
    Fail,
    Finish,
    Observe,
    Question,
    SkillAction,
    Way,
    act_of,
)
from planner.skills.go_to_object import NEAREST_M, SIDES_RAD
from planner.skills.look import reading
from planner.skills.object_matching import (
    APART_S,
    drop_doubles,
    find_mentioned,
    fits,
    list_confirmed,
)
from planner.skills.perception import ImageAnswer, WantedObject
from planner.skills.result_text import found_at, list_things, looked_in, name_count
from planner.skills.scene_answers import SceneAnswer
from planner.skills.skill_state import (
    AimStage,
    ApproachStage,
    FindState,
    FollowPersonState,
    FollowStage,
    GoToObjectState,
    LookStage,
    LookState,
    PointingStage,
)
from planner.skills.spatial_relations import support_of
from planner.skills.viewpoints import REACH_M, in_order, room_of, spots_in
from tests.planner.mission.fakes import FACTS
from tests.planner.skills.looking import EYES, HERE, NOW_S, looking, sight, thing
from tests.planner.skills.scenes import said_of, scene
from wire import CameraConfig, Pose2


def test_what_is_sure_fits_and_is_fresh_is_told_and_nothing_else() -> None:
    told = looking("find", thing(), gazed_s=NOW_S - 1.0)
    assert isinstance(told, Finish)
    assert told.code is Code.FOUND
    assert told.figures["found"].distance_m == 1.6
    for other in (
        {"color": "blue"},
        {"color": None},
        {"label": "ball"},
        {"confidence": 0.4},
        {"sightings": 1},
        {"seen_s": NOW_S - 2.0},
    ):
        assert isinstance(looking("find", thing(**other), gazed_s=NOW_S - 1.0), (DriveLeg, Observe))


def test_what_is_remembered_is_looked_at_again_once() -> None:
    near = looking("find", thing(y_m=1.6))
    assert isinstance(near, DriveLeg)
    assert near.way is Way.SPIN
    assert near.goal.yaw_rad == pytest.approx(pi / 4)
    far = looking("find", thing(x_m=4.0, room="kitchen"))
    assert isinstance(far, DriveLeg)
    assert far.way is Way.ROUTE
    assert hypot(far.goal.x_m - 4.0, far.goal.y_m) == pytest.approx(1.6)
    assert isinstance(far.otherwise, FindState)
    assert far.otherwise.tried == ("cup_1",)
    gaze = looking("find", thing(), state=FindState(aim="cup_1", aim_stage=AimStage.FACING))
    assert isinstance(gaze, Observe)
    assert isinstance(gaze.then, FindState)
    assert gaze.then.tried == ("cup_1",)
    tried = looking("find", thing(), state=gaze.then)
    assert isinstance(tried, (DriveLeg, Observe))
    assert isinstance(tried.then, FindState)
    assert tried.then.spot == "here", "then it looks round"


def test_a_thing_whose_colour_light_may_have_changed_is_looked_at_last_of_all() -> None:
    doubtful, other = thing(color="brown"), thing(id="cup_2", color="blue", y_m=0.8)
    state, acts = FindState(), []
    for _ in range(200):  # each act is done as it asks
        act = looking("find", doubtful, other, state=state)
        acts.append(act)
        if isinstance(act, Fail):
            break
        state = act.then or state
    assert isinstance(acts[-1], Fail)
    assert state.tried == ("cup_1",), "a red cup may look brown, and never blue"
    again = next(i for i, act in enumerate(acts) if act.then.tried)
    assert again >= len(acts) - 2, "after all rooms"
    assert acts[-1].said is not None
    assert acts[-1].said.en.endswith("I saw a brown cup; light may change a colour.")
    assert acts[-1].said.zh.endswith("看到了一个棕色的杯子；光线可能让颜色看起来不一样。")


def test_rooms_come_in_a_sensible_order() -> None:
    square = ((-1, -1), (1, -1), (1, 1), (-1, 1))

    def room(name: str, x_m: float) -> Target:
        around = tuple((x + x_m, y) for x, y in square)
        return Target(name, True, Bilingual(en=name, zh=name), Pose2(x_m, 0, 0), around)

    facts = SiteView(
        {n: room(n, x) for n, x in (("a", 0), ("b", 4), ("c", 8), ("d", -6))}, home="a"
    )
    assert in_order(facts, HERE, ()) == ("a", "b", "c", "d")
    assert in_order(facts, Pose2(8, 0, 0), ()) == ("c", "b", "a", "d")
    assert in_order(facts, HERE, (thing(room="d"),)) == ("a", "d", "b", "c")
    assert in_order(facts, Pose2(20, 0, 0), ()) == ("c", "b", "a", "d"), "in no room"
    assert room_of(FACTS, "dock") == "hall"


@pytest.mark.parametrize(("wide_m", "deep_m", "most"), [(3.0, 3.0, 1), (5.0, 4.5, 2), (9, 5, 4)])
def test_a_large_room_is_looked_at_from_several_spots(
    wide_m: float, deep_m: float, most: int
) -> None:
    outline = ((0.0, 0.0), (wide_m, 0.0), (wide_m, deep_m), (0.0, deep_m))
    middle = Pose2(wide_m / 2, deep_m / 2, 0.0)
    spots = spots_in(Target("r", True, Bilingual(en="r", zh="r"), middle, outline))
    assert 1 <= len(spots) <= most
    corners = [(x + dx, y + dy) for x, dx in ((0, 0.3), (wide_m, -0.3))
               for y, dy in ((0, 0.3), (deep_m, -0.3))]  # fmt: skip
    for x, y in corners:
        assert min(hypot(s.at[0] - x, s.at[1] - y) for s in spots) < REACH_M + 0.4


def test_people_are_told_without_the_colour_of_their_clothes_and_stand_on_nothing() -> None:
    somebody = thing(label="person", color="green", sightings=9)
    other = replace(somebody, id="2", color="red")
    assert list_things([somebody, other]) == Bilingual(en="two people", zh="两个人")
    assert found_at(FACTS, "person", "green", None, None).en == "I found a person."
    sofa = replace(somebody, id="3", label="sofa")
    assert support_of(somebody, (somebody, other, sofa)) is None


def test_sentences_are_whole_in_both_languages() -> None:
    assert name_count(2, "cup", "red") == Bilingual(en="two red cups", zh="两个红色的杯子")
    assert name_count(3, "person").en == "three people"
    assert name_count(2, "box").en == "two boxes"
    assert name_count(1, "person").zh == "一个人"
    assert found_at(FACTS, "ball", "orange", None, None).en == "I found an orange ball."
    looked = looked_in(FACTS, ("hall",), ("kitchen",), None)
    assert looked.en == "I looked in the hall. I found no way to the kitchen."
    assert looked.zh == "我看过了hall。我去不了kitchen。"
    assert list_things(
        [thing(), thing(id="2", x_m=0.0), thing(id="3", label="chair", color=None)]
    ) == (Bilingual(en="two red cups and a chair", zh="两个红色的杯子和一把椅子"))


@pytest.mark.parametrize(
    ("question", "label"),
    [
        ("有没有人？", "person"),
        ("is there a red cup on the table?", "cup"),
        ("do you see anyone here", "person"),
        ("what do you see?", None),
        ("看到了什么", None),
    ],
)
def test_what_a_question_asks_for_is_read(question: str, label: str | None) -> None:
    asked = find_mentioned(question, EYES.classes)
    assert (asked.label if asked is not None else None) == label


def test_things_on_one_spot_are_counted_once() -> None:
    twice = thing(), thing(id="cup_2", x_m=1.65), thing(id="cup_3", x_m=2.6)
    assert [t.id for t in drop_doubles(twice)] == ["cup_1", "cup_3"]
    assert fits(thing(), WantedObject("cup"))
    assert not list_confirmed(sight(thing(confidence=0.5)), None, 0.0)


def test_without_means_a_step_is_refused_and_a_model_may_point() -> None:
    blind = replace(sight(), blind="no_detector")
    for eyes, seen, code in (
        (Eyesight(), sight(), Code.NO_CAMERA),
        (Eyesight(CameraConfig(kind="none")), sight(), Code.NO_CAMERA),
        (EYES, blind, Code.NO_DETECTOR),
    ):
        act = looking("find", eyes=eyes, sight=seen)
        assert isinstance(act, Fail)
        assert act.code is code
    unknown = looking("find", step={"object": "guitar"})
    assert isinstance(unknown, Fail)
    assert unknown.code is Code.OBJECT_UNKNOWN
    model = replace(EYES, model=True)
    pointing = GoToObjectState(pointing=PointingStage.POINT)
    asks = looking("go_to_object", step={"object": "guitar"}, eyes=model, state=pointing)
    then = GoToObjectState(pointing=PointingStage.ANSWER)
    assert asks == AskImage("guitar", point=True, then=then)
    which: dict[str, Any] = {"step": {"object": "the small cup"}, "state": pointing}
    assert isinstance(looking("go_to_object", thing(), eyes=model, **which), AskImage)
    assert isinstance(looking("go_to_object", thing(), **which), Fail)


def test_a_models_words_are_for_people_and_the_detectors_are_told_beside_them() -> None:
    model = replace(EYES, model=True)
    step = {"object": None, "text": "what do you see?"}
    assert isinstance(looking("look", step=step, eyes=model), Observe)
    asked = looking("look", step=step, eyes=model, state=LookState(stage=LookStage.GAZED))
    assert isinstance(asked, AskImage)
    words = Bilingual(en="A sign: go to the kitchen", zh="牌子：去厨房")
    done = looking(
        "look", thing(), step=step, eyes=model, state=LookState(stage=LookStage.ASKED), spent_s=3.0,
        answer=ImageAnswer(text=words),
    )  # fmt: skip
    assert isinstance(done, Finish)
    assert done.read == Bilingual(
        en="I see a red cup. A sign: go to the kitchen.",
        zh="看到一个红色的杯子。牌子：去厨房。",
    )
    assert done.said == Bilingual(en="I see a red cup.", zh="看到一个红色的杯子。")


def test_an_answer_is_waited_for_as_long_as_a_model_may_be_given() -> None:
    longest_s = ModelSettings.model_json_schema()["properties"]["timeout_s"]["maximum"]
    assert longest_s < AskImage().seconds


def test_one_picture_alone_sets_nothing_off_and_proves_nothing() -> None:
    anna = {"id": "person_1", "label": "person", "color": None, "x_m": 3.0}
    step: dict[str, Any] = {"step": {"object": "person"}}
    ghost = looking("follow", thing(**anna, sightings=1), **step)
    assert isinstance(ghost, Observe)
    assert isinstance(looking("follow", thing(**anna, sightings=2), **step), DriveLeg)
    known = FollowPersonState(at=(3.0, 0.0, 0.9), label="person")
    assert isinstance(looking("follow", thing(**anna, sightings=1), state=known, **step), DriveLeg)
    there = GoToObjectState(
        approach=ApproachStage.JUDGE, at=(1.6, 0.0, 0.8), label="cup", color="red"
    )
    gazed: dict[str, Any] = {"state": there, "gazed_s": NOW_S - 1.0}
    unsure = thing(sightings=2, confidence=0.4)
    assert isinstance(looking("go_to_object", unsure, **gazed), Finish), "it was found before"
    assert not isinstance(looking("go_to_object", thing(sightings=1), **gazed), Finish)


def test_what_was_seen_for_a_moment_only_sets_nothing_off() -> None:
    anna = {"id": "person_1", "label": "person", "color": None, "x_m": 3.0}
    step: dict[str, Any] = {"step": {"object": "person"}}
    glimpsed, watched = NOW_S - 0.5 - APART_S + 0.01, NOW_S - 0.5 - APART_S
    for state in (
        FollowPersonState(),
        FollowPersonState(stage=FollowStage.ROUND, spot="here", turned=2),
    ):
        act = looking("follow", thing(**anna, first_s=glimpsed), state=state, **step)
        assert isinstance(act, Observe), "watched until that is sure, standing too"
        assert act.watch
        assert (act.state, act.then) == (state, state)
        assert isinstance(looking("follow", thing(**anna, first_s=watched), **step), DriveLeg)
    late = looking("follow", thing(**anna, first_s=glimpsed), spent_s=26.0, **step)
    assert isinstance(late, Fail), "not for ever"
    gone = looking("follow", thing(**anna, first_s=glimpsed, seen_s=NOW_S - 2.0), **step)
    assert isinstance(gone, Observe)
    assert gone.then == FollowPersonState(stage=FollowStage.ROUND), "then it looks round"


def test_a_thing_that_was_seen_for_a_moment_is_looked_at_again_before_the_way_to_it() -> None:
    glimpsed = thing(first_s=NOW_S - 0.6)
    gazed: dict[str, Any] = {"gazed_s": NOW_S - 1.0}
    again = looking("go_to_object", glimpsed, **gazed)
    assert isinstance(again, Observe)
    assert isinstance(again.then, GoToObjectState)
    assert again.then.tried == ("cup_1",)
    near = looking("go_to_object", glimpsed, state=again.then, **gazed)
    assert isinstance(near.then, GoToObjectState)
    assert near.then.at is not None, "it is there yet"
    over = looking("go_to_object", thing(first_s=NOW_S - 3.0, seen_s=NOW_S - 2.9),
                   state=again.then, **gazed)  # fmt: skip
    assert over.then.at is None, "it looks on"
    passed = looking("go_to_object", replace(glimpsed, x_m=0.0, y_m=1.6))
    assert isinstance(passed, DriveLeg)
    assert passed.way is Way.SPIN
    assert isinstance(looking("go_to_object", thing(first_s=NOW_S - 3.0)).then, GoToObjectState)


def test_what_was_seen_on_the_way_and_is_hidden_from_where_one_stands_is_said_to_be_there() -> None:
    at = (1.6, 0.0, 0.8)
    arrived = GoToObjectState(approach=ApproachStage.FACE, at=at, label="cup", color="red")
    look = looking("go_to_object", thing(seen_s=NOW_S - 4.0), state=arrived)
    assert isinstance(look, Observe)
    judge, gazed = look.then, {"gazed_s": NOW_S - 1.0}
    assert judge is not None
    hidden = looking("go_to_object", thing(seen_s=NOW_S - 5.0, x_m=1.5), state=judge, **gazed)
    assert isinstance(hidden, Finish)
    assert "1.5 m" in said_of(hidden).en, "by where it was seen last"
    blue = thing(id="cup_2", color="blue", seen_s=NOW_S - 0.2)
    beside = looking("go_to_object", blue, thing(seen_s=NOW_S - 5.0, x_m=1.5), state=judge, **gazed)
    assert beside == hidden, "the blue one beside it is told by nobody"
    for other in (
        thing(seen_s=NOW_S - 5.0, confidence=0.89),  # it should have been seen
        thing(seen_s=NOW_S - 21.0),
        thing(seen_s=NOW_S - 5.0, x_m=2.3),
    ):
        assert not isinstance(looking("go_to_object", other, state=judge, **gazed), Finish)
    doubtful = judge.but(sure=0.5)
    unsure = thing(seen_s=NOW_S - 5.0, confidence=0.5)
    assert not isinstance(looking("go_to_object", unsure, state=doubtful, **gazed), Finish)
    unknown = judge.but(sure=None)
    seen = thing(seen_s=NOW_S - 5.0)
    assert not isinstance(looking("go_to_object", seen, state=unknown, **gazed), Finish)


def test_what_was_not_seen_on_the_way_is_not_said_to_be_there() -> None:
    at = (0.9, 0.0, 0.05)
    state = GoToObjectState(approach=ApproachStage.FACE, at=at, label="cup", color="red")
    assert not EYES.should_see(HERE, at), "it lies before the feet"
    there = thing(x_m=0.9, z_m=0.05, seen_s=NOW_S - 9.0)
    assert isinstance(looking("go_to_object", there, state=state), Finish)
    for other in (replace(there, confidence=0.29), replace(there, color="blue")):
        assert not isinstance(looking("go_to_object", other, state=state), Finish)
    again = looking("go_to_object", state=state)
    assert isinstance(again, (DriveLeg, Observe)), "it is looked for once more"
    told = looking("go_to_object", state=state.but(again=1))
    assert isinstance(told, Fail)
    assert told.reason == "moved"


YES, NO = (
    Bilingual(en="Yes, I see a cup.", zh="有，看到一个杯子。"),
    Bilingual(en="No, I see no cup.", zh="没有，没有看到杯子。"),
)


@pytest.mark.parametrize(
    ("told", "seen", "words", "en", "zh"),
    [
        (SceneAnswer(YES, True), True, Bilingual(en="Yes, a red one.", zh="有，红色的。"),
         "Yes, I see a cup: a red one.", "有，看到一个杯子：红色的。"),
        (SceneAnswer(YES, True), False, Bilingual(en="No. Only a wall", zh="没有，只有墙"),
         "Yes, I see a cup. But at a second look I am less sure: Only a wall.",
         "有，看到一个杯子。不过再看一眼，我没有那么确定：只有墙。"),
        (SceneAnswer(NO, False), True, Bilingual(en="Yes: behind the box", zh="有：在箱子后面"),
         "I think so, but I am not sure: behind the box.", "好像有，但我不确定：在箱子后面。"),
        (SceneAnswer(NO, False), False, say_same("No"),
         "No, I see no cup.", "没有，没有看到杯子。"),
        (SceneAnswer(YES), False, Bilingual(en="No, it is empty", zh="不，是空的"),
         "No, it is empty.", "不，是空的。"),
        (SceneAnswer(YES), False, say_same("杯子是空的。"), "No.", "杯子是空的。"),
        (SceneAnswer(YES, lists=True), None, Bilingual(en="it is full", zh="是满的"),
         "Yes, I see a cup. It is full.", "有，看到一个杯子。是满的。"),
        (SceneAnswer(YES, lists=True), None, say_same("it is full"),
         "Yes, I see a cup. It is full.", "有，看到一个杯子。"),
    ],
)  # fmt: skip
def test_two_eyes_make_one_answer_in_the_persons_language(
    told: SceneAnswer, seen: bool | None, words: Bilingual, en: str, zh: str
) -> None:
    assert reading(words, seen, told) == Bilingual(en=en, zh=zh)


MODEL_EYES = Eyesight(CameraConfig(), ("cup",), model=True)
AT = (4.0, 0.5, 0.4)
PROPOSED, AGAIN = PointingStage.PROPOSED, PointingStage.AGAIN
ANSWER = GoToObjectState(pointing=PointingStage.ANSWER)
ASKED = GoToObjectState(pointing=PROPOSED, pointed=AT)


def going(reply: str | None = None, **more: Any) -> SkillAction:
    """Return what a goal to the guitar does next, where a person answered so."""
    step = {"object": "guitar", "answer": reply}
    return act_of(scene("go_to_object", step=step, **({"eyes": MODEL_EYES, "state": ASKED} | more)))


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
    for eyes in (
        MODEL_EYES,
        Eyesight(CameraConfig(), ("cup",)),
        Eyesight(CameraConfig(), ("guitar",)),
    ):
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
    assert said_of(act).en == "You did not say yes, so I do not drive there."


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
