"""The units: separate users, rights for the loop alone, and nothing that systemd does not know."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from planner.__main__ import NICE as PLANNER_NICE
from pons.supervisor import HANG_S
from sim.camera.__main__ import NICE as CAMERA_NICE
from tests.deploy.deployed_users import folders, members
from tests.deploy.installed import (
    PROCESSES,
    UNITS,
    by_compose,
    by_units,
    services,
    unit,
    weight_of,
)
from wire import load_robot
from wire.doors import BRIDGE_DOOR, DOORS
from wire.keys import Party

ORDINARY = 100
"""Of who says nothing (systemd.resource-control(5))."""


def test_planner_bridge_and_simulator_are_users_of_their_own() -> None:
    users = {name: one["Service"]["User"] for name, one in services().items()}
    assert len({tuple(user) for user in users.values()}) == len(PROCESSES)
    assert {tuple(one["Service"]["Group"]) for one in services().values()} == {("pons",)}
    known = (UNITS / "pons.sysusers.conf").read_text()
    for (user,) in users.values():
        assert f"u {user} " in known
        assert f"m {user} pons" in known


def test_the_bridge_is_watched_and_may_be_real_time(repository: Path) -> None:
    bridge = services()["bridge"]["Service"]
    assert bridge["Type"] == ["notify"]
    assert bridge["WatchdogSec"] == ["1"]
    assert bridge["LimitMEMLOCK"] == ["infinity"]
    assert int(bridge["LimitRTPRIO"][0]) >= load_robot(repository / "robot.toml").realtime.priority
    assert "CPUSchedulingPolicy" not in bridge, "one thread asks for it, by itself"
    assert "RestrictRealtime" not in bridge


def test_a_planner_that_hangs_is_started_again() -> None:
    planner = services()["planner"]["Service"]
    assert planner["Type"] == ["notify"]
    assert planner["WatchdogSec"] == [f"{HANG_S:g}"], "as under pons up"
    assert planner["Restart"] == ["always"]


def test_the_planner_has_files_for_a_crowd_at_its_door() -> None:
    assert services()["planner"]["Service"]["LimitNOFILE"] == ["65536"]


@pytest.mark.parametrize("name", [name for name in PROCESSES if name != "bridge"])
def test_nobody_else_may_be_real_time(name: str) -> None:
    service = services()[name]["Service"]
    assert service["RestrictRealtime"] == ["yes"]
    assert "LimitRTPRIO" not in service
    assert "MemoryMax" in service


def test_a_service_weighs_what_its_process_would_elsewhere_and_nobody_before_who_drives() -> None:
    """A service is a group of its own: its processes' nice counts for nothing outside it."""
    weights = {name: int(one["Service"]["CPUWeight"][0]) for name, one in services().items()}
    assert weights["planner"] == pytest.approx(weight_of(PLANNER_NICE, ORDINARY), rel=0.02)
    assert weights["camera"] == pytest.approx(weight_of(CAMERA_NICE, ORDINARY), rel=0.02)
    for name in ("bridge", "sim", "localization"):
        assert weights[name] > 2 * weights["planner"], name


@pytest.mark.parametrize("name", PROCESSES)
def test_every_service_is_hardened_and_does_not_repeat_a_refusal(name: str) -> None:
    service = services()[name]["Service"]
    for setting, value in {
        "NoNewPrivileges": "yes",
        "CapabilityBoundingSet": "",
        "ProtectSystem": "strict",
        "ProtectHome": "yes",
        "PrivateTmp": "yes",
        "ReadWritePaths": "/var/lib/pons",
        "UMask": "0077",
        "SystemCallArchitectures": "native",
        "RestartPreventExitStatus": "2",
        "Restart": "always",
    }.items():
        assert service[setting] == [value], setting


OF_DEVICES = {"SupplementaryGroups", "DevicePolicy", "DeviceAllow", "PrivateDevices"}


@pytest.mark.parametrize(
    ("name", "other", "module", "user", "devices"),
    [
        ("lidar", "localization", "sensors.lidar", "pons-lidar", "ttyUSB ttyACM ttyAMA ttyS"),
        ("imu", "localization", "sensors.imu", "pons-imu", "i2c"),
        ("uvc", "camera", "sensors.camera", "pons-camera", "video4linux media usb_device"),
        ("ros2", "localization", "ros2", "pons-ros2", ""),
    ],
)
def test_a_service_beside_is_hardened_as_another_and_opens_its_own_devices_alone(
    name: str, other: str, module: str, user: str, devices: str
) -> None:
    described = unit(UNITS / f"pons-{name}.service")
    service, hardened = described["Service"], unit(UNITS / f"pons-{other}.service")["Service"]
    own = {"ExecStart", "User", "MemoryMax"} | (OF_DEVICES if devices else set())
    assert {n: v for n, v in service.items() if n not in own} == {
        n: v for n, v in hardened.items() if n not in own
    }
    assert service["User"] == [user], "a door's folder is that user's"
    assert service.get("DeviceAllow", []) == [f"char-{device} rw" for device in devices.split()]
    assert "MemoryMax" in service
    if devices:
        assert service["DevicePolicy"] == ["closed"]
        assert "PrivateDevices" not in service
    assert f"python -m {module} --home /var/lib/pons" in service["ExecStart"][0]
    assert described["Install"]["WantedBy"] == ["pons.target"]


