"""Tell what bad inputs do: each is told with a code, nothing is lost, and nothing is done twice."""

from __future__ import annotations

import resource
import time
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Any

import pytest

from fleet.answers import read_card
from fleet.errors import FleetError
from tests.fleet.conftest import RunningFleet, StubRobot, until
from tests.fleet.judge import CLEAN, judge

MakeRobot = Callable[[str], StubRobot]

pytestmark = [
    pytest.mark.e2e,
    pytest.mark.long,
    pytest.mark.timeout(600),
    pytest.mark.nightly(keep=3),
]

OTHER_MAP = "ffeeddccbbaa9988"


@pytest.mark.parametrize(
    "card",
    [
        [],
        {},
        {"robot_id": ""},
        {"robot_id": 7},
        {"robot_id": "r1", "places": "kitchen"},
        {"robot_id": "r1", "places": [{"name": {"en": "hall"}}]},
        {"robot_id": "r1", "places": [{"id": "hall", "name": ["hall"]}]},
        {"robot_id": "r1", "places": [{"id": "hall", "pose": {"x_m": float("nan"), "y_m": 0}}]},
        {"robot_id": "r1", "places": [{"id": "x"}] * 2_001},
    ],
)
def test_a_card_without_the_shape_is_refused(card: Any) -> None:
    with pytest.raises(FleetError) as refused:
        read_card(card, "r1")
    assert refused.value.code == "card_unread"


def test_a_card_of_another_version_may_have_more_or_less() -> None:
    more = {"robot_id": "r1", "arms": 2, "places": [{"id": "hall", "floor": 3}]}
    assert read_card(more, "r1") == more
    assert read_card({"robot_id": "r1"}, "r1") == {"robot_id": "r1"}


