"""Try the wizard by the facts that it goes by; ports alone are played."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path
from typing import Any

import pytest

from planner.setup_wizard import KEPT, STEPS, CommandResult, SetupWizard, WizardRefusal
from planner.site import KnownPlaces
from tests.planner.api.fakes import two_room
from wire import RobotDescription, load_robot

BASE = {"wheel_radius_m": 0.034, "wheel_separation_m": 0.21, "radius_m": 0.19}
PORT: dict[str, Any] = {
    "path": "/dev/ttyUSB0", "lasting": "/dev/serial/by-id/x", "usb": None, "code": "port_found",
    "detail": "", "message": {"en": "", "zh": ""}, "part": "lidar", "kind": "ld19", "baud": 230400,
    "answer": {"words": "LD19", "keys": {}, "missing": {}}, "twins": [],
}  # fmt: skip


def wizard_of(home: Path, robot: RobotDescription | None = None, site: Path | None = None,
              found: tuple[dict[str, Any], ...] = (PORT,)) -> SetupWizard:  # fmt: skip
    async def run(*words: str, limit_s: float = 40.0) -> CommandResult:
        if words[1:2] == ("find",):
            await asyncio.sleep(0)
            content = {"ports": list(found), "cameras": [], "port_takers": []}
            return CommandResult(0, json.dumps(content), "")
        return await made._run_pons(*words, limit_s=limit_s)

    made = SetupWizard(
        home, robot or RobotDescription(), site or two_room().folder,
        lambda: KnownPlaces(two_room()), run=run,
    )  # fmt: skip
    return made


def view(wizard: SetupWizard) -> dict[str, Any]:
    return asyncio.run(wizard.view())


def test_an_empty_folder_becomes_a_robot_step_by_step_and_each_page_goes_on_there(
    tmp_path: Path,
) -> None:
    assert view(wizard_of(tmp_path))["step"] == "look"
    asyncio.run(wizard_of(tmp_path).look())
    seen = view(wizard_of(tmp_path))
    assert (seen["step"], seen["ports"][0]["device"]) == ("choose", "lidar ld19: LD19")
    assert seen["presets"][0]["name"] == "pons_mcu_ld19", "what was found comes first"
    asyncio.run(wizard_of(tmp_path).choose("pons_mcu_ld19"))
    seen = view(wizard := wizard_of(tmp_path))
    assert (seen["step"], seen["preset"]) == ("measure", "pons_mcu_ld19")
    asyncio.run(wizard.measure("rover", BASE))
    robot = load_robot(tmp_path / "robot.toml")
    assert (robot.id, robot.base.radius_m, robot.lidar.port) == ("rover", 0.19, PORT["lasting"])
    assert robot.limits.max_speed_mps == 0.34, "wheels as small as these reach no more"
    assert "better its name below" in (tmp_path / "robot.toml").read_text("utf-8")
    seen = view(wizard_of(tmp_path))
    assert (seen["step"], seen["done"]) == ("try", ["look", "choose", "measure"])
    with pytest.raises(WizardRefusal, match="robot_exists"):
        asyncio.run(wizard.measure("other", BASE))


def test_a_robot_with_rooms_on_a_map_of_its_own_has_nothing_left_to_do(tmp_path: Path) -> None:
    robot = load_robot_with_trial(tmp_path)
    assert view(wizard_of(tmp_path, robot))["step"] == "map"
    seen = view(wizard_of(tmp_path, robot, tmp_path / "sites" / "flat"))
    assert (seen["step"], seen["done"]) == (None, list(STEPS))


def load_robot_with_trial(home: Path) -> RobotDescription:
    """Return a robot that counts as tried: one of ROS 2 proves itself at each self test."""
    text = (Path("robots") / "ros2_diff_drive.toml").read_text("utf-8")
    (home / "robot.toml").write_text(text, "utf-8")
    return load_robot(home / "robot.toml")


@pytest.mark.parametrize(
    ("act", "code"),
    [
        (lambda w: w.choose("<b>mine</b>"), "preset_unknown"),
        (lambda w: w.measure("rover", BASE), "wizard_unchosen"),
    ],
)
def test_a_step_out_of_its_turn_is_refused(tmp_path: Path, act: Any, code: str) -> None:
    wizard = wizard_of(tmp_path)
    with pytest.raises(WizardRefusal) as refused:
        asyncio.run(act(wizard))
    assert refused.value.code == code
    assert not (tmp_path / "robot.toml").exists()


def test_what_is_kept_may_be_spoilt_and_nothing_plugged_in_is_an_answer_too(tmp_path: Path) -> None:
    (tmp_path / KEPT).write_text("[1, 2", "utf-8")
    wizard = wizard_of(tmp_path, found=())
    assert view(wizard)["step"] == "look"
    asyncio.run(wizard.look())
    assert (view(wizard)["step"], view(wizard)["ports"]) == ("choose", [])


def test_two_pages_that_look_at_once_open_each_port_once(tmp_path: Path) -> None:
    async def both() -> list[object]:
        wizard = wizard_of(tmp_path)
        return list(await asyncio.gather(wizard.look(), wizard.look(), return_exceptions=True))

    first, second = asyncio.run(both())
    assert first is None
    assert isinstance(second, WizardRefusal)
    assert second.code == "wizard_busy"


def test_a_map_that_grows_or_was_half_written_is_none_yet(tmp_path: Path) -> None:
    robot = load_robot_with_trial(tmp_path)
    (tmp_path / "sites" / ".home.1f2e.new").mkdir(parents=True)
    (tmp_path / "sites" / ".home.1f2e.new" / "map.yaml").touch()
    assert view(wizard_of(tmp_path, robot))["step"] == "map"
    seen = view(wizard_of(tmp_path, robot, tmp_path / "mapping" / "home"))
    assert (seen["step"], seen["mapping"]) == ("map", "home")


def test_a_map_is_saved_by_pons_itself_and_one_without_a_drive_is_none(tmp_path: Path) -> None:
    wizard = wizard_of(tmp_path, site=tmp_path / "mapping" / "home")
    with pytest.raises(WizardRefusal) as refused:
        asyncio.run(wizard.save_map())
    assert (refused.value.code, refused.value.unnamed) == ("map_not_begun", "map_unsaved")
    assert not (tmp_path / "sites").exists()
