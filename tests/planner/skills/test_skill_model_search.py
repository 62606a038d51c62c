"""What no detector knows is looked for by a vision model: direction by direction, within bounds.

A scripted model stands in for the owner's; the skill is walked act by act, as the mission does.
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.plan import Code, StepRole
from planner.skills import AskImage, DriveLeg, Eyesight, Fail, Finish, Observe, act_of
from planner.skills.model_search import count_between
from planner.skills.perception import ImageAnswer, PictureCost, PictureLimits
from planner.skills.skill_state import DirectionSeen, FindState
from tests.planner.mission.fakes import FACTS
from tests.planner.skills.looking import HERE, NOW_S, sight
from tests.planner.skills.scenes import said_of, scene
from wire import CameraConfig, Pose2

EACH = PictureCost(2000, 0.001)
LIMITS = PictureLimits(30, EACH, "USD")
EYES = Eyesight(CameraConfig(), ("cup", "person"), model=True, pictures=LIMITS)
PAID = PictureCost(1700, 0.0008)
NO = ImageAnswer(counts=(0, 0, 0), sure=0.9, cost=PAID)
YES = ImageAnswer(counts=(1, 0, 0), sure=0.8, cost=PAID)
Model = Callable[[Pose2, int], ImageAnswer]


class Walked:
    """Hold what a search did and came to."""

    def __init__(self) -> None:
        self.asked: list[Pose2] = []
        self.words: list[str] = []
        self.goals: list[Pose2] = []
        self.bills: list[tuple[int, int]] = []
        self.end: Any = None

    @property
    def kind(self) -> str:
        """Return what the step ended in."""
        return type(self.end).__name__


def walk(kind: str, model: Model, *, eyes: Eyesight = EYES, **step: Any) -> Walked:
    """Carry out each act as it asks, the model's answers among them, until the step ends."""
    told, pose, state, answer = Walked(), HERE, None, None
    record = {"object": "umbrella stand"} | step
    for _ in range(400):
        more: dict[str, Any] = {"state": state} if state is not None else {}
        act: Any = act_of(
            scene(kind, step=record, pose=pose, eyes=eyes, sight=sight(), now_s=NOW_S,
                  answer=answer, **more)
        )  # fmt: skip
        answer = None
        if isinstance(act, (Finish, Fail)):
            told.end = act
            return told
        if act.bill is not None:
            told.bills.append((act.bill.pictures, act.bill.tokens))
        if isinstance(act, AskImage):
            assert act.seek
            told.asked.append(pose)
            told.words.append(act.words)
            answer = model(pose, len(told.asked))
        elif isinstance(act, DriveLeg):
            told.goals.append(act.goal)
            pose = act.goal
        else:
            assert isinstance(act, Observe)
        state = act.then
    raise AssertionError("the search does not end")


def test_one_picture_is_told_as_one() -> None:
    told = walk("find", lambda _, n: YES, place="kitchen")
    assert told.end.said.en.startswith("I looked in the kitchen (one picture).")


def test_it_turns_direction_by_direction_and_asks_once_a_picture() -> None:
    told = walk("find", lambda _, n: YES if n == 4 else NO, place="kitchen")
    assert told.kind == "Finish"
    assert told.end.code is Code.FOUND
    headings = [pose.yaw_rad for pose in told.asked]
    assert len(set(headings)) == 4, "another direction each time"
    assert told.words == ["umbrella stand"] * 4
    assert told.end.said.en == ("I looked in the kitchen (4 pictures).")
    assert told.end.read is not None
    assert told.end.read.en == (
        "I am 80 % sure that I see “umbrella stand” before me in the kitchen, on the left (1)."
    )
    assert "umbrella stand" in told.end.read.zh
    assert "found" not in told.end.figures, "no place on the map comes from a model's words"
    assert told.end.figures["bill"].pictures == 4


def test_the_cost_stands_there_before_the_first_picture_and_after_each() -> None:
    told = walk("find", lambda _, n: YES if n == 3 else NO, place="kitchen")
    assert told.bills[0] == (0, 0), "before"
    assert [tokens for _, tokens in told.bills] == sorted(t for _, t in told.bills)
    assert told.bills[-1] == (2, 3400)
    bill = told.end.figures["bill"]
    assert (bill.pictures, bill.pictures_most, bill.tokens, bill.tokens_most) == (
        3,
        30,
        5100,
        60000,
    )
    assert (bill.money, bill.money_most, bill.currency) == (0.0024, 0.03, "USD")
    free = walk("find", lambda *_: YES, eyes=Eyesight(
        CameraConfig(), ("cup",), model=True, pictures=PictureLimits(30, PictureCost(2000))
    ))  # fmt: skip
    assert free.end.figures["bill"].money is None
    assert "cost" not in free.end.said.en


