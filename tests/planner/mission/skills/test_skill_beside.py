"""A thing told by its neighbour: what the words mean, where it stands, what skills make of it."""

from __future__ import annotations

from typing import Any

import pytest

from planner.language.questions import Relation
from planner.mission.skills import DriveLeg, Eyesight, Fail, Finish, Observe, WantedObject, act_of
from planner.mission.skills.object_matching import picks_out, read_object
from planner.mission.skills.skill_state import CountState, GoToObjectState
from planner.mission.skills.spatial_relations import stands
from planner.mission.skills.state_base import SkillStateBase
from planner.perception.snapshot import LookSnapshot, Sight, Thing
from planner.plan import Code, Language
from tests.planner.mission.skills.scenes import scene
from wire import CameraConfig, Pose2

CLASSES = ("cup", "bottle", "table", "chair", "person", "box")
ON, UNDER, NEAR = Relation
NOW_S = 100.0


def at(label: str, x_m: float, z_m: float, **more: Any) -> Thing:
    fields: dict[str, Any] = {
        "id": f"{label}_{x_m}", "label": label, "color": None, "x_m": x_m, "y_m": 0.0, "z_m": z_m,
        "sigma_m": 0.03, "confidence": 0.9, "seen_s": NOW_S - 0.5, "first_s": 0.0, "sightings": 5,
        "room": "hall",
    }  # fmt: skip
    return Thing(**{**fields, **more})


TABLE = at("table", 1.6, 0.4)


@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        ("the bottle on the table", WantedObject("bottle", None, ON, WantedObject("table"))),
        (
            "red cup next to a blue chair",
            WantedObject("cup", "red", NEAR, WantedObject("chair", "blue")),
        ),
        ("box under the desk", WantedObject("box", None, UNDER, WantedObject("table"))),
        ("桌子上的瓶子", WantedObject("bottle", None, ON, WantedObject("table"))),
        ("椅子旁边的红色的杯子", WantedObject("cup", "red", NEAR, WantedObject("chair"))),
        ("桌子下面的箱子", WantedObject("box", None, UNDER, WantedObject("table"))),
    ],
)
def test_a_neighbour_is_read_in_both_languages(words: str, wanted: WantedObject) -> None:
    for language in Language:
        assert read_object(words, language, CLASSES) == wanted
    assert not picks_out(words, "go_to_object", Language.EN, CLASSES)
    assert picks_out(words, "follow", Language.EN, CLASSES), "who walks has no neighbour"


@pytest.mark.parametrize(
    "words",
    [
        "bottle on the shelf", "cup on the small table", "the other cup on the table",
        "chair beside the window", "cup on the left", "窗户旁边的椅子", "小桌子上的杯子",
        "椅子旁边的桌子上的杯子", "small cup", "大箱子",
    ],
)  # fmt: skip
def test_what_these_eyes_cannot_judge_still_picks_one_out(words: str) -> None:
    assert picks_out(words, "go_to_object", Language.EN, CLASSES)
    wanted = read_object(words, Language.EN, CLASSES)
    assert wanted is None or wanted.by is None


@pytest.mark.parametrize(
    ("thing", "on", "under", "near"),
    [
        (at("bottle", 1.6, 0.8), True, False, True),
        (at("bottle", 2.2, 0.8), True, False, True),
        (at("bottle", 2.4, 0.8), False, False, True),
        (at("bottle", 2.4, 0.8, sigma_m=0.2), True, False, True),
        (at("box", 1.8, 0.1), False, True, True),
        (at("box", 2.8, 0.1), False, False, True),
        (at("box", 3.0, 0.1), False, False, False),
        (TABLE, False, False, False),
    ],
)
def test_positions_say_how_things_stand(thing: Thing, on: bool, under: bool, near: bool) -> None:
    assert tuple(stands(thing, how, TABLE) for how in Relation) == (on, under, near)


def looking(kind: str, words: str, *things: Thing, **more: Any) -> Any:
    sight = Sight(LookSnapshot(1, NOW_S, Pose2(0.0, 0.0, 0.0), 320, 240, ()), things)
    fields = {"eyes": Eyesight(CameraConfig(), CLASSES), "sight": sight, "now_s": NOW_S}
    return act_of(scene(kind, step={"object": words}, **{**fields, **more}))


THERE, OTHER = at("bottle", 1.7, 0.8), at("bottle", 0.9, 0.1)
GAZED: dict[str, Any] = {"gazed_s": NOW_S - 1.0, "spent_s": 5.0}