def test_a_robot_whose_card_is_not_read_gets_nothing_and_the_others_notice_nothing(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    odd, other = make_robot("odd"), make_robot("plain")
    odd.rule(card={"places": "none of yours"})
    refused = fleet.run("add", odd.url)
    assert (refused.returncode, "card_unread" in refused.stderr) == (3, True)
    odd.rule(card={})
    fleet.add(odd, other)
    odd.kill()
    odd.start()
    odd.rule(card={"places": "none of yours"})  # it was updated while it was away
    until(lambda: fleet.states()["odd"] == "card_unread")
    (mine,) = fleet.give("odd: go to the hall")
    (others,) = fleet.give("plain: go to the hall")
    fleet.await_state(others["id"], "succeeded")
    assert (fleet.mission(mine["id"])["state"], odd.goals()) == ("waiting", [])
    odd.rule(card={})
    fleet.await_state(mine["id"], "succeeded")


def test_a_point_of_a_map_of_the_same_name_and_other_content_is_refused_by_its_robot(
    fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    here, there = make_robot("here"), make_robot("there")
    there.rule(map_id=OTHER_MAP)
    fleet.add(here, there)
    maps = {each["name"]: (each["site"], each["map_id"])
            for each in fleet.client.get("/v1/robots").json()["robots"]}  # fmt: skip
    assert maps["here"][0] == maps["there"][0]
    assert maps["here"][1] != maps["there"][1]
    step = {"kind": "go_to_pose", "x_m": 1.0, "y_m": 0.0, "map_id": OTHER_MAP}
    body = {"steps": [step], "to": ["here", "there"]}
    given = fleet.client.post("/v1/missions", json=body).json()["missions"]
    ended = [fleet.await_state(each["id"], "succeeded", "refused") for each in given]
    assert {each["robot"]: each["state"] for each in ended} == {
        "here": "refused",
        "there": "succeeded",
    }
    assert here.acts("begun") == 0


def test_a_clock_that_leaps_by_a_day_changes_neither_order_nor_outcome(
    file_fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    fleet, robot = file_fleet, make_robot("r1")
    leap = "import time; now = time.time; time.time = lambda: now() + {}"
    fleet.add(robot)
    fleet.start(leap.format(86_400.0))
    robot.rule(work_s=600.0)
    fleet.await_ready(robot)
    given = [fleet.give(f"go to the hall {number}")[0]["id"] for number in range(3)]
    fleet.await_state(given[0], "at_robot")
    fleet.kill()
    fleet.start(leap.format(-86_400.0))
    given.append(fleet.give("go to the hall 3")[0]["id"])
    robot.rule(work_s=0.0)
    for mission_id in given:
        fleet.await_state(mission_id, "succeeded")
    assert [text for text, _ in robot.goals()] == [f"go to the hall {n}" for n in range(4)]
    assert judge(given, [robot.journal], fleet.database) == CLEAN


@pytest.mark.parametrize("off_s", [-86_400.0, 86_400.0])
def test_a_robots_clock_a_day_off_moves_no_time_here_and_hides_no_spending(
    file_fleet: RunningFleet, make_robot: MakeRobot, off_s: float
) -> None:
    fleet, robot = file_fleet, make_robot("r1")
    robot.rule(clock_s=off_s, work_s=600.0, model="some", money=2.5)
    fleet.add(robot)
    fleet.start("fleet.watch.SILENT_S = 1.0")
    fleet.await_ready(robot)
    began_unix_s = time.time()
    (mission,) = fleet.give("go to the hall")
    fleet.await_state(mission["id"], "at_robot")
    assert fleet.client.get("/v1/house").json()["spent_today"]["money"] == 2.5
    robot.kill()
    silent = fleet.await_state(mission["id"], "unknown")
    told = [silent[f"{name}_unix_s"] for name in ("created", "unknown_since", "updated")]
    # It is unknown since the robot was heard last, which may be before the order was given.
    assert all(began_unix_s - 60.0 < each <= time.time() for each in told)
    robot.start()
    robot.rule(clock_s=off_s)
    fleet.await_state(mission["id"], "succeeded")
    assert judge([mission["id"]], [robot.journal], fleet.database) == CLEAN


def test_more_orders_at_once_than_may_wait_are_refused_with_a_code_and_the_others_kept(
    file_fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    fleet, robot = file_fleet, make_robot("r1")
    robot.rule(work_s=600.0)
    fleet.add(robot)
    fleet.start("import fleet.store; fleet.store.MOST_WAITING = 100")
    fleet.await_ready(robot)
    (first,) = fleet.give("go to the hall")
    fleet.await_state(first["id"], "at_robot")

    def give(number: int) -> tuple[int, Any]:
        answer = fleet.client.post("/v1/missions", json={"text": f"go to the hall {number}"})
        return answer.status_code, answer.json()

    with ThreadPoolExecutor(20) as many:
        answers = list(many.map(give, range(160)))
    assert Counter(status for status, _ in answers) == {202: 100, 429: 60}
    assert {told["code"] for status, told in answers if status == 429} == {"queue_full"}
    accepted = {each["id"] for status, told in answers if status == 202
                for each in told["missions"]}  # fmt: skip
    changed = fleet.client.get("/v1/missions?after=0&limit=200").json()["missions"]
    assert {each["id"] for each in changed} == accepted | {first["id"]}


@contextmanager
def full_disk(fleet: RunningFleet) -> Iterator[None]:
    """Let no file of the service grow any more, for a while."""
    assert fleet.process is not None
    _, hard = resource.prlimit(fleet.process.pid, resource.RLIMIT_FSIZE)
    resource.prlimit(fleet.process.pid, resource.RLIMIT_FSIZE, (4096, hard))
    try:
        yield
    finally:
        resource.prlimit(fleet.process.pid, resource.RLIMIT_FSIZE, (hard, hard))


def test_a_full_disk_refuses_orders_stops_robots_and_loses_nothing(
    file_fleet: RunningFleet, make_robot: MakeRobot
) -> None:
    fleet, robots = file_fleet, [make_robot("r1"), make_robot("r2")]
    fleet.add(*robots)
    fleet.start("fleet.workflow.STANDS_STILL_S = 1.0; fleet.workflow.SWEEP_S = 0.5")
    fleet.await_ready(*robots)
    robots[0].rule(work_s=600.0)
    (begun,) = fleet.give("r1: go to the hall")
    fleet.await_state(begun["id"], "at_robot")
    with full_disk(fleet):
        refused = fleet.client.post("/v1/missions", json={"text": "r2: go to the hall"})
        assert (refused.status_code, refused.json()["code"]) == (503, "store_unavailable")
        robots[0].rule(work_s=0.0)
        until(lambda: [state for _, state in robots[0].goals()] == ["succeeded"])
        told = fleet.client.post("/v1/stop", json={"robots": ["r2"]}).json()
        assert told["confirmed"] == ["r2"]
        assert robots[1].goals() == []
    fleet.await_state(begun["id"], "succeeded")
    until(lambda: fleet.client.get(f"/v1/stop/{told['id']}").json()["confirmed"] == ["r2"])
    (after,) = fleet.give("r2: go to the hall")
    fleet.await_state(after["id"], "succeeded")
    ids, journals = [begun["id"], after["id"]], [robot.journal for robot in robots]
    assert judge(ids, journals, fleet.database) == CLEAN