def test_a_no_needs_every_direction_of_every_room() -> None:
    told = walk("find", lambda *_: NO)
    rooms = [t for t in FACTS.targets.values() if t.room]
    assert len(told.asked) == EYES.views * len(rooms)
    assert told.kind == "Fail"
    assert (told.end.code, told.end.reason) == (Code.NOT_FOUND, "not_found")
    assert said_of(told.end).en.startswith(
        "I saw no umbrella stand. None of the pictures shows it. I looked"
    )
    when = walk("find", lambda *_: NO, role=StepRole.WHEN)
    assert when.kind == "Finish"
    assert when.end.figures["holds"] is False
    yes = walk("find", lambda *_: YES, role=StepRole.WHEN)
    assert yes.end.figures["holds"] is True


@pytest.mark.parametrize("most", [1, 5, 7])
def test_no_more_pictures_go_out_than_the_owner_allows(most: int) -> None:
    eyes = Eyesight(CameraConfig(), ("cup",), model=True, pictures=PictureLimits(most, EACH))
    for kind in ("find", "count"):
        told = walk(kind, lambda *_: NO, eyes=eyes)
        assert len(told.asked) == most
        assert f"no more pictures than {most}." in told.end.said.en
    when = walk("find", lambda *_: NO, eyes=eyes, role=StepRole.WHEN)
    if most < EYES.views:
        assert when.kind == "Fail"
        assert when.end.code is Code.UNSURE, "no room was looked in"
    else:
        assert when.kind == "Finish"
        assert when.end.figures["holds"] is False, "it ran out: the person's else is taken"


@pytest.mark.parametrize(
    ("failure", "pictures", "code"),
    [
        ("out_of_budget", 1, Code.OUT_OF_BUDGET),
        ("pictures_offhost", 1, Code.MODEL_UNAVAILABLE),
        ("no_pictures", 1, Code.MODEL_UNAVAILABLE),
        ("resting", 1, Code.MODEL_UNAVAILABLE),
        ("timed_out", 2, Code.MODEL_UNAVAILABLE),
        ("bad_plan", 2, Code.MODEL_UNAVAILABLE),
        ("unheard_of", 2, Code.MODEL_UNAVAILABLE),
    ],
)
def test_a_model_that_does_not_answer_ends_it_before_the_robot_has_gone_far(
    failure: str, pictures: int, code: Code
) -> None:
    """It writes garbage, hangs, is at rest, or may not be shown a picture: nobody drives about."""
    for kind in ("find", "count"):
        told = walk(kind, lambda *_: ImageAnswer(failure=failure, cost=PAID))
        assert len(told.asked) == pictures
        assert told.kind == "Fail"
        assert (told.end.code, told.end.reason) == (code, failure)
        assert told.end.said.en.startswith("I did not look for “umbrella stand”. ")
        assert len(told.end.said.zh) > 10
        assert all((goal.x_m, goal.y_m) == (0.0, 0.0) for goal in told.goals), "it turned at most"


def test_one_answer_that_is_missing_is_told_and_the_search_goes_on() -> None:
    missing = ImageAnswer(failure="bad_plan", cost=PAID)
    told = walk("find", lambda _, n: missing if n == 2 else NO, place="kitchen", role=StepRole.WHEN)
    assert len(told.asked) == EYES.views
    assert told.kind == "Fail"
    assert told.end.code is Code.UNSURE
    assert "Of the pictures, 1 told me nothing." in told.end.said.en


def test_what_it_is_unsure_of_is_no_yes_and_no_no() -> None:
    doubt = ImageAnswer(counts=(0, 1, 0), sure=0.3, cost=PAID)
    told = walk("find", lambda _, n: doubt if n == 1 else NO, place="kitchen")
    assert len(told.asked) == EYES.views, "it goes on"
    assert told.end.code is Code.NOT_FOUND
    assert told.end.said.en.endswith("Of some pictures I was not sure.")
    when = walk("find", lambda *_: doubt, place="kitchen", role=StepRole.WHEN)
    assert when.end.code is Code.UNSURE


