"""Put a backup back in mid-mission, as docs/fleet.md says: nothing is done twice."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest

from tests.fleet.conftest import RunningFleet, StubRobot, fleet_on_file
from tests.fleet.judge import CLEAN, judge
from tests.fleet.postgres import running_cluster

pytestmark = [pytest.mark.e2e, pytest.mark.long, pytest.mark.timeout(600), pytest.mark.nightly]


def run_on(
    fleet: RunningFleet, robot: StubRobot, back_up: Callable[[], None], put_back: Callable[[], None]
) -> None:
    """Back up with one mission at its robot and one that waits; end both; put the backup back."""
    fleet.add(robot)
    fleet.start()
    robot.rule(work_s=600.0)
    fleet.await_ready(robot)
    (begun,), (waiting,) = fleet.give("go to the hall"), fleet.give("go to the kitchen")
    fleet.await_state(begun["id"], "at_robot")
    back_up()  # while it runs
    robot.rule(work_s=0.0)
    for mission in (begun, waiting):
        fleet.await_state(mission["id"], "succeeded")
    (after,) = fleet.give("go to the hall")
    fleet.await_state(after["id"], "succeeded")
    assert robot.acts("begun") == 3
    fleet.kill()
    put_back()
    fleet.start("fleet.workflow.STANDS_STILL_S = 1.0; fleet.workflow.SWEEP_S = 0.5")
    for mission in (begun, waiting):
        fleet.await_state(mission["id"], "succeeded")
    assert robot.acts("begun") == 3
    missing = fleet.client.get(f"/v1/missions/{after['id']}")
    assert missing.json()["code"] == "unknown_mission"  # what came after the backup is not known
    assert judge([begun["id"], waiting["id"]], [robot.journal], fleet.database) == CLEAN


def test_a_copy_of_the_file_by_sqlites_backup(
    tmp_path: Path, make_robot: Callable[[str], StubRobot]
) -> None:
    file, copy = tmp_path / "fleet.sqlite", tmp_path / "copy.sqlite"

    def back_up() -> None:
        with closing(sqlite3.connect(file)) as live, closing(sqlite3.connect(copy)) as kept:
            live.backup(kept)

    def put_back() -> None:
        for old in (file, tmp_path / "fleet.sqlite-wal", tmp_path / "fleet.sqlite-shm"):
            old.unlink(missing_ok=True)
        copy.rename(file)

    with fleet_on_file(tmp_path) as fleet:
        run_on(fleet, make_robot("r1"), back_up, put_back)


def test_a_dump_of_postgres(tmp_path: Path, make_robot: Callable[[str], StubRobot]) -> None:
    with running_cluster() as cluster:
        database = cluster.make_database()
        name = database.split("@/")[1].partition("?")[0]
        dump = str(cluster.place / "dump")

        def back_up() -> None:
            cluster.run("pg_dump", "-Fc", "-f", dump, name)

        def put_back() -> None:
            cluster.run("dropdb", "--force", name)
            cluster.run("createdb", name)
            cluster.run("pg_restore", "-d", name, dump)

        with RunningFleet(tmp_path / "home", database) as fleet:
            run_on(fleet, make_robot("r1"), back_up, put_back)
