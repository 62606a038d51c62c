"""Give standing orders by an invented clock: once, also across a crash, and told."""

from __future__ import annotations

import asyncio
import json
from datetime import datetime
from typing import Any

import pytest

from fleet.addressee import Addressee
from fleet.errors import FleetError
from fleet.house import HouseRules
from fleet.records import MissionRow
from fleet.standing import give_due, judge_standing, show_standing
from fleet.store import FleetStore
from tests.fleet.test_store import store

__all__ = ["store"]
LATE_S = 1800.0


def at(day: int, clock: str) -> float:
    return datetime.fromisoformat(f"2026-12-{day:02}T{clock}+01:00").timestamp()


class Giving:
    """Accept orders as the desk does, on the real rows."""

    def __init__(self, store: FleetStore) -> None:
        self.store, self.given, self.refuses = store, 0, ""
        self._body = "hash"

    async def order(
        self, text: str | None, _: Any, __: None, key: str | None, *, order_id: str
    ) -> list[MissionRow]:
        if self.refuses:
            raise FleetError(self.refuses)
        self.given += 1
        wanted = [(f"m-{self.given}", Addressee("any"), {"text": text}, False)]
        return self.store.accept(order_id, text or "", self._body, key, wanted, text or "")


@pytest.fixture
def desk(store: FleetStore) -> Giving:
    made = Giving(store)
    store.keep_standing("check", "somebody check the door", "0 19 * * *", "Europe/Berlin")
    store.note_run("check", at(1, "12:00"), {"code": "day_skipped"})
    return made


def run(desk: Giving, now_s: float) -> str | None:
    """Look at the order at an instant; return what came of its newest run."""
    (order,) = desk.store.standing_orders()
    asyncio.run(give_due(desk, order, now_s, LATE_S))
    last = desk.store.standing_orders()[0].last
    return str(json.loads(last or "{}").get("code"))


def test_a_run_is_given_at_its_time_and_once(desk: Giving) -> None:
    run(desk, at(1, "18:59"))
    assert desk.given == 0
    assert run(desk, at(1, "19:00")) == "fired"
    run(desk, at(1, "19:00:05"))
    run(desk, at(1, "18:30"))  # a clock that is put back
    assert (desk.given, len(desk.store.waiting())) == (1, 1)
    run(desk, at(2, "19:00:01"))
    assert [each.order_id for each in desk.store.waiting()] == [
        f"st-check-{int(at(day, '19:00'))}" for day in (1, 2)
    ]
    assert desk.store.standing_orders()[0].fired == 2


def test_a_crash_between_the_missions_and_their_line_gives_the_same_missions(desk: Giving) -> None:
    (before,) = desk.store.standing_orders()
    run(desk, at(1, "19:00"))
    asyncio.run(give_due(desk, before, at(1, "19:01"), LATE_S))
    assert [each.id for each in desk.store.waiting()] == ["m-1"]
    (after,) = desk.store.standing_orders()
    assert (after.fired, json.loads(after.last or "")["missions"]) == (1, ["m-1"])


def test_another_fleet_since_the_crash_gives_nothing_twice(desk: Giving) -> None:
    (before,) = desk.store.standing_orders()
    run(desk, at(1, "19:00"))
    desk._body = "of other robots"
    asyncio.run(give_due(desk, before, at(1, "19:01"), LATE_S))
    assert len(desk.store.waiting()) == 1


def test_what_is_over_is_told_and_not_made_up(desk: Giving) -> None:
    assert run(desk, at(4, "12:00")) == "was_off"
    assert run(desk, at(4, "19:10")) == "fired"
    (order,) = desk.store.standing_orders()
    assert (desk.given, order.fired, order.missed) == (1, 1, 1)


def test_a_day_left_out_and_a_refusal_are_told(desk: Giving) -> None:
    desk.store.skip_standing("check", "2026-12-01")
    assert run(desk, at(1, "19:00")) == "day_skipped"
    desk.refuses = "no_robots"
    assert run(desk, at(2, "19:00")) == "no_robots"
    order = desk.store.standing_orders()[0]
    assert (desk.given, order.fired, order.missed) == (0, 0, 1)
    told = show_standing(order, HouseRules(quiet="18:00-20:00", timezone="Europe/Berlin"))
    assert told["last"]["message"]["en"].startswith("There are no robots")
    assert told["warning"] is not None
    desk.store.remove_standing("check")
    with pytest.raises(FleetError, match="unknown_order"):
        desk.store.remove_standing("check")


@pytest.mark.parametrize(
    ("text", "when", "told"),
    [
        ("somebody check the door", "19:00", "00 19 * * *"),
        ("r1: go home", "0 19 * * 1-5", "0 19 * * 1-5"),
        ("go home", "evening", "standing_time"),
        ("go home", "25:00", "standing_time"),
        ("go home", "* * * * *", "standing_often"),
        ("go home", "*/5 * * * *", "*/5 * * * *"),
        ("go home", "0 0 31 2 *", "standing_time"),
        ("go home", "* * * * * *", "standing_time"),
        ("everybody stop", "19:00", "standing_stop"),
        ("everybody", "19:00", "no_order"),
    ],
)
def test_what_can_be_a_standing_order(text: str, when: str, told: str) -> None:
    try:
        found = judge_standing(text, when, "Europe/Berlin", ("r1",))
    except FleetError as refused:
        found = refused.code
    assert found == told
