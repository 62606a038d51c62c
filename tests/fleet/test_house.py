"""Try the rules of the house and their rows: quiet hours, batteries, budget, rooms."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Any

import pytest
from pydantic import ValidationError

from fleet.addressee import Addressee
from fleet.house import HouseRules, spent_today
from fleet.store import FleetStore
from tests.fleet.test_store import give, store

__all__ = ["store"]


def at(clock: str) -> float:
    return datetime.fromisoformat(f"2026-11-30T{clock}+00:00").timestamp()


@pytest.mark.parametrize(
    ("quiet", "clock", "is_quiet"),
    [
        ("22:00-07:00", "21:59", False), ("22:00-07:00", "22:00", True),
        ("22:00-07:00", "06:59", True), ("22:00-07:00", "07:00", False),
        ("13:00-15:00", "14:00", True), ("13:00-15:00", "15:00", False), (None, "03:00", False),
    ],
)  # fmt: skip
def test_quiet_hours(quiet: str | None, clock: str, is_quiet: bool) -> None:
    assert HouseRules(quiet=quiet, timezone="UTC").is_quiet(at(clock)) is is_quiet


def test_quiet_hours_go_by_the_houses_clock() -> None:
    rules = HouseRules(quiet="22:00-07:00", timezone="Asia/Shanghai")
    assert rules.is_quiet(at("15:00"))  # 23:00 there


def test_a_battery_is_low_until_it_has_charged() -> None:
    low, told = False, []
    for battery in (0.5, 0.2, 0.19, 0.5, None, 0.79, 0.8, 0.3, float("nan"), None):
        low = HouseRules().is_low(low, battery)
        told.append(low)
    assert told == [False, False, True, True, True, True, False, False, True, True]


def test_the_budget_is_of_all_robots_and_of_today() -> None:
    day = f"{datetime.now(UTC):%Y-%m-%d}"
    now_s = datetime.now(UTC).timestamp()
    usages: list[dict[str, Any]] = [
        {"day": day, "today": {"money": 0.75, "calls": 3}, "currency": "EUR"},
        {"day": day, "today": {"money": 0.25, "calls": 1}, "currency": "EUR"},
        {"day": "2020-01-01", "today": {"money": 9.0, "calls": 9}}, {},
    ]  # fmt: skip
    assert spent_today(usages, now_s) == {"money": 1.0, "calls": 4, "currencies": ["EUR"]}
    limits: tuple[dict[str, float], ...] = (
        {},
        {"money": 1.01},
        {"money": 1.0},
        {"calls": 5},
        {"calls": 4},
        {"money": 0.0},
    )
    spent = [HouseRules.model_validate(each).is_spent(usages, now_s) for each in limits]
    assert spent == [False, False, True, False, True, True]


@pytest.mark.parametrize(
    "rules",
    [{"low": 0.9}, {"low": float("nan")}, {"quiet": "22-7"}, {"quiet": "25:00-07:00"},
     {"timezone": "Mars/Phobos"}, {"moeny": 1}, {"late_min": 0}],
)  # fmt: skip
def test_a_wrong_rule_changes_nothing(store: FleetStore, rules: dict[str, Any]) -> None:
    store.change_rules({"rooms": ["kitchen"]})
    with pytest.raises(ValidationError):
        store.change_rules(rules)
    assert store.rules() == HouseRules(rooms=("kitchen",))


def test_a_room_for_one_robot_is_held_from_the_claim_to_the_end(store: FleetStore) -> None:
    first, second = give(store, 1), give(store, 2)
    assert store.claim(first, "r1", {"home/kitchen", "home/hall"}) is not None
    assert store.claim(second, "r2", {"home/hall"}) is None
    assert store.mission("m-2").state == "waiting"
    store.change("m-1", is_sent=True)
    store.mark_silent("r1", 900.0)
    assert store.rooms_held() == {"home/kitchen", "home/hall"}
    store.end("m-1", "given_up", "ended_by_person", wish="cancel")
    assert store.claim(second, "r2", {"home/hall"}) is None  # it may still be in there
    store.clear_wish("m-1")
    assert store.claim(second, "r2", {"home/hall"}) is not None
    store.end("m-2", "succeeded")
    assert store.rooms_held() == set()


def test_an_order_that_waits_can_be_given_to_another_and_one_at_work_can_not(
    store: FleetStore,
) -> None:
    mission = give(store, 1, Addressee("named", ("r1",)))
    assert store.change_waiting("m-1", way="named", names='["r2"]')
    store.claim(store.mission(mission.id), "r2")
    assert not store.change_waiting("m-1", names='["r1"]')
    assert store.mission("m-1").candidates == ("r2",)


def test_who_is_low_is_kept_with_its_first_time(store: FleetStore) -> None:
    store.note_low("r1", low=True)
    store.note_low("r1", low=True)
    assert store.lows() == {"r1": 1000.0}
    store.note_low("r1", low=False)
    store.note_low("r1", low=False)
    assert store.lows() == {}
