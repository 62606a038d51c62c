"""robot.toml changes under a running planner: the bridge refuses it and a person is told so."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.e2e.polling import until
from tests.e2e.system import ROOT, Json, System

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(150), pytest.mark.nightly]

BEFORE, AFTER = "max_speed_mps = 0.5", "max_speed_mps = 0.4"


@pytest.fixture
def system(home: Path) -> Iterator[System]:
    robot = home / "robot.toml"
    robot.write_text((ROOT / "robot.toml").read_text("utf-8"), "utf-8")
    with System(home, PONS_ROBOT=str(robot)).running() as found:
        yield found


def status(system: System) -> Json:
    try:
        found: Json = system.http("GET", "/v1/robot").body["status"] or {}
    except OSError:
        return {}  # no planner serves now
    return found


def refused(system: System) -> bool:
    answers = status(system).get("answers", [])
    return any(a["kind"] == "hello" and a["code"] == "robot_mismatch" for a in answers)


def test_a_bridge_with_another_robot_file_refuses_the_planner_and_says_so(system: System) -> None:
    boot = status(system)["boot"]
    robot = system.home / "robot.toml"
    text = robot.read_text("utf-8")
    assert text.count(BEFORE) == 1
    robot.write_text(text.replace(BEFORE, AFTER), "utf-8")
    system.kill("bridge")  # `pons up` starts it again, and it reads the file anew
    until(lambda: status(system).get("boot") not in {None, boot}, 30.0, "a new run", system.logs)
    until(lambda: refused(system), 30.0, "a hello refused", system.logs)

    def told() -> str:
        said = system.pons("status").stdout
        return said if "robot_mismatch" in said else ""

    said = until(told, 10.0, "the refusal on `pons status`", system.logs)
    assert "robot.toml files that differ" in said
    assert "请把两者都结束" in system.pons("status", chinese=True).stdout
    assert status(system)["owner"] is None, "it is refused for as long as it asks"

    system.kill("planner")  # the new one reads the same file
    until(lambda: status(system).get("owner"), 30.0, "an owner again", system.logs)
    assert not refused(system)
