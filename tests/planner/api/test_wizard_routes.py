"""Try the wizard's routes: what a step refuses is told in both languages, and who may go on."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from planner.setup_wizard import CommandResult, SetupWizard
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


def seeing(base: dict[str, Any] | None = None) -> RobotDescription:
    """Return a robot of metal with a lidar, or another one."""
    drive = {"kind": "pons_mcu", "port": "/dev/x", "ticks_per_turn": 4096}
    lidar = {"kind": "ld19", "port": "/dev/y"}
    return RobotDescription.model_validate(base or {"drive": drive, "lidar": lidar})


BLIND = {"drive": {"kind": "pons_mcu", "port": "/dev/x", "ticks_per_turn": 4096}}


SAVED = CommandResult(0, "", "")


def mapper(
    home: Path, *, robot: RobotDescription | None = None, mode: Mode = Mode.HOLD,
    maps: str | None = None, saved: CommandResult = SAVED,
) -> tuple[FakeServices, list[tuple[str, ...]]]:  # fmt: skip
    asked: list[tuple[str, ...]] = []

    async def run(*words: str, **_: float) -> CommandResult:
        asked.append(words)
        if saved.status == 0:
            (home / "sites" / words[1]).mkdir(parents=True)
        return saved

    made = services_of(home, mode)
    site = made.site.folder if maps is None else home / "mapping" / maps
    made.wizard = SetupWizard(home, robot or seeing(), site, lambda: made.memory, run=run)
    return made, asked


def test_a_map_of_this_home_is_begun_standing_and_the_starter_is_told(tmp_path: Path) -> None:
    services, _ = mapper(tmp_path)
    assert post(services, "map", {}) == (202, "")
    assert services.change_map.is_thrown
    assert not services.take_robot.is_thrown
    assert list((tmp_path / "sites").glob("*")) == [], "nothing is a site before it is saved"


def refused_beginning(home: Path, case: str) -> FakeServices:
    """Return a home in which no map can be begun."""
    if case == "site_exists":
        (home / "sites" / "home").mkdir(parents=True)
    if case == "site_unwritable":
        (home / "mapping").write_text("a file where a folder belongs")
    services, _ = mapper(
        home,
        robot=seeing(BLIND) if case == "map_no_lidar" else None,
        mode=Mode.TELEOP if case == "robot_moves" else Mode.HOLD,
        maps="home" if case == "mapping_already" else None,
    )
    services.change_map.is_there = case != "map_elsewhere"
    return services


@pytest.mark.parametrize(
    "code",
    ["robot_moves", "map_no_lidar", "mapping_already", "site_exists", "site_unwritable",
     "map_elsewhere"],
)  # fmt: skip
def test_a_map_that_can_not_be_begun_leaves_what_runs(tmp_path: Path, code: str) -> None:
    services = refused_beginning(tmp_path, code)
    assert post(services, "map", {}) == (409, code)
    assert not services.change_map.is_thrown


def test_a_full_disk_begins_no_map(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("planner.setup_wizard.MIN_FREE_BYTES", float("inf"))
    services, _ = mapper(tmp_path)
    assert post(services, "map", {}) == (409, "disk_full")
    assert not services.change_map.is_thrown


def test_the_map_is_saved_by_the_shells_command_before_anything_ends(tmp_path: Path) -> None:
    services, asked = mapper(tmp_path, maps="home")
    with client_of(services) as client:
        told = client.get("/v1/wizard").json()
    assert (told["mapping"], told["can_map"], "map" in told["done"]) == ("home", True, False)
    assert post(services, "map/save", {}) == (202, "")
    assert asked == [("map", "home")]
    assert services.change_map.is_thrown


@pytest.mark.parametrize(
    ("error", "code"),
    [
        ("refused: map_no_drive: the drive gave 1 keyframes", "map_no_drive"),
        ("refused: map_torn: something new\n  and more", "map_torn"),
        ("refused: 名称未能保存：已满", "map_unsaved"),
        ("Traceback (most recent call last):\n  File: x", "map_unsaved"),
        ("", "map_unsaved"),
    ],
)
def test_a_map_that_is_not_saved_goes_on_growing(tmp_path: Path, error: str, code: str) -> None:
    services, _ = mapper(tmp_path, maps="home", saved=CommandResult(3, "", error))
    assert post(services, "map/save", {}) == (409, code)
    assert not services.change_map.is_thrown


def test_nothing_is_saved_of_a_robot_that_moves_or_maps_nothing(tmp_path: Path) -> None:
    services, asked = mapper(tmp_path, maps="home", mode=Mode.ACTIVE)
    assert post(services, "map/save", {}) == (409, "robot_moves")
    assert asked == []
    services, _ = mapper(tmp_path, maps="home")
    (tmp_path / "sites" / "home").mkdir(parents=True)
    assert post(services, "map/save", {}) == (409, "site_exists")
    services, _ = mapper(tmp_path)
    assert post(services, "map/save", {}) == (409, "not_mapping")
    services.change_map.is_there = False
    assert post(services, "map/save", {}) == (409, "map_elsewhere")
