"""Let robots lie, stall and pour: the others' missions end as ever, and the service stays small."""

from __future__ import annotations

import time
from collections.abc import Callable

import psutil
import pytest

from tests.fleet.conftest import RunningFleet, StubRobot
from tests.fleet.judge import CLEAN, judge
from tests.known import known

pytestmark = [pytest.mark.e2e, pytest.mark.long, pytest.mark.timeout(600), pytest.mark.nightly]
EVIL = ("html", "endless", "slow", "never", "cursor", "pages", "goals", "status", "another")
GROWS_MB = 60.0


def test_hostile_robots_harm_no_other(
    file_fleet: RunningFleet, make_robot: Callable[[str], StubRobot]
) -> None:
    fleet = file_fleet
    honest = [make_robot(f"honest{number}") for number in range(2)]
    evil = [make_robot(how) for how in EVIL]
    fleet.add(*honest, *evil)
    fleet.start("fleet.watch.SILENT_S = 2.0")
    fleet.await_ready(*honest, *evil)
    service = psutil.Process(known(fleet.process).pid)
    first = fleet.give("nearest: go to the hall")  # the first choice of all loads scipy
    fleet.await_state(first[0]["id"], "succeeded")
    for robot in evil:
        robot.rule(evil=robot.name)
    lured = [fleet.give(f"{robot.name}: go to the hall")[0]["id"] for robot in evil]
    before_mb = service.memory_info().rss / 1e6
    accepted: list[str] = []
    for number in range(10):
        for robot in honest:
            accepted += [each["id"] for each in fleet.give(f"{robot.name}: go to the hall")]
        fleet.give(f"nearest: go to the hall {number}")  # whoever goes, all are asked the way
        time.sleep(1.0)
    for mission_id in accepted:
        fleet.await_state(mission_id, "succeeded")
    states = fleet.states()
    assert {states[robot.name] for robot in honest} == {"ready"}
    told = {fleet.mission(mission_id)["state"] for mission_id in lured}
    assert told <= {"waiting", "offered", "at_robot", "unknown", "succeeded"}
    assert service.memory_info().rss / 1e6 - before_mb < GROWS_MB
    assert (
        fleet.client.post("/v1/stop", json={"robots": ["honest0", "honest1"]}).json()["not_reached"]
        == []
    )
    assert judge(accepted, [robot.journal for robot in honest], fleet.database) == CLEAN
