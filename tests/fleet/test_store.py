"""Try the fleet's rows: robots, holds, changes, stops."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from fleet.addressee import Addressee
from fleet.errors import FleetError
from fleet.records import MissionRow, RobotRow, question_of, show_mission
from fleet.store import FleetStore

CARD = json.dumps({"robot_id": "pons", "places": []})
R1 = RobotRow("r1", "https://r1.local", "pons", "authority", "a" * 64, "pem", CARD)
R2 = RobotRow("r2", "https://r2.local", "pons", "authority", "b" * 64, "pem", CARD)


def kept_mission() -> MissionRow:
    """Return a mission without a store."""
    return MissionRow(
        seq=1, id="m-1", order_id="o-1", text="go", body="{}", way="any", names="[]",
        is_urgent=False, state="waiting", reason=None, robot=None, is_sent=False, wish=None,
        goal_id=None, goal_state=None, question=None, outcome=None, unknown_since_unix_s=None,
        attempt=1, created_unix_s=0.0, updated_unix_s=0.0, change=1,
    )  # fmt: skip


@pytest.fixture
def store(tmp_path: Path) -> Iterator[FleetStore]:
    made = FleetStore(f"sqlite:///{tmp_path / 'fleet.sqlite'}", wall=lambda: 1000.0)
    made.keep_robot(R1, again=False)
    made.keep_robot(R2, again=False)
    yield made
    made.close()


def give(
    store: FleetStore, number: int, way: Addressee | None = None, key: str | None = None
) -> MissionRow:
    who = way or Addressee("any")
    wanted: list[tuple[str, Addressee, dict[str, Any], bool]] = [
        (f"m-{number}", who, {"text": "go"}, False)
    ]
    return store.accept(f"o-{number}", "go", "hash", key, wanted, "go")[0]


@pytest.mark.parametrize(
    ("robot", "code"),
    [
        (R1, "robot_known"),
        (replace(R1, name="other"), "robot_known"),
        (replace(R1, name="other", url="https://10.0.0.9"), "robot_known"),
        (replace(R1, url="https://r9.local", pin_sha256="c" * 64), "name_taken"),
        (replace(R1, name="R1", url="https://r9.local", pin_sha256="c" * 64), "name_taken"),
    ],
)
def test_the_same_robot_twice_and_two_with_one_name(
    store: FleetStore, robot: RobotRow, code: str
) -> None:
    with pytest.raises(FleetError) as refused:
        store.keep_robot(robot, again=False)
    assert refused.value.code == code


def test_a_robot_is_renewed_with_its_cursor_kept(store: FleetStore) -> None:
    store.apply_goals("r1", [], cursor=7)
    store.keep_robot(replace(R1, pin_sha256="d" * 64, url="https://10.0.0.9"), again=True)
    renewed = store.robots()[0]
    assert (renewed.pin_sha256, renewed.url, renewed.cursor) == ("d" * 64, "https://10.0.0.9", 7)


def test_a_robot_holds_one_mission_until_it_ends(store: FleetStore) -> None:
    first, second = give(store, 1), give(store, 2)
    assert store.claim(first, "r1") is not None
    assert store.claim(first, "r2") is None
    assert store.claim(second, "r1") is None
    assert store.missions_at_robots() == {"r1": "m-1"}
    store.end("m-1", "succeeded")
    assert store.end("m-1", "failed").state == "succeeded"
    assert store.claim(second, "r1") is not None


def test_the_same_key_makes_the_same_mission_and_another_order_is_told(store: FleetStore) -> None:
    assert give(store, 1, key="k").id == give(store, 2, key="k").id
    with pytest.raises(FleetError) as refused:
        store.accept("o-3", "x", "other", "k", [], "x")
    assert refused.value.code == "idempotency_conflict"


def test_changes_are_listed_once_and_in_order(store: FleetStore) -> None:
    for number in range(5):
        give(store, number)
    first, cursor = store.changed_since(0, 2)
    assert [mission.id for mission in first] == ["m-0", "m-1"]
    store.end("m-0", "cancelled")
    rest, last = store.changed_since(cursor, 10)
    assert [mission.id for mission in rest] == ["m-2", "m-3", "m-4", "m-0"]
    assert store.changed_since(last, 10) == ([], last)


def test_a_stop_bars_what_was_ordered_before_it(store: FleetStore) -> None:
    named, anyone = give(store, 1, Addressee("named", ("r1",))), give(store, 2)
    assert store.stop("s-1", ["r1"], forever=False) == ["m-1"]
    assert store.mission(named.id).reason == "stopped_first"
    assert store.mission(anyone.id).state == "waiting"  # r2 may still go
    assert store.is_barred(replace(anyone, robot="r1"))
    assert not store.is_barred(replace(anyone, robot="r2"))
    assert not store.is_barred(replace(give(store, 3), robot="r1"))
    assert store.stop_state("s-1") == ([], ["r1"])
    store.confirm_stops({"r1": store.unconfirmed_stops()["r1"]})
    assert store.stop_state("s-1") == (["r1"], [])


def test_silence_makes_unknown_only_what_was_sent(store: FleetStore) -> None:
    sent, unsent = give(store, 1), give(store, 2)
    store.claim(sent, "r1")
    store.claim(unsent, "r2")
    store.change("m-1", is_sent=True)
    assert store.mark_silent("r1", 900.0) == ["m-1"]
    assert store.mark_silent("r2", 900.0) == []
    assert store.mission("m-1").unknown_since_unix_s == 900.0
    store.mark_heard("r1")
    assert store.mission("m-1").state == "offered"


def test_a_goal_of_a_mission_that_people_ended_tells_without_changing_its_state(
    store: FleetStore,
) -> None:
    store.claim(give(store, 1), "r1")
    store.bind("m-1", {"id": "g", "state": "running"})
    store.end("m-1", "given_up", "ended_by_person", wish="cancel")
    assert [mission.id for mission in store.withdrawals("r1")] == ["m-1"]
    store.apply_goals("r1", [{"id": "g", "state": "succeeded", "outcome": {"code": "done"}}])
    store.clear_wish("m-1")
    mission = store.mission("m-1")
    assert (mission.state, mission.goal_state) == ("given_up", "succeeded")
    assert store.withdrawals("r1") == []


def test_a_lost_goal_is_told_and_not_taken_back_by_an_answer(store: FleetStore) -> None:
    store.claim(give(store, 1), "r1")
    store.bind("m-1", {"id": "g", "state": "running"})
    store.mark_lost("m-1")
    store.mark_heard("r1")
    shown = show_mission(store.mission("m-1"))
    assert (shown["state"], shown["reason"]) == ("unknown", "goal_lost")


@pytest.mark.parametrize(
    ("goal", "kind"),
    [
        ({"state": "running", "plan": {"steps": [{"kind": "ask", "state": "running",
                                                  "text": "Now?"}]}}, "ask"),
        ({"state": "awaiting_confirmation", "plan": {"text": None}}, "awaiting_confirmation"),
        ({"state": "running", "plan": {"steps": [{"kind": "go_to", "state": "running"}]}}, None),
        ({"state": "queued", "plan": None}, None),
    ],
)  # fmt: skip
def test_what_a_goal_asks(goal: dict[str, Any], kind: str | None) -> None:
    asked = question_of(goal)
    assert (asked or {}).get("kind") == kind


def test_an_answer_that_comes_late_takes_no_end_back(store: FleetStore) -> None:
    store.claim(give(store, 1), "r1")
    store.bind("m-1", {"id": "g", "state": "running"})
    store.apply_goals("r1", [{"id": "g", "state": "succeeded"}])
    assert store.apply_goals("r1", [{"id": "g", "state": "running"}]) == []
    assert store.mission("m-1").goal_state == "succeeded"


def test_a_stop_and_its_confirmation_are_read_at_once(store: FleetStore) -> None:
    for number in range(3):
        assert store.unconfirmed_stops().get("r1", []) == []  # and kept for a moment
        store.stop(f"s-{number}", ["r1"], forever=False)
        assert store.unconfirmed_stops().get("r1", []) == [f"s-{number}"]
        assert store.unconfirmed_stops().get("r2", []) == []
        store.confirm_stops({"r1": [f"s-{number}"]})


def test_a_stop_that_the_database_did_not_take_is_noted_once_and_bars_what_was_before(
    store: FleetStore,
) -> None:
    waiting = give(store, 1)
    store.owe_stop("s-1", ["r1", "r2"], forever=True, heard=["r1"])
    assert (store.unconfirmed_stops().get("r1", []), store.unconfirmed_stops().get("r2", [])) == (
        [],
        ["s-1"],
    )
    assert store.mission(waiting.id).reason == "stopped_first"
    assert store.stop("s-1", ["r1", "r2"], forever=True) == []
    assert store.stop_state("s-1") == (["r1"], ["r2"])
