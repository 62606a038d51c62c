"""A vacuum's state and sensors are what the planner shows, in the words of the home's language."""

from __future__ import annotations

from typing import Any

import pytest

from pons.mqtt import home_state
from pons.mqtt.discovery import EVENT_TYPES
from pons.mqtt.orders import HomeOrder
from pons.mqtt.planner_orders import sentence_of
from pons.mqtt.planner_watch import MOST_GOALS, PlannerView
from tests.known import known
from tests.pons.mqtt import schemas

DOCK = {"id": "dock", "kind": "place", "name": {"en": "dock", "zh": None},
        "pose": {"x_m": 1.0, "y_m": 1.0}}  # fmt: skip
KITCHEN = {"id": "kitchen", "kind": "room", "name": {"en": "kitchen", "zh": "厨房"}}
STUDY = {"id": "study", "kind": "room", "name": {"en": "study", "zh": None}}
PLACES: list[Any] = [KITCHEN, STUDY, DOCK]


def robot(mode: str = "HOLD", *, x_m: float = 5.0, **more: Any) -> dict[str, Any]:
    status = {
        "mode": mode, "held": None, "drive": {"battery": 0.504},
        "base_in_map": {"x_m": x_m, "y_m": 1.0}, **more,
    }  # fmt: skip
    return {"status": status, "room": "kitchen"}


def goal(state: str, *, number: int = 1, **more: Any) -> dict[str, Any]:
    return {
        "id": f"g{number}", "state": state, "text": "go there", "created": f"2026-{number:04}",
        "updated": f"2026-{number:04}", "outcome": None, "plan": None, "reason": None, **more,
    }  # fmt: skip


def steps(**step: Any) -> dict[str, Any]:
    return {
        "plan": {"steps": [{"kind": "go_to", "state": "succeeded"}, {"state": "running", **step}]}
    }


@pytest.mark.parametrize(
    ("shown", "goals", "state"),
    [
        ({"status": None}, [], "error"),
        (robot("FAULT"), [goal("running")], "error"),
        (robot("ESTOPPED"), [], "error"),
        (robot("ACTIVE"), [goal("running")], "cleaning"),
        (robot(), [goal("planning")], "cleaning"),
        (robot("ACTIVE"), [goal("running", **steps(kind="return_home"))], "returning"),
        (robot("ACTIVE"), [goal("running", **steps(kind="go_to", place="dock"))], "returning"),
        (robot("ACTIVE"), [goal("running", **steps(kind="go_to", place="kitchen"))], "cleaning"),
        (robot(), [goal("paused")], "paused"),
        (robot(), [goal("succeeded")], "idle"),
        (robot(x_m=1.2), [goal("succeeded")], "docked"),
        (robot(base_in_map=None), [], "idle"),
    ],
)  # fmt: skip
def test_the_vacuum_is_in_a_state_that_the_home_knows(
    shown: dict[str, Any], goals: list[Any], state: str
) -> None:
    assert home_state.vacuum_state(shown, goals, DOCK) == state
    assert state in schemas.STATES


def test_without_a_home_nothing_is_docked() -> None:
    assert home_state.vacuum_state(robot(x_m=1.0), [], None) == "idle"


ANSWER = {"message": {"en": "It is red.", "zh": "是红的。"}, "code": "answered"}


def test_sensors_say_what_is_known() -> None:
    goals = [goal("running", number=3), goal("succeeded", number=2, outcome=ANSWER)]
    assert home_state.sensors(robot("ACTIVE"), goals, PLACES, "en") == {
        "battery": 50, "place": "kitchen", "activity": "go there", "answer": "It is red.",
    }  # fmt: skip
    assert home_state.sensors(robot(), goals[1:], PLACES, "zh") == {
        "battery": 50, "place": "厨房", "activity": "就绪", "answer": "是红的。",
    }  # fmt: skip
    assert home_state.sensors({"status": None, "room": None}, [], PLACES, "en") == {
        "battery": None, "place": None, "activity": "no word from the bridge", "answer": None,
    }  # fmt: skip


