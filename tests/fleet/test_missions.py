"""Tell what a fleet does with orders: the real service, robots' doors that are real servers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from tests.fleet.conftest import RunningFleet, StubRobot, until
from tests.fleet.judge import CLEAN, judge

MakeRobot = Callable[[str], StubRobot]

pytestmark = [
    pytest.mark.e2e,
    pytest.mark.long,
    pytest.mark.timeout(600),
    pytest.mark.nightly(keep=3),
]


def test_the_nearest_goes_or_each_and_a_repeated_key_makes_nothing_new(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    near, far = make_robot("near"), make_robot("far")
    near.rule(length_m=1.0)
    far.rule(length_m=9.0)
    fleet.add(near, far)
    (nearest,) = fleet.give("go to the hall")
    assert nearest["reason"] in ("being_chosen", None), "nobody is busy"
    assert fleet.await_state(nearest["id"], "succeeded")["robot"] == "near"
    (named,) = fleet.give("far: go to the kitchen")
    done = fleet.await_state(named["id"], "succeeded")
    assert (done["robot"], done["message"]["zh"]) == ("far", "结果：succeeded。")
    each = fleet.give("near和far：回家", key="evening")
    again = fleet.give("near和far：回家", key="evening")
    assert [mission["id"] for mission in again] == [mission["id"] for mission in each]
    fleet.give("near和far：去厨房", status=409, key="evening")
    robots = {fleet.await_state(mission["id"], "succeeded")["robot"] for mission in each}
    assert robots == {"near", "far"}
    accepted = [mission["id"] for mission in (nearest, named, *each)]
    assert judge(accepted, [near.journal, far.journal], fleet.database) == CLEAN


def test_the_second_mission_of_a_robot_waits_for_the_first(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    robot = make_robot("busy")
    robot.rule(work_s=600.0)
    fleet.add(robot)
    (first,) = fleet.give("busy: go to the kitchen")
    (second,) = fleet.give("busy: go to the hall")
    fleet.await_state(first["id"], "at_robot")
    until(lambda: fleet.mission(second["id"])["reason"] == "robots_busy")
    assert fleet.mission(second["id"])["state"] == "waiting"
    robot.rule(work_s=0.0)
    fleet.await_state(second["id"], "succeeded")


def test_a_question_is_answered_through_the_fleet(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    robot = make_robot("asker")
    robot.rule(ask=True)
    fleet.add(robot)
    (mission,) = fleet.give("asker: look at the door")
    asking = fleet.await_state(mission["id"], "asking")
    assert asking["question"]["text"]["en"] == "Which door?"
    path = f"/v1/missions/{mission['id']}/answer"
    assert fleet.client.post(path, json={"text": "the back one"}).is_success
    fleet.await_state(mission["id"], "succeeded")
    late = fleet.client.post(path, json={"text": "the back one"})
    assert (late.status_code, late.json()["code"]) == (409, "not_asking")


def test_a_refusal_by_the_robot_ends_the_mission_with_its_code(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    robot = make_robot("strict")
    fleet.add(robot)
    robot.rule(refuse=422)
    (mission,) = fleet.give("strict: go to the kitchen")
    refused = fleet.await_state(mission["id"], "refused")
    assert refused["reason"] == "refused_by_rule"


def test_a_silent_robots_mission_is_unknown_and_its_robot_tells_when_it_is_back(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    robot = make_robot("quiet")
    robot.rule(work_s=600.0)
    fleet.add(robot)
    (mission,) = fleet.give("quiet: go to the kitchen")
    fleet.await_state(mission["id"], "at_robot")
    robot.kill()
    unknown = fleet.await_state(mission["id"], "unknown")
    assert unknown["message"]["en"].startswith("unknown since")
    assert unknown["unknown_since_unix_s"] > 0
    robot.start()  # with the rules of before: it ends what it had
    assert fleet.await_state(mission["id"], "succeeded")["robot"] == "quiet"
    verdict = judge([mission["id"]], [robot.journal], fleet.database)
    assert (verdict.lost, verdict.stateless) == ((), ())


def test_a_person_ends_a_silent_robots_mission_and_hears_later_what_it_did(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    robot = make_robot("away")
    robot.rule(work_s=600.0)
    fleet.add(robot)
    (mission,) = fleet.give("away: go to the kitchen")
    fleet.await_state(mission["id"], "at_robot")
    path, give_up = f"/v1/missions/{mission['id']}/cancel", {"give_up": True}
    assert fleet.client.post(path, json=give_up).json()["code"] == "not_silent"
    robot.kill()
    fleet.await_state(mission["id"], "unknown")
    ended = fleet.client.post(path, json=give_up).json()
    assert (ended["state"], ended["wish"]) == ("given_up", "cancel")
    robot.start()

    def told() -> dict[str, Any] | None:
        found = fleet.mission(mission["id"])
        return found if found["wish"] is None else None

    back = until(told)
    assert back["state"] == "given_up"
    assert back["goal_state"] in ("succeeded", "cancelled")  # as its journal says


def test_a_cancelled_offer_that_was_never_heard_closes_its_key(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    robot = make_robot("deaf")
    fleet.add(robot)
    robot.rule(refuse=503)
    (mission,) = fleet.give("deaf: go to the kitchen")
    fleet.await_state(mission["id"], "offered")
    fleet.client.post(f"/v1/missions/{mission['id']}/cancel", json={}).raise_for_status()
    fleet.await_state(mission["id"], "cancelled")
    robot.rule(refuse=None)
    (second,) = fleet.give("deaf: go to the hall")
    fleet.await_state(second["id"], "succeeded")
    verdict = judge([second["id"]], [robot.journal], fleet.database)
    assert (verdict.lost, verdict.twice) == ((), ())


def test_a_wrong_or_withdrawn_token_and_another_robot_at_the_address(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    robot = make_robot("locked")
    robot.rule(token="a", work_s=600.0)
    wrong = fleet.run("add", robot.url, "--token", "b")
    assert (wrong.returncode, "token_refused" in wrong.stderr) == (3, True)
    added = fleet.run("add", robot.url, "--token", "a")
    assert added.returncode == 0, added.stderr
    assert (fleet.home / "fleet" / "tokens" / "locked").stat().st_mode & 0o777 == 0o600
    fleet.await_ready(robot)
    (mission,) = fleet.give("locked: go to the kitchen")
    fleet.await_state(mission["id"], "at_robot")
    robot.rule(token="new")
    until(lambda: fleet.states()["locked"] == "token_needed")
    fleet.await_state(mission["id"], "unknown")
    robot.kill()
    robot.start()
    robot.rule(token="a", id="another")
    until(lambda: fleet.states()["locked"] == "robot_mismatch")
    assert fleet.mission(mission["id"])["state"] == "unknown"


def test_a_service_killed_in_mid_offer_loses_nothing_and_does_nothing_twice(
    own_fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    fleet, robots = own_fleet, [make_robot(f"r{number}") for number in (1, 2, 3)]
    fleet.add(*robots)
    fleet.start()
    fleet.await_ready(*robots)
    accepted: list[str] = []
    for turn in range(3):
        for robot in robots:
            robot.rule(lose_answers=1)  # the offer is on its disk, and the service hears nothing
        for number in range(5):
            accepted += [each["id"] for each in fleet.give(f"go to the hall {turn} {number}")]
        fleet.kill()
        fleet.start()
    for mission_id in accepted:
        fleet.await_state(mission_id, "succeeded")
    assert judge(accepted, [robot.journal for robot in robots], fleet.database) == CLEAN


def test_a_stop_is_told_by_number_and_repeated_until_it_is_confirmed(
    own_fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    fleet, robots = own_fleet, [make_robot(f"r{number}") for number in (1, 2, 3)]
    for robot in robots:
        robot.rule(work_s=600.0)
    fleet.add(*robots)
    fleet.start()
    fleet.await_ready(*robots)
    running = [mission["id"] for mission in fleet.give("everybody go home")]
    for mission_id in running:
        fleet.await_state(mission_id, "at_robot")
    (waiting,) = fleet.give("r2: go to the hall")
    robots[2].kill()
    told = fleet.client.post("/v1/stop").json()
    assert told["message"]["en"] == "2 of 3 confirmed, r3 not reached"
    assert fleet.mission(waiting["id"])["reason"] == "stopped_first"
    fleet.kill()  # a stop that is not confirmed survives the service
    fleet.start()
    robots[2].start()
    until(lambda: not fleet.client.get(f"/v1/stop/{told['id']}").json()["not_reached"])
    by_word = fleet.client.post("/v1/missions", json={"text": "大家停下"}).json()
    assert by_word["missions"] == []
    assert len(by_word["stop"]["confirmed"]) == 3


def test_an_upgrade_with_missions_pending_strands_none(
    own_fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    fleet, robot = own_fleet, make_robot("r1")
    robot.rule(work_s=600.0)
    fleet.add(robot)
    fleet.start("fleet.workflow.APPLICATION_VERSION = 'of-before'")
    fleet.await_ready(robot)
    (mission,) = fleet.give("go to the kitchen")
    fleet.await_state(mission["id"], "at_robot")
    fleet.end()
    fleet.start("fleet.workflow.STANDS_STILL_S = 1.0; fleet.workflow.SWEEP_S = 0.5")
    robot.rule(work_s=0.0)
    fleet.await_state(mission["id"], "succeeded")
    assert fleet.client.get("/healthz").json()["swept"] >= 1
    verdict = judge([mission["id"]], [robot.journal], fleet.database)
    assert (verdict.lost, verdict.twice) == ((), ())
