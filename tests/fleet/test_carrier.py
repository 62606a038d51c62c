"""Tell what two services on one Postgres do when either of them falls, freezes or comes back."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

import httpx
import pytest
import sqlalchemy as sa

from fleet.carrier import CarrierLock
from fleet.store import FleetStore
from fleet.tables import missions, robots
from tests.fleet.conftest import RunningFleet, StubRobot, until
from tests.fleet.judge import CLEAN, judge
from tests.fleet.postgres import Cluster, running_cluster
from tests.fleet.test_store import R1, give
from tests.known import known

pytestmark = [
    pytest.mark.e2e,
    pytest.mark.long,
    pytest.mark.timeout(600),
    pytest.mark.nightly(keep=1),
]

Pair = tuple[RunningFleet, RunningFleet]


def carries(service: RunningFleet) -> bool:
    return bool(service.client.get("/healthz").json()["carries"])


def stands_by(service: RunningFleet) -> bool:
    """Return whether it answers and carries nothing; as it begins anew it drops its connections."""
    try:
        return not carries(service)
    except httpx.HTTPError:
        return False


@pytest.fixture
def pair(postgres: Cluster, tmp_path: Path) -> Iterator[Pair]:
    """Return two services on one database and one folder, not yet started."""
    database = postgres.make_database()
    home = tmp_path / "home"
    with RunningFleet(home, database) as first, RunningFleet(home, database) as second:
        yield first, second


def start(pair: Pair, *settings: str) -> Pair:
    """Start both and return the carrier and the one that stands by."""
    for service in pair:
        service.start(*settings)
    first, second = pair
    assert (carries(first), carries(second)) == (True, False)
    return pair


@contextmanager
def awaited_writer(store: FleetStore, act: Callable[[], Any]) -> Iterator[sa.Connection]:
    """Lend a transaction that writes, and end it once the act that was begun in it waits for it."""

    def count_waiting() -> int:
        asked = "SELECT count(*) FROM pg_stat_activity WHERE wait_event_type = 'Lock'"
        with store.reading() as looking:
            return int(looking.execute(sa.text(asked)).scalar_one())

    with ThreadPoolExecutor(1) as other:
        with store.writing() as first:
            yield first
            waiting = other.submit(act)
            until(count_waiting)
        waiting.result(30.0)


def test_a_mission_that_ended_while_another_waited_to_write_stays_ended(postgres: Cluster) -> None:
    store = FleetStore(postgres.make_database())
    store.keep_robot(R1, again=False)
    told = {"id": "g-1", "state": "running"}
    acts: dict[str, Callable[[str], Any]] = {
        "bind": lambda each: store.bind(each, told),
        "goals": lambda _: store.apply_goals("r1", [told]),
        "silent": lambda _: store.mark_silent("r1", 1.0),
        "heard": lambda _: store.mark_heard("r1"),
    }
    for number, act in enumerate(acts.values()):
        mission = give(store, number)
        assert store.claim(mission, "r1") is not None
        store.change(mission.id, is_sent=True, goal_id="g-1")
        with awaited_writer(store, partial(act, mission.id)) as first:
            ended = missions.update().where(missions.c.id == mission.id)
            first.execute(ended.values(state="succeeded", goal_state="succeeded"))
        assert store.mission(mission.id).state == "succeeded"
        store.end(mission.id, "succeeded")
    store.close()


def test_a_stop_waits_for_who_writes_and_holds_no_robots_row_meanwhile(postgres: Cluster) -> None:
    """Else Postgres ends one of the two as a deadlock, after the second that a stop has."""
    store = FleetStore(postgres.make_database())
    store.keep_robot(R1, again=False)
    waiting = give(store, 1)
    with awaited_writer(store, lambda: store.stop("s-1", ["r1"], forever=True)) as telling:
        telling.execute(robots.update().values(cursor=1))
    assert store.mission(waiting.id).state == "cancelled"
    store.close()


def test_one_lock_has_one_holder_and_a_file_is_held_by_whoever_opens_it(
    postgres: Cluster, tmp_path: Path
) -> None:
    store = FleetStore(postgres.make_database())
    first, second = CarrierLock(store.engine), CarrierLock(store.engine)
    assert [first.take(), first.take(), second.take()] == [True, True, False]
    first.close()
    until(second.take)  # the database sees the end of a session a little later
    second.close()
    store.close()
    file = FleetStore(f"sqlite:///{tmp_path / 'fleet.sqlite'}")
    assert CarrierLock(file.engine).take()
    file.close()


@pytest.mark.parametrize("falls", ["carrier", "standby"])
def test_either_falls_in_mid_mission_and_the_other_goes_on(
    pair: Pair, make_robot: Callable[[str], StubRobot], falls: str
) -> None:
    robots = [make_robot(f"r{number}") for number in (1, 2, 3)]
    pair[0].add(*robots)
    carrier, standby = start(pair)
    for robot in robots:
        robot.rule(work_s=600.0, lose_answers=1)
    carrier.await_ready(*robots)
    accepted = [mission["id"] for mission in carrier.give("everybody go home")]
    for service in (carrier, standby) * 3:  # both accept, whoever carries
        accepted += [mission["id"] for mission in service.give("go to the hall")]
    for robot in robots:
        until(robot.goals)
    fallen, left = (carrier, standby) if falls == "carrier" else (standby, carrier)
    fallen.kill()
    accepted += [mission["id"] for mission in left.give("go to the kitchen")]
    until(lambda: carries(left))
    for robot in robots:
        robot.rule(work_s=0.0)
    fallen.start()  # it comes back, and stands by
    assert not carries(fallen)
    for mission_id in accepted:
        assert fallen.await_state(mission_id, "succeeded")
    assert judge(accepted, [robot.journal for robot in robots], left.database) == CLEAN


def test_who_stands_by_stops_cancels_and_answers_for_people(
    pair: Pair, make_robot: Callable[[str], StubRobot]
) -> None:
    robots = [make_robot("r1"), make_robot("r2")]
    pair[0].add(*robots)
    carrier, standby = start(pair)
    robots[0].rule(work_s=600.0)
    robots[1].rule(ask=True)
    carrier.await_ready(*robots)
    (long,), (asker,) = standby.give("r1: go to the hall"), standby.give("r2: look at the door")
    standby.await_state(asker["id"], "asking")
    path = f"/v1/missions/{asker['id']}/answer"
    assert standby.client.post(path, json={"text": "the back one"}).is_success
    standby.await_state(asker["id"], "succeeded")
    standby.await_state(long["id"], "at_robot")
    cancel = f"/v1/missions/{long['id']}/cancel"
    refused = standby.client.post(cancel, json={"give_up": True})
    assert refused.json()["code"] == "not_silent"
    standby.client.post(cancel, json={}).raise_for_status()
    standby.await_state(long["id"], "cancelled")
    told = standby.client.post("/v1/stop").json()
    assert (sorted(told["confirmed"]), told["not_reached"]) == (["r1", "r2"], [])
    robots[1].kill()
    told = standby.client.post("/v1/stop").json()
    assert told["message"]["en"] == "1 of 2 confirmed, r2 not reached"
    robots[1].start()  # the carrier repeats what the other one noted
    until(lambda: not carrier.client.get(f"/v1/stop/{told['id']}").json()["not_reached"])


def test_a_carrier_that_froze_stands_by_when_it_wakes(
    pair: Pair, make_robot: Callable[[str], StubRobot]
) -> None:
    robot = make_robot("r1")
    pair[0].add(robot)
    carrier, standby = start(pair)
    robot.rule(work_s=600.0)
    carrier.await_ready(robot)
    (mission,) = carrier.give("go to the hall")
    carrier.await_state(mission["id"], "at_robot")
    known(carrier.process).send_signal(signal.SIGSTOP)
    try:
        until(lambda: carries(standby))
    finally:
        known(carrier.process).send_signal(signal.SIGCONT)
    until(lambda: stands_by(carrier))
    robot.rule(work_s=0.0)
    carrier.await_state(mission["id"], "succeeded")
    assert judge([mission["id"]], [robot.journal], carrier.database) == CLEAN


def test_postgres_away_refuses_orders_with_a_code_stops_robots_and_goes_on_when_it_is_back(
    tmp_path: Path, make_robot: Callable[[str], StubRobot]
) -> None:
    robot = make_robot("r1")
    with (
        running_cluster() as cluster,
        RunningFleet(tmp_path / "home", cluster.make_database()) as fleet,
    ):
        fleet.add(robot)
        fleet.start()
        robot.rule(work_s=600.0)
        fleet.await_ready(robot)
        (mission,) = fleet.give("go to the hall")
        fleet.await_state(mission["id"], "at_robot")
        (waiting,) = fleet.give("go to the kitchen")
        cluster.stop()
        refused = fleet.client.post("/v1/missions", json={"text": "go to the hall"})
        assert (refused.status_code, refused.json()["code"]) == (503, "store_unavailable")
        told = fleet.client.post("/v1/stop").json()
        assert told["confirmed"] == ["r1"]
        assert robot.acts("stop") == 1
        cluster.start()
        fleet.await_state(waiting["id"], "cancelled")  # what was ordered before the stop
        assert fleet.client.get(f"/v1/stop/{told['id']}").json()["confirmed"] == ["r1"]
        robot.rule(work_s=0.0, resume=True)
        fleet.await_state(mission["id"], "succeeded")
        assert (carries(fleet), robot.acts("stop")) == (True, 1)
        (after,) = fleet.give("go to the kitchen")
        fleet.await_state(after["id"], "succeeded")
        ids = [mission["id"], after["id"]]
        assert judge(ids, [robot.journal], fleet.database) == CLEAN


def test_an_outage_of_postgres_longer_than_a_minute_ends_as_a_short_one(
    tmp_path: Path, make_robot: Callable[[str], StubRobot]
) -> None:
    """A goal ends meanwhile, another is cut in its offer; the engine's longest pause is 90 s."""
    robots = [make_robot("r1"), make_robot("r2")]
    with (
        running_cluster() as cluster,
        RunningFleet(tmp_path / "home", cluster.make_database()) as fleet,
    ):
        fleet.add(*robots)
        fleet.start()
        robots[0].rule(work_s=600.0)
        fleet.await_ready(*robots)
        given = [fleet.give("r1: go to the hall")[0]["id"]]
        fleet.await_state(given[0], "at_robot")
        given += [fleet.give("r2: go to the hall")[0]["id"]]
        cluster.stop()
        robots[0].rule(work_s=0.0)
        time.sleep(65.0)
        refused = fleet.client.post("/v1/missions", json={"text": "go to the hall"})
        assert (refused.status_code, refused.json()["code"]) == (503, "store_unavailable")
        cluster.start()
        until(lambda: {fleet.mission(each)["state"] for each in given} == {"succeeded"}, 200.0)
        assert carries(fleet)
        assert judge(given, [robot.journal for robot in robots], fleet.database) == CLEAN
