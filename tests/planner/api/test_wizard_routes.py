"""Try the wizard's routes: what a step refuses is told in both languages, and who may go on."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from planner.setup_wizard import SetupWizard
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of
from tests.wire.examples import STATUS
from wire import Mode, RobotDescription

MEASURES = {"name": "rover", "wheel_radius_m": 0.03, "wheel_separation_m": 0.2, "radius_m": 0.2}


def services_of(home: Path, mode: Mode = Mode.HOLD) -> FakeServices:
    made = FakeServices(STATUS.model_copy(update={"mode": mode}))
    site = made.site.folder
    made.wizard = SetupWizard(home, RobotDescription(), site, lambda: made.memory)
    return made


def post(services: FakeServices, path: str, body: dict[str, Any]) -> tuple[int, str]:
    with client_of(services) as client:
        answer = client.post(f"/v1/wizard/{path}", json=body)
        told = answer.json()
        assert answer.status_code == 202 or told["message"]["zh"] != told["message"]["en"]
        return answer.status_code, told.get("code", "")


def test_the_first_step_is_to_look_and_each_page_is_told_so(tmp_path: Path) -> None:
    with client_of(services_of(tmp_path)) as client:
        told = client.get("/v1/wizard").json()
    assert (told["step"], told["done"], told["can_take"]) == ("look", [], True)


@pytest.mark.parametrize(
    ("more", "code"),
    [
        ({"name": "<b>"}, "invalid_request"),
        ({"name": "Rover One"}, "invalid_request"),
        ({"radius_m": 0.0}, "invalid_request"),
        ({"wheel_radius_m": "0.03"}, "invalid_request"),
        ({}, "wizard_unchosen"),
    ],
)
def test_measures_that_do_not_fit_write_nothing(
    tmp_path: Path, more: dict[str, Any], code: str
) -> None:
    status, told = post(services_of(tmp_path), "robot", {**MEASURES, **more})
    assert told == code
    assert status == (409 if code == "wizard_unchosen" else 422)
    assert list(tmp_path.iterdir()) == []


def test_the_robot_is_changed_standing_and_where_somebody_starts_the_other(tmp_path: Path) -> None:
    assert post(services_of(tmp_path, Mode.ACTIVE), "take", {}) == (409, "robot_moves")
    services = services_of(tmp_path)
    services.take_robot.is_there = False
    assert post(services, "take", {}) == (409, "wizard_elsewhere")
    services.take_robot.is_there = True
    assert post(services, "take", {}) == (202, "")
    assert services.take_robot.is_thrown