def test_nobody_is_followed_by_a_neighbour_and_what_is_said_of_it_does_not_offer_one() -> None:
    act = looking("follow", "person near the chair")
    assert isinstance(act, Fail)
    assert act.said is not None
    assert "nearest one in sight" in act.said.en
    assert "最近的一个" in act.said.zh


@pytest.mark.parametrize("words", ["bottle on the table", "桌子上的瓶子"])
def test_only_what_stands_there_is_found_and_gone_to(words: str) -> None:
    found = looking("find", words, OTHER, THERE, TABLE, **GAZED)
    assert isinstance(found, Finish)
    assert found.figures["found"].x_m == 1.7
    assert found.said is not None
    assert "a bottle on the table" in found.said.en
    assert "桌子上的一个瓶子" in found.said.zh
    goes = looking("go_to_object", words, OTHER, THERE, TABLE, **GAZED)
    assert isinstance(goes, (DriveLeg, Observe))
    assert isinstance(goes.then, GoToObjectState)
    assert goes.then.at is not None
    assert goes.then.at[0] == 1.7
    unsure = at("table", 1.6, 0.4, confidence=0.4)
    for seen in ((OTHER, TABLE), (THERE,), (THERE, unsure)):
        assert isinstance(looking("find", words, *seen, **GAZED), (DriveLeg, Observe)), (
            "it looks on"
        )


def test_what_does_not_stand_there_is_not_told_of_nor_counted() -> None:
    words, spent = "bottle on the table", {"spent_m": 56.0}
    ended = looking("find", words, OTHER, TABLE, **GAZED, **spent)
    assert isinstance(ended, Fail)
    assert ended.said is not None
    assert ended.said.en.startswith("I saw no bottle on the table.")
    number = looking("count", words, OTHER, THERE, TABLE, state=CountState(), **GAZED, **spent)
    assert isinstance(number, Finish)
    assert (number.code, number.figures["count"]) == (Code.COUNTED, 1)
    assert number.said is not None
    assert "a bottle on the table" in number.said.en


def counted(words: str, *things: Thing, shut: bool = False) -> Finish:
    """Count to the end, in a hall and a kitchen, with these things in sight."""
    state: SkillStateBase = CountState()
    pose = Pose2(0.0, 0.0, 0.0)
    for _ in range(60):
        act = looking("count", words, *things, state=state, pose=pose, spent_s=5.0)
        if isinstance(act, Finish):
            return act
        assert isinstance(act, (DriveLeg, Observe))
        state = act.then or state
        if isinstance(act, DriveLeg) and shut and act.goal.x_m > 2.0:
            state = act.otherwise or state
        elif isinstance(act, DriveLeg):
            pose = act.goal
    raise AssertionError(state)


ON_IT = at("bottle", 4.1, 0.8, room="kitchen"), at("bottle", 3.8, 0.8, room="kitchen")
KITCHEN = (at("table", 4.0, 0.4, room="kitchen"), *ON_IT)
HALL = (at("table", 0.5, 0.4), at("bottle", 0.5, 0.8))


@pytest.mark.parametrize(
    ("words", "things", "number", "said", "rooms"),
    [
        ("bottles on the table", (*HALL, *KITCHEN), 1, "a bottle on the table in the hall.", 1),
        ("桌子上的瓶子", (*HALL, *KITCHEN), 1, "a bottle on the table in the hall.", 1),
        ("bottles on the table", KITCHEN, 2, "two bottles on the table in the kitchen.", 2),
        ("bottles on the tables", (*HALL, *KITCHEN), 3, "three bottles on the table. I looked", 2),
        ("每张桌子上的瓶子", (*HALL, *KITCHEN), 3, "three bottles on the table. I looked", 2),
        ("bottles on the table", ON_IT, 0, "no tables. I looked in the hall and kitchen.", 2),
    ],
)
def test_the_table_is_the_first_one_that_is_come_by(
    words: str, things: tuple[Thing, ...], number: int, said: str, rooms: int
) -> None:
    done = counted(words, *things)
    assert done.said is not None
    assert done.said.en.startswith(f"I saw {said}")
    assert done.figures == {"count": number, "rooms": ("hall", "kitchen")[:rooms]}


def test_a_number_is_said_with_its_measure_word() -> None:
    said = [counted("bottles on the table", *things).said for things in (KITCHEN, ON_IT)]
    told = [s.zh.partition("。")[0] for s in said if s]
    assert told == ["在kitchen看到桌子上的两个瓶子", "没有看到桌子"]


def test_a_table_to_which_there_is_no_way_is_told_of_as_such() -> None:
    done = counted("bottles on the table", *KITCHEN, shut=True)
    assert done.said is not None
    assert done.said.en.endswith("I looked in the hall. I found no way to the kitchen.")
