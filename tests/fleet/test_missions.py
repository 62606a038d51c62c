"""Tell what a fleet does with orders: real robots' doors, the real service, each database."""

from __future__ import annotations

import signal
from typing import TYPE_CHECKING, Any

import pytest

from tests.fleet.conftest import until
from tests.fleet.judge import judge

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.fleet.conftest import RunningFleet, StubRobot

    MakeRobot = Callable[[str], StubRobot]


SILENT = "fleet.watch.SILENT_S = 1.0"


def plain(url: str) -> str:
    return url.replace("postgresql://", "postgresql+psycopg://")


def test_orders_to_one_to_each_and_to_the_nearest(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    near, far = make_robot("near"), make_robot("far")
    near.rule(length_m=1.0)
    far.rule(length_m=9.0)
    fleet.add(near, far)
    fleet.start()
    fleet.await_ready(2)

    (named,) = fleet.give("far: go to the kitchen")
    (nearest,) = fleet.give("nearest, go to the hall")
    done = fleet.await_state(named["id"], "succeeded")
    assert done["robot"] == "far"
    assert done["message"]["zh"] == "结果：succeeded。"
    assert fleet.await_state(nearest["id"], "succeeded")["robot"] == "near"
    each = fleet.give("大家回家", key="evening")
    assert [mission["id"] for mission in fleet.give("大家回家", key="evening")] == [
        mission["id"] for mission in each
    ]
    fleet.give("大家去厨房", status=409, key="evening")
    robots = {fleet.await_state(mission["id"], "succeeded")["robot"] for mission in each}
    assert robots == {"near", "far"}
    verdict = judge([each[0]["id"]], [near.journal, far.journal], plain(fleet.database))
    assert verdict.twice == ()


def test_one_mission_at_a_robot_and_the_next_waits(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    robot = make_robot("r1")
    robot.rule(work_s=1.0)
    fleet.add(robot)
    fleet.start()
    fleet.await_ready(1)
    (first,) = fleet.give("go to the kitchen")
    (second,) = fleet.give("go to the hall")
    fleet.await_state(first["id"], "at_robot")
    waiting = fleet.mission(second["id"])
    assert (waiting["state"], waiting["reason"]) == ("waiting", "robots_busy")
    fleet.await_state(second["id"], "succeeded")


def test_a_question_is_answered_through_the_fleet(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    robot = make_robot("r1")
    robot.rule(ask=True)
    fleet.add(robot)
    fleet.start()
    fleet.await_ready(1)
    (mission,) = fleet.give("look at the door")
    asking = fleet.await_state(mission["id"], "asking")
    assert asking["question"]["text"]["en"] == "Which door?"
    answered = fleet.client.post(f"/v1/missions/{mission['id']}/answer", json={"text": "the back"})
    assert answered.status_code == 200
    fleet.await_state(mission["id"], "succeeded")
    again = fleet.client.post(f"/v1/missions/{mission['id']}/answer", json={"text": "the back"})
    assert again.json()["code"] == "not_asking"


def test_a_service_killed_in_mid_offer_loses_nothing_and_does_nothing_twice(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    robots = [make_robot(f"r{number}") for number in (1, 2, 3)]
    fleet.add(*robots)
    fleet.start()
    fleet.await_ready(3)
    accepted: list[str] = []
    for turn in range(4):
        for robot in robots:
            robot.rule(lose_answers=1)  # the offer is on its disk, and the service hears nothing
        for number in range(5):
            accepted += [mission["id"] for mission in fleet.give(f"go to the hall {turn} {number}")]
        fleet.kill()
        fleet.start()
    for mission_id in accepted:
        fleet.await_state(mission_id, "succeeded")
    journals = [robot.journal for robot in robots]
    verdict = judge(accepted, journals, plain(fleet.database))
    assert (verdict.lost, verdict.twice, verdict.stateless) == ((), (), ())


def test_a_silent_robots_mission_is_unknown_and_goes_to_no_other(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    robot, other = make_robot("r1"), make_robot("r2")
    robot.rule(work_s=600.0)
    fleet.add(robot, other)
    fleet.start(SILENT)
    fleet.await_ready(2)
    (mission,) = fleet.give("r1: go to the kitchen")
    fleet.await_state(mission["id"], "at_robot")
    robot.kill()
    unknown = fleet.await_state(mission["id"], "unknown")
    assert unknown["unknown_since_unix_s"] > 0
    assert unknown["message"]["en"].startswith("unknown since")
    assert unknown["robot"] == "r1"
    robot.start()  # its rules are those of before: it ends what it had
    assert fleet.await_state(mission["id"], "succeeded")["robot"] == "r1"
    verdict = judge([mission["id"]], [robot.journal, other.journal], plain(fleet.database))
    assert (verdict.lost, verdict.stateless) == ((), ())


def test_a_person_ends_a_silent_robots_mission_and_hears_later_what_it_did(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    robot = make_robot("r1")
    robot.rule(work_s=600.0)
    fleet.add(robot)
    fleet.start(SILENT)
    fleet.await_ready(1)
    (mission,) = fleet.give("go to the kitchen")
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


def test_a_withdrawn_offer_that_may_have_arrived_never_begins(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    """The robot got nothing: its key is closed, so that a late copy of the offer does nothing."""
    robot = make_robot("r1")
    fleet.add(robot)
    fleet.start(SILENT)
    fleet.await_ready(1)
    robot.rule(refuse=503)
    (mission,) = fleet.give("go to the kitchen")
    fleet.await_state(mission["id"], "offered")
    until(lambda: fleet.client.get("/healthz").json()["running"])
    cancelled = fleet.client.post(f"/v1/missions/{mission['id']}/cancel", json={})
    assert cancelled.status_code == 200
    fleet.await_state(mission["id"], "cancelled")
    robot.rule(refuse=None)
    verdict = judge([], [robot.journal], plain(fleet.database))
    assert verdict.twice == ()


def test_a_stop_is_told_by_number_and_repeated_until_it_is_confirmed(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    robots = [make_robot(f"r{number}") for number in (1, 2, 3)]
    for robot in robots:
        robot.rule(work_s=600.0)
    fleet.add(*robots)
    fleet.start()
    fleet.await_ready(3)
    running = [mission["id"] for mission in fleet.give("everybody go home")]
    for mission_id in running:
        fleet.await_state(mission_id, "at_robot")
    (waiting,) = fleet.give("r2: go to the hall")
    robots[2].kill()
    told = fleet.client.post("/v1/stop").json()
    assert told["message"]["en"] == "2 of 3 confirmed, r3 not reached"
    assert fleet.mission(waiting["id"])["reason"] == "stopped_first"
    assert fleet.mission(running[0])["goal_state"] in ("running", "paused")
    fleet.kill()  # a stop that is not confirmed survives the service
    fleet.start()
    robots[2].start()
    until(lambda: not fleet.client.get(f"/v1/stop/{told['id']}").json()["not_reached"])
    (by_word,) = [fleet.client.post("/v1/missions", json={"text": "大家停下"}).json()]
    assert by_word["missions"] == []
    assert len(by_word["stop"]["confirmed"]) == 3


def test_a_token_withdrawn_and_another_robot_at_the_address(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    robot = make_robot("r1")
    robot.rule(token="a", work_s=600.0)
    assert fleet.run("add", robot.url).returncode == 3
    assert "token_refused" in fleet.run("add", robot.url, "--token", "b").stderr
    assert fleet.run("add", robot.url, "--token", "a").returncode == 0
    assert (fleet.home / "fleet" / "tokens" / "r1").stat().st_mode & 0o777 == 0o600
    fleet.start()
    fleet.await_ready(1)
    (mission,) = fleet.give("go to the kitchen")
    fleet.await_state(mission["id"], "at_robot")
    robot.rule(token="new")

    def trouble() -> str:
        state: str = fleet.client.get("/v1/robots").json()["robots"][0]["state"]
        return state

    until(lambda: trouble() == "token_needed")
    fleet.await_state(mission["id"], "unknown")
    robot.rule(token="a", id="another")
    robot.kill()
    robot.start()
    robot.rule(token="a", id="another")
    (second,) = fleet.give("go to the hall")
    until(lambda: trouble() == "robot_mismatch")
    assert fleet.mission(second["id"])["state"] == "waiting"


def test_a_refusal_by_the_robot_ends_the_mission_with_its_code(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    robot = make_robot("r1")
    fleet.add(robot)
    fleet.start()
    fleet.await_ready(1)
    robot.rule(refuse=422)
    (mission,) = fleet.give("go to the kitchen")
    refused = fleet.await_state(mission["id"], "refused")
    assert refused["reason"] == "refused_by_rule"


def test_an_upgrade_with_missions_pending_strands_none(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    robot = make_robot("r1")
    robot.rule(work_s=3.0)
    fleet.add(robot)
    fleet.start("fleet.workflow.APPLICATION_VERSION = 'of-before'")
    fleet.await_ready(1)
    (mission,) = fleet.give("go to the kitchen")
    fleet.await_state(mission["id"], "at_robot")
    fleet.kill()
    fleet.start("fleet.workflow.STANDS_STILL_S = 1.0", "fleet.workflow.SWEEP_S = 0.5")
    fleet.await_state(mission["id"], "succeeded")
    assert fleet.client.get("/healthz").json()["swept"] >= 1
    assert judge([mission["id"]], [robot.journal], plain(fleet.database)).twice == ()


@pytest.mark.parametrize("by", [signal.SIGTERM, signal.SIGINT])
def test_a_service_that_is_asked_to_end_leaves_its_missions_to_the_next(
    fleet: RunningFleet, make_robot: MakeRobot, by: signal.Signals
) -> None:
    robot = make_robot("r1")
    robot.rule(work_s=2.0)
    fleet.add(robot)
    fleet.start()
    fleet.await_ready(1)
    (mission,) = fleet.give("go to the kitchen")
    fleet.await_state(mission["id"], "at_robot")
    fleet.kill(by)
    fleet.start()
    fleet.await_state(mission["id"], "succeeded")