def test_the_fleets_service_is_hardened_as_the_planner_and_of_no_group_of_a_robots() -> None:
    fleet, planner = unit(UNITS / "pons-fleet.service")["Service"], services()["planner"]["Service"]
    hardening = {
        name: value
        for name, value in planner.items()
        if name.startswith(("Protect", "Private", "Rest", "NoNew", "Capability", "Lock", "System"))
    }
    assert {name: fleet.get(name) for name in hardening} == hardening
    assert "RestartPreventExitStatus" in hardening
    assert (fleet["User"], fleet["Group"]) == (["pons-fleet"], ["pons-fleet"])
    known = (UNITS / "pons.sysusers.conf").read_text()
    assert "u pons-fleet " in known
    assert "m pons-fleet" not in known
    assert fleet["StateDirectory"] == ["pons-fleet"]
    assert "ReadWritePaths" not in fleet
    assert fleet["ExecStart"] == ["/opt/pons/.venv/bin/python -m fleet up"]


def test_neither_user_can_replace_what_the_other_made() -> None:
    made = folders()
    assert made["/var/lib/pons"] == ("3770", "root", "pons")
    assert made["/var/lib/pons/fence"] == ("3770", "root", "pons")
    assert made["/var/lib/pons/recordings"] == ("0700", "pons-bridge", "pons")
    assert made["/var/lib/pons/run"] == ("0750", "root", "pons")


def test_every_door_has_a_folder_that_its_listener_alone_writes_and_who_dials_it_enters() -> None:
    made, groups = folders(), members()
    users = {name: one["Service"]["User"][0] for name, one in services().items()}
    user_of = {
        Party.BRIDGE: users["bridge"],
        Party.PLANNER: users["planner"],
        Party.ROBOT: users["sim"],
        Party.LOCALIZATION: users["localization"],
        Party.CAMERA: users["camera"],
        Party.LIDAR: unit(UNITS / "pons-lidar.service")["Service"]["User"][0],
        Party.IMU: unit(UNITS / "pons-imu.service")["Service"]["User"][0],
        Party.ROS2: unit(UNITS / "pons-ros2.service")["Service"]["User"][0],
    }
    for door in DOORS:
        mode, owner, group = made[f"/var/lib/pons/run/{door.name}"]
        assert (mode, owner) == ("2750", user_of[door.listener]), door.name
        entering = groups[group]
        dialling = {user_of[party] for party in door.dialled_by if party in user_of}
        assert dialling <= entering, door.name
        if any(key.path not in {one.path for one in BRIDGE_DOOR.hears} for key in door.hears):
            assert entering == dialling | {owner} or door.name == "sim", door.name
            assert (users["planner"] in entering) == (door.name in ("hint", "nav2")), door.name
            assert users["camera"] not in entering, door.name


def test_a_site_keeps_its_folders_name(repository: Path) -> None:
    """The simulator refuses a site in a folder of another name."""
    for name, command in {**by_units(), **by_compose()}.items():
        folder = command[command.index("--site") + 1]
        assert folder in ("/etc/pons/sites/home", "/etc/pons/sites/${PONS_SITE_NAME:-home}"), name
    assert "cp -r sites/home /etc/pons/sites/" in (repository / "docs" / "deploy.md").read_text()


def test_targets_start_what_is_there() -> None:
    for target in UNITS.glob("*.target"):
        for wanted in unit(target)["Unit"]["Wants"][0].split():
            assert (UNITS / wanted).is_file(), wanted
    for name in ("sim", "localization", "camera"):
        assert services()[name]["Install"]["WantedBy"] == ["pons-sim.target"]


def test_systemd_understands_the_units(tmp_path: Path) -> None:
    if shutil.which("systemd-analyze") is None:
        pytest.skip("systemd-analyze is not installed (apt: systemd)")
    for path in (*UNITS.glob("*.service"), *UNITS.glob("*.target")):
        text = path.read_text().replace("/opt/pons/.venv/bin/python", sys.executable)
        (tmp_path / path.name).write_text(text.replace("/opt/pons", "/"))
    files = sorted(map(str, tmp_path.iterdir()))
    done = subprocess.run(
        ["systemd-analyze", "verify", "--man=no", *files],
        capture_output=True,
        text=True,
        check=False,
        timeout=50,
        env={"SYSTEMD_UNIT_PATH": f"{tmp_path}:"},
    )
    ours = [line for line in done.stderr.splitlines() if "pons" in line or str(tmp_path) in line]
    assert not ours, done.stderr