@pytest.mark.parametrize(
    ("shown", "goals", "said"),
    [
        (robot("DISARMED"), [], "disarmed"),
        (robot(held={"reason": "stop"}), [], "stopped"),
        (robot("FAULT"), [], "stopped by a fault"),
        (robot(), [goal("paused")], "paused: go there"),
        (robot(), [goal("needs_clarification", plan={"text": {"en": "Which?"}})], "asks: Which?"),
        (robot(), [goal("running", text="x" * 300)], "x" * 254 + "…"),
    ],
)
def test_the_activity_is_one_short_sentence(
    shown: dict[str, Any], goals: list[Any], said: str
) -> None:
    assert home_state.sensors(shown, goals, PLACES, "en")["activity"] == said


@pytest.mark.parametrize("state", EVENT_TYPES)
def test_a_goal_that_ended_or_asks_is_an_event(state: str) -> None:
    told = known(
        home_state.event(
            goal("awaiting_confirmation" if state == "asks" else state, outcome=ANSWER), "en"
        )
    )
    assert told["event_type"] == state
    assert told["message"] == "It is red."


def test_a_goal_that_goes_on_is_no_event() -> None:
    assert home_state.event(goal("running"), "en") is None


def test_rooms_are_segments_by_id() -> None:
    assert home_state.segments(PLACES, "zh") == {"kitchen": "厨房", "study": "study"}


@pytest.mark.parametrize(
    ("order", "language", "sentence"),
    [
        (HomeOrder("sentence", text="hi"), "en", "hi"),
        (HomeOrder("home"), "en", "go home"),
        (HomeOrder("home"), "zh", "回家"),
        (HomeOrder("rooms", rooms=("study", "kitchen")), "en", "patrol study, kitchen"),
        (HomeOrder("rooms", rooms=("kitchen",)), "zh", "巡逻厨房"),
        (HomeOrder("start"), "en", "patrol kitchen, study"),
        (HomeOrder("locate"), "en", 'say "I am here"'),
    ],
)
def test_an_order_is_the_sentence_that_a_person_would_say(
    order: HomeOrder, language: str, sentence: str
) -> None:
    assert sentence_of(order, PLACES, language) == sentence


def snapshot(*goals: dict[str, Any]) -> dict[str, Any]:
    return {"kind": "snapshot", "robot": robot(), "goals": list(goals)}


def changed(shown: dict[str, Any]) -> dict[str, Any]:
    return {"kind": "goal", "change": {"type": "goal", "goal": shown}}


def news(view: PlannerView) -> list[tuple[str, str]]:
    return [(shown["id"], shown["state"]) for _, shown in view.news]


def test_an_end_is_news_once_and_also_after_a_gap() -> None:
    view = PlannerView()
    assert view.take(snapshot(goal("running"), goal("succeeded", number=2)), 0.0)
    assert news(view) == []  # what was over before anybody listened
    view.take(changed(goal("failed")), 1.0)
    view.take(changed(goal("failed")), 2.0)
    assert news(view) == [("g1", "failed")]
    view.take(changed(goal("running", number=3)), 3.0)
    view.take(snapshot(goal("cancelled", number=3), goal("failed")), 9.0)
    assert news(view) == [("g1", "failed"), ("g3", "cancelled")]
    assert [shown["id"] for shown in view.goals] == ["g3", "g2", "g1"]


def test_places_are_asked_for_when_they_changed() -> None:
    view = PlannerView()
    assert view.take({"kind": "places", "version": 3}, 0.0)
    assert not view.take({"kind": "robot", "robot": robot()}, 0.0)


def test_a_view_is_bounded() -> None:
    view = PlannerView()
    for number in range(5 * MOST_GOALS):
        view.take(changed(goal("refused", number=number)), 0.0)
    assert len(view.goals) == MOST_GOALS
    assert len(view.news) <= MOST_GOALS
