"""What is said of battery, goal before and obstruction; what nobody knows is not told."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.language.sentence import parse
from planner.mission import spoken_status
from planner.mission.conversation import situation_of
from planner.mission.events import Cancel, Planned, Submitted
from planner.mission.recovery import ShutWay
from planner.mission.reducer import advance
from planner.mission.state import MissionState
from planner.plan import AnswerPlan, Bilingual, Find, GoTo, Language, Recall, StepPlan, say_same
from tests.planner.mission.fakes import FACTS, room
from tests.wire.examples import STATUS


def book(charge: float | None) -> MissionState:
    drive = STATUS.drive.model_copy(update={"battery": charge})
    return replace(MissionState(FACTS), status=STATUS.model_copy(update={"drive": drive}))


@pytest.mark.parametrize(
    ("charge", "en", "zh"),
    [(0.8, "80 %", "80 %"), (0.0, "0 %", "0 %"), (None, "does not tell how full", "不报告电量")],
)
def test_the_charge_is_told_in_both_languages(charge: float | None, en: str, zh: str) -> None:
    told = spoken_status.tell_battery(book(charge), 0.1)
    assert en in told.en
    assert zh in told.zh


@pytest.mark.parametrize("age_s", [1.5, float("inf"), float("nan")])
def test_an_old_charge_is_not_told(age_s: float) -> None:
    assert "80" not in spoken_status.tell_battery(book(0.8), age_s).en
    assert "80" not in spoken_status.tell_battery(MissionState(FACTS), 0.1).en


NOW_S = 1000.0
ASKING = Submitted("g1", "did you find it?", Language.EN)


def searched(*, ended: bool) -> MissionState:
    """Return the book after an order to find a cup."""
    place = next(target.id for target in FACTS.targets.values() if target.room)
    book, _ = advance(MissionState(FACTS), Submitted("g0", "find the cup", Language.EN), NOW_S)
    plan = StepPlan(steps=(GoTo(place=place), Find(object="cup")))
    book, _ = advance(book, Planned("g0", plan), NOW_S)
    return advance(book, Cancel("g0"), NOW_S)[0] if ended else book


def test_nothing_is_told_where_nothing_was_done() -> None:
    book, _ = advance(MissionState(FACTS), ASKING, NOW_S)
    assert spoken_status.tell_outcome(book, "g1") is None


def test_the_order_and_how_it_ended_are_told() -> None:
    book = searched(ended=True)
    outcome = book.missions["g0"].outcome
    told = spoken_status.tell_outcome(book)
    assert outcome is not None
    assert told is not None
    for language in ("en", "zh"):
        assert outcome.message.of(language) in told.of(language)
        assert "find the cup" in told.of(language)


def test_of_what_goes_on_is_told_how_far_it_is() -> None:
    told = spoken_status.tell_outcome(searched(ended=False))
    assert told is not None
    assert "find the cup" in told.en


def test_a_question_about_before_is_no_order_whose_end_is_asked_for() -> None:
    book, _ = advance(
        searched(ended=True), Submitted("g1", "what did you do today?", Language.EN), NOW_S
    )
    book, _ = advance(book, Planned("g1", StepPlan(steps=(Recall(deeds=True),))), NOW_S)
    assert spoken_status.tell_outcome(book) == spoken_status.tell_outcome(searched(ended=True))


@pytest.mark.parametrize("text", [ASKING.text, "有几个", "what did he say?"])
def test_no_brain_is_told_the_answer_again(text: str) -> None:
    """It may hold what a model read in a picture, and that is told no brain."""
    book, _ = advance(searched(ended=True), Submitted("g1", text, parse(text).language), NOW_S)
    book, _ = advance(book, Planned("g1", AnswerPlan(text=say_same("READ IN A PICTURE"))), NOW_S)
    book, _ = advance(book, Submitted("g2", "and now?", Language.EN), NOW_S)
    recent = situation_of(book, book.missions["g2"], NOW_S).recent
    assert [goal.told for goal in recent if goal.order == text] == [""]


SITE = replace(FACTS, targets={"hall": room("hall", 0.0), "kitchen": room("kitchen", 2.0)})


@pytest.mark.parametrize(
    ("point", "said"),
    [
        ((0.9, 0.0), "at the door between the hall and the kitchen"),
        ((1.1, 0.0), "at the door between the kitchen and the hall"),
        ((0.0, 0.0), "in the hall"),
        ((2.9, 0.0), "in the kitchen"),
        ((7.0, -1.25), "outside of every room"),
    ],
)
def test_a_spot_is_named(point: tuple[float, float], said: str) -> None:
    assert spoken_status.spot_of(SITE, point).en == said
    assert spoken_status.spot_of(SITE, point).zh


@pytest.mark.parametrize(
    ("since_unix_s", "offset_s", "time"),
    [(0.0, 0.0, "00:00"), (14 * 3600 + 3 * 60 + 59.9, 0.0, "14:03"), (1800.0, -3600.0, "23:30")],
)
def test_the_time_is_on_peoples_own_clock(since_unix_s: float, offset_s: float, time: str) -> None:
    way = ShutWay(start=(0.9, -0.2), end=(0.9, 0.3), since_unix_s=since_unix_s,
                  seen_unix_s=since_unix_s, local_offset_s=offset_s)  # fmt: skip
    said = spoken_status.tell_obstruction(SITE, way, Bilingual(en="kitchen", zh="厨房"))
    assert f"since {time}" in said.en
    assert time in said.zh
    assert "0.5 m wide" in said.en


def test_something_thin_is_not_told_as_nothing() -> None:
    way = ShutWay(start=(0.0, 0.0), end=(0.0, 0.0), since_unix_s=0.0, seen_unix_s=0.0)
    assert "0.1 m wide" in spoken_status.tell_obstruction(SITE, way, Bilingual(en="k", zh="厨")).en


def test_a_gap_of_the_map_is_told_as_too_narrow_with_its_width() -> None:
    way = ShutWay(start=(0.0, -0.4), end=(0.0, 0.35), gap=True, since_unix_s=0.0, seen_unix_s=0.0)
    said = spoken_status.tell_obstruction(SITE, way, Bilingual(en="kitchen", zh="厨房"))
    assert said.en == (
        "The way to the kitchen is too narrow for me in the hall: "
        "the map's walls leave 0.75 m there."
    )
    assert "0.75 米" in said.zh


def test_an_occupied_goal_names_how_near_the_robot_came() -> None:
    said = spoken_status.tell_occupied(Bilingual(en="kitchen", zh="厨房"), 0.62)
    assert "within 0.6 m of the kitchen" in said.en
    assert "0.6 米" in said.zh