def test_things_are_counted_room_by_room_and_where_pictures_overlap_between_two_numbers() -> None:
    def three(pose: Pose2, _: int) -> ImageAnswer:
        view = round(pose.yaw_rad / (2 * pi / EYES.views)) % EYES.views
        counts = {0: (1, 1, 0), 1: (0, 0, 1), 3: (0, 1, 0)}.get(view, (0, 0, 0))
        return ImageAnswer(counts=counts, sure=0.9, cost=PAID)

    told = walk("count", three, place="kitchen")
    assert told.kind == "Finish"
    assert told.end.code is Code.COUNTED
    assert told.end.read.en == "I count 3 to 4 of “umbrella stand”."
    assert told.end.figures["count"] == 3
    assert "counts" not in told.end.said.en, "a later thought does not act upon the figure"
    everywhere = walk("count", three)
    assert everywhere.end.read.en.startswith("I count 6 to 8 of “umbrella stand”: 3 to 4 in the")
    none = walk("count", lambda *_: NO, place="kitchen")
    assert none.end.read.en == "I count 0 of “umbrella stand”."


SEEN = st.builds(
    DirectionSeen,
    room=st.none(),
    spot=st.just("here"),
    view=st.integers(0, 5),
    left=st.integers(0, 3),
    middle=st.integers(0, 3),
    right=st.integers(0, 3),
    sure=st.floats(0.0, 1.0),
)


@given(st.lists(SEEN, max_size=8, unique_by=lambda s: s.view))
def test_a_count_is_never_below_what_one_picture_shows(seen: list[DirectionSeen]) -> None:
    low, high = count_between(seen, 6)
    believed = [each.count for each in seen if each.sure >= 0.5]
    assert max(believed, default=0) <= high == sum(believed)
    assert 0 <= low <= high
    assert low >= max((each.middle for each in seen if each.sure >= 0.5), default=0)


WHOLE = {kind: walk(kind, lambda *_: NO).goals for kind in ("find", "count")}
"""The ways of a search that sees nothing."""


@given(st.lists(st.tuples(st.booleans(), st.integers(0, 50), st.floats(0, 1)), max_size=30))
def test_no_answer_chooses_where_to_drive(answers: list[tuple[bool, int, float]]) -> None:
    """Whatever a model says, the ways are a beginning of those of a model that always says no."""

    def model(_: Pose2, number: int) -> ImageAnswer:
        if number > len(answers):
            return NO
        spoke, count, sure = answers[number - 1]
        if not spoke:
            return ImageAnswer(failure="bad_plan", cost=PAID)
        return ImageAnswer(counts=(count, 0, 0), sure=sure, cost=PAID)

    for kind, whole in WHOLE.items():
        told = walk(kind, model).goals
        assert told == whole[: len(told)]


def test_a_robot_that_was_moved_meanwhile_looks_there_again() -> None:
    asking = FindState(
        here=(0.0, 0.0), order=("hall",), spot="here", views=(0,), asking=True,
        stood=(0.0, 0.0, 0.0),
    )  # fmt: skip
    step = {"object": "umbrella stand"}
    told: dict[str, Any] = {
        "step": step, "eyes": EYES, "sight": sight(), "now_s": NOW_S, "state": asking,
    }  # fmt: skip
    assert isinstance(act_of(scene("find", pose=HERE, **told)), AskImage)
    for pose in (Pose2(0.0, 0.0, 2.0), Pose2(2.0, 0.0, 0.0)):
        act = act_of(scene("find", pose=pose, **told))
        assert not isinstance(act, AskImage), "it would be asked about another picture"


def test_without_a_model_it_says_which_kinds_can_be_found() -> None:
    blank = Eyesight(CameraConfig(), ("cup", "person"))
    barred = Eyesight(CameraConfig(), ("cup", "person"), model=True, pictures=PictureLimits(0))
    for eyes in (blank, barred):
        for kind in ("find", "count"):
            told = walk(kind, lambda *_: YES, eyes=eyes)
            assert told.end.code is Code.OBJECT_UNKNOWN
            assert told.end.said.en == (
                "I can't recognise “umbrella stand”. What I can: cup, person."
            )
            assert told.goals == []
    known = walk("find", lambda *_: YES, object="cup", place="kitchen")
    assert known.asked == [], "what the detector knows, it finds"
