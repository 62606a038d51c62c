"""Tell what a house does with orders: eyes, homes, rooms, batteries, quiet, budget, resume."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from datetime import UTC, datetime, timedelta
from typing import Any

import pytest

from tests.fleet.conftest import RunningFleet, StubRobot, until
from tests.fleet.judge import judge

MakeRobot = Callable[[str], StubRobot]

pytestmark = [
    pytest.mark.e2e,
    pytest.mark.long,
    pytest.mark.timeout(600),
    pytest.mark.nightly(keep=1),
]


@pytest.fixture
def house(fleet: RunningFleet) -> Iterator[RunningFleet]:
    """Return the fleet whose rules are as at the start again after a story."""
    yield fleet
    rule(fleet, rooms=[], quiet=None, homes={}, money=None, charge=True)


def rule(fleet: RunningFleet, **rules: Any) -> None:
    fleet.client.patch("/v1/house", json=rules).raise_for_status()


def await_reason(fleet: RunningFleet, mission: dict[str, Any], reason: str) -> dict[str, Any]:
    def look() -> dict[str, Any] | None:
        found = fleet.mission(mission["id"])
        return found if found["reason"] == reason else None

    found: dict[str, Any] = until(look)
    return found


def test_eyes_are_needed_to_look(house: RunningFleet, make_robot: MakeRobot) -> None:
    blind, seeing = make_robot("blind"), make_robot("seeing")
    for robot in (blind, seeing):
        robot.rule(places=["larder"])
    seeing.rule(camera="v4l2", length_m=50.0)
    house.add(blind, seeing)
    (look,) = house.give("nearest: look whether the larder is shut")
    assert house.await_state(look["id"], "succeeded")["robot"] == "seeing"
    (go,) = house.give("nearest: go to the larder")
    assert house.await_state(go["id"], "succeeded")["robot"] == "blind"


def test_a_room_that_two_homes_have_is_asked_about(
    house: RunningFleet, make_robot: MakeRobot
) -> None:
    town, country = make_robot("town"), make_robot("country")
    town.rule(places=["pantry"], site="flat", map_id="a" * 16)
    country.rule(places=["pantry"], site="cottage", map_id="b" * 16)
    house.add(town, country)
    (mission,) = house.give("somebody go to the pantry")
    asking = house.await_state(mission["id"], "asking")
    assert (asking["reason"], asking["robot"]) == ("which_home", None)
    assert [each["text"]["en"] for each in asking["question"]["options"]] == ["cottage", "flat"]
    assert "哪一个" in asking["question"]["text"]["zh"]
    path = f"/v1/missions/{mission['id']}/answer"
    assert house.client.post(path, json={"text": "castle"}).json()["code"] == "which_home"
    assert house.run("answer", mission["id"], "Cottage").returncode == 0
    assert house.await_state(mission["id"], "succeeded")["robot"] == "country"
    (said,) = house.give("somebody go to the pantry in the flat")
    assert house.await_state(said["id"], "succeeded")["robot"] == "town"


def test_one_robot_at_a_time_is_bound_for_a_room(
    house: RunningFleet, make_robot: MakeRobot
) -> None:
    first, second = make_robot("first"), make_robot("second")
    first.rule(work_s=600.0)
    for robot in (first, second):
        robot.rule(through=[[1.0, 1.0], [5.0, 1.0]])  # through the kitchen into the hall
    house.add(first, second)
    rule(house, rooms=["hall"])
    (one,) = house.give("first: go to the hall")
    house.await_state(one["id"], "at_robot")
    (two,) = house.give("second: go to the hall")
    told = await_reason(house, two, "room_taken")
    assert (told["state"], told["robot"]) == ("waiting", None)
    second.rule(through=[[1.0, 1.0]])
    (other,) = house.give("second: go to the kitchen")
    house.await_state(other["id"], "succeeded")  # it does not pass there
    first.rule(work_s=0.0, room="hall")
    house.await_state(one["id"], "succeeded")
    second.rule(through=[[5.0, 1.0]])
    await_reason(house, two, "room_taken")  # the first stands in it
    first.rule(room="cellar")
    house.await_state(two["id"], "succeeded")


def test_a_robot_low_on_battery_is_passed_over_and_sent_to_its_dock_once(
    house: RunningFleet, make_robot: MakeRobot
) -> None:
    robot, own = make_robot("weary"), make_robot("selfreliant")
    own_order = {"rule": {"kind": "event", "event": "battery_low"}, "state": "active"}
    for each in (robot, own):
        each.rule(places=["attic", "dock"])
    own.rule(orders=[own_order], battery=0.15)
    house.add(robot, own)
    robot.rule(battery=0.15)  # so that the other one is known as low by then

    def sent() -> list[dict[str, Any]]:
        told = house.client.get("/v1/missions").json()["missions"]
        return [each for each in told if each["cause"] == "low_battery"]

    (charge,) = until(sent)
    assert house.await_state(charge["id"], "succeeded")["robot"] == "weary"
    (mission,) = house.give("somebody go to the attic")
    await_reason(house, mission, "robots_low")
    robot.rule(battery=0.5)  # above the threshold, and not charged yet
    (named,) = house.give("weary: go to the attic")  # a person's word goes
    house.await_state(named["id"], "succeeded")
    await_reason(house, mission, "robots_low")
    robot.rule(battery=0.9)
    assert house.await_state(mission["id"], "succeeded")["robot"] == "weary"
    assert len(sent()) == 1  # the other one goes by its own order


def test_in_quiet_hours_nothing_begins_that_moves(
    house: RunningFleet, make_robot: MakeRobot
) -> None:
    robot = make_robot("quietly")
    house.add(robot)
    hour = timedelta(hours=1)
    now = datetime.now(UTC)
    rule(house, quiet=f"{now - hour:%H:%M}-{now + hour:%H:%M}", timezone="UTC")
    (moves,) = house.give("quietly: go to the hall")
    await_reason(house, moves, "quiet_hours")
    (asks,) = house.give("quietly: go to the kitchen", confirm=True)
    house.await_state(asks["id"], "succeeded")
    robot.rule(does="stands")
    (says,) = house.give("quietly: say hello")
    house.await_state(says["id"], "succeeded")
    await_reason(house, moves, "quiet_hours")
    rule(house, quiet=None)
    house.await_state(moves["id"], "succeeded")


def test_over_the_houses_budget_words_go_to_no_robot_with_a_model(
    house: RunningFleet, make_robot: MakeRobot
) -> None:
    robot, plain = make_robot("clever"), make_robot("plain")
    robot.rule(model="qwen", money=2.5)
    house.add(robot, plain)
    until(lambda: house.client.get("/v1/house").json()["spent_today"]["money"] == 2.5)
    rule(house, money=2.0)
    (words,) = house.give("clever: go to the hall")
    told = await_reason(house, words, "budget_spent")
    assert "预算" in told["message"]["zh"]
    (other,) = house.give("plain: go to the hall")
    house.await_state(other["id"], "succeeded")
    body = {"steps": [{"kind": "go_to", "place": "hall"}], "to": ["clever"]}
    (steps,) = house.client.post("/v1/missions", json=body).json()["missions"]
    house.await_state(steps["id"], "succeeded")
    rule(house, money=3.0)
    house.await_state(words["id"], "succeeded")


def test_what_waits_for_a_busy_robot_can_be_given_to_another(
    house: RunningFleet, make_robot: MakeRobot
) -> None:
    busy, idle = make_robot("engaged"), make_robot("idle")
    busy.rule(work_s=600.0)
    for robot in (busy, idle):
        robot.rule(places=["porch"])
    house.add(busy, idle)
    (first,) = house.give("engaged: go to the porch")
    house.await_state(first["id"], "at_robot")
    (second,) = house.give("engaged: go to the porch")
    until(lambda: "idle" in house.mission(second["id"])["instead"])
    assert house.run("to", second["id"], "idle").returncode == 0
    assert house.await_state(second["id"], "succeeded")["robot"] == "idle"
    late = house.client.post(f"/v1/missions/{second['id']}/to", json={"to": "any"})
    assert late.json()["code"] == "not_waiting"
    busy.rule(work_s=0.0)


def test_a_goal_that_its_robot_paused_is_resumed_by_a_person(
    house: RunningFleet, make_robot: MakeRobot
) -> None:
    robot = make_robot("paused")
    robot.rule(work_s=600.0)
    house.add(robot)
    (mission,) = house.give("paused: go to the hall")
    house.await_state(mission["id"], "at_robot")
    house.client.post("/v1/stop", json={"robots": ["paused"]}).raise_for_status()
    told = until(lambda: house.mission(mission["id"])["goal_state"] == "paused"
                 and house.mission(mission["id"]))  # fmt: skip
    assert told["message"]["en"].startswith("It is paused at paused")
    robot.rule(proof=True, work_s=0.0)
    refused = house.client.post(f"/v1/missions/{mission['id']}/resume", json={}).json()
    assert (refused["code"], robot.url in refused["message"]["en"]) == ("resume_at_robot", True)
    robot.rule(proof=False)
    assert house.run("resume", mission["id"]).returncode == 0
    house.await_state(mission["id"], "succeeded")
    over = house.client.post(f"/v1/missions/{mission['id']}/resume", json={}).json()
    assert over["code"] == "not_at_robot"
    verdict = judge([mission["id"]], [robot.journal], house.database)
    assert (verdict.lost, verdict.twice) == ((), ())


def test_a_standing_order_is_given_at_its_time_and_once_over_a_kill(
    own_fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    """The service's clock for such orders is put forward to the minute, once the order is kept."""
    fleet, robot = own_fleet, make_robot("r1")
    ahead_s = robot.folder / "ahead_s"
    ahead_s.write_text("0")
    clock = f"lambda: time.time() + float(open({str(ahead_s)!r}).read())"
    settings = (
        "import time, types, fleet.standing",
        f"fleet.standing.time = types.SimpleNamespace(time={clock})",
    )
    fleet.add(robot)
    fleet.start(*settings)
    fleet.await_ready(robot)
    due = datetime.now().astimezone().replace(second=0, microsecond=0) + timedelta(minutes=3)
    kept = fleet.run("every", f"{due:%H:%M}", "somebody go to the hall")
    assert kept.returncode == 0, kept.stderr
    order_id = kept.stdout.split()[0]

    def firings() -> list[str]:
        (order,) = fleet.client.get("/v1/orders").json()["orders"]
        return list((order["last"] or {}).get("missions", []))

    assert firings() == []
    (written := ahead_s.with_suffix(".new")).write_text(str(due.timestamp() - time.time() + 0.1))
    written.replace(ahead_s)
    (mission_id,) = until(firings)
    fleet.kill()
    fleet.start(*settings)
    shown = fleet.await_state(mission_id, "succeeded")
    assert (shown["cause"], shown["order_id"][:11]) == ("standing_order", f"st-{order_id}")
    assert len(fleet.client.get("/v1/missions").json()["missions"]) == 1
    assert fleet.run("orders", "--skip", order_id, "2026-12-24").returncode == 0
    assert fleet.run("orders", "--remove", order_id).returncode == 0
    assert fleet.client.get("/v1/orders").json() == {"orders": []}
