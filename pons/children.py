"""Choose the processes of one ``pons up``, their command lines and the order of their start."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from pons import mqtt
from pons.launch_checks import CannotStart
from pons.robot_processes import address_arguments, common_arguments, free_port
from pons.settings import allowed_hosts
from pons.supervisor import Child
from pons_assets import ROBOT_FILE

if TYPE_CHECKING:
    from pons.authority import IssuedCertificate
    from pons.settings import LaunchSettings
    from wire import RobotDescription


def can_set_up(settings: LaunchSettings, robot: RobotDescription) -> bool:
    """Tell whether this robot can be tried from the page: metal at a serial line, and no twin."""
    return not (robot.drive.virtual or robot.ros2 is not None or settings.twin)


def must_set_up(settings: LaunchSettings, robot: RobotDescription) -> bool:
    """Tell whether a bridge would refuse this robot's line: metal that was not tried.

    Whose far end is a program, a twin's or a test's, may be driven without.
    """
    if not can_set_up(settings, robot) or robot.valid_trial is not None:
        return False
    return not Path(robot.drive.port or "").resolve().is_relative_to("/dev/pts")


def begins_in_set_up(settings: LaunchSettings, robot: RobotDescription) -> bool:
    """Tell whether to begin in set-up.

    Raises:
        CannotStart: it is asked for, and this robot has none.
    """
    if settings.set_up and not can_set_up(settings, robot):
        raise CannotStart(
            "setup_needless: set-up tries a base of metal at a serial line; this robot is "
            f"simulated, a twin's or one of ROS 2 (drive.kind {robot.drive.kind!r})"
        )
    return settings.set_up or must_set_up(settings, robot)


def may_take_robot(settings: LaunchSettings) -> bool:
    """Tell whether a robot.toml that the page writes is taken up: where the demo robot stands in.

    A robot that somebody named (PONS_ROBOT, --robot) stays what runs.
    """
    plain = settings.metal is None and settings.domain is None and settings.mapping is None
    return settings.robot == ROBOT_FILE and plain and not settings.twin


def children(
    settings: LaunchSettings,
    robot: RobotDescription,
    *,
    planner: bool = True,
    issued: IssuedCertificate | None = None,
) -> list[Child]:
    """Return the processes in the order of their start."""
    logs, canvas = settings.home / "logs", settings.canvas
    world = common_arguments(replace(settings, site=settings.world or settings.site))
    common = common_arguments(replace(settings, site=canvas or settings.site))
    maps = [] if canvas is None else ["--mapping"]
    domain = ["--domain", settings.domain] if settings.domain else []
    line, lidar_line = settings.home / "twin" / "drive", settings.home / "twin" / "lidar"
    has_ros2, has_lidar = robot.ros2 is not None, robot.lidar.has_line
    plays_drive = not robot.drive.virtual and settings.twin and not has_ros2
    ros2_port = str(free_port()) if has_ros2 and settings.twin else None
    at_line = ["--drive-port", str(line)] if plays_drive else []
    wanted = [("bridge", [*common, *at_line])]
    if planner:
        more = ["--may-set-up"] if can_set_up(settings, robot) else []
        more += ["--may-take-robot"] if may_take_robot(settings) else []
        wanted.append(("planner", [*_planner(settings, common, issued), "--may-map", *more]))
    simulated = robot.drive.virtual or settings.twin
    if simulated:
        more = _simulator(settings)
        more += _drive_twin(settings, line) if plays_drive else []
        more += ["--lidar-twin", str(lidar_line)] if has_lidar else []
        more += ["--ros2-twin", ros2_port] if ros2_port else []
        wanted = [("sim", [*world, *more]), ("localization", [*common, *maps]), *wanted]
    elif has_lidar or has_ros2:
        wanted = [("localization", [*common, *maps]), *wanted]
    found = [
        Child(
            name,
            [name, *more],
            logs / f"{name}.log",
            knows_tokens=name == "planner",
            is_watched=name == "planner",
        )
        for name, more in wanted
    ]
    if has_lidar:
        arguments = ["sensors.lidar", *common]
        arguments += ["--port", str(lidar_line)] if settings.twin else []
        found.insert(int(simulated), Child("lidar", arguments, logs / "lidar.log"))
    if has_ros2:
        found.insert(int(simulated), _ros2(common, ros2_port, logs))
    _secure(found, issued)
    if planner and mqtt.is_wanted(settings.home):
        found.append(_mqtt(settings, common, logs))
    if not simulated and robot.inputs.imu and robot.imu.is_on_i2c:
        found.insert(0, Child("imu", ["sensors.imu", *common], logs / "imu.log"))
    seen = ["sim.camera", *world, *domain] if simulated else ["sensors.camera", *common]
    if robot.camera.is_real or (simulated and robot.camera.kind == "sim"):
        found.append(Child("camera", seen, logs / "camera.log", waits_for_ready=True))
    return found


def set_up_children(settings: LaunchSettings, issued: IssuedCertificate | None) -> list[Child]:
    """Return the processes of a robot in set-up: no bridge, and nobody else at its lines."""
    logs, common = settings.home / "logs", common_arguments(settings)
    planner = ["planner", *_planner(settings, common, issued)]
    found = [
        Child("setup", ["pons.robot.setup_node", *common], logs / "setup.log"),
        Child("planner", planner, logs / "planner.log", knows_tokens=True, is_watched=True),
    ]
    _secure(found, issued)
    return found


def _planner(
    settings: LaunchSettings, common: list[str], issued: IssuedCertificate | None
) -> list[str]:
    secured = issued.planner_arguments() if issued else []
    return [*common, *address_arguments(settings), *secured]


def _secure(found: list[Child], issued: IssuedCertificate | None) -> None:
    for child in found:
        if child.name == "planner" and issued:
            child.environment |= issued.planner_environment(allowed_hosts())


def _simulator(settings: LaunchSettings) -> list[str]:
    """Return what says how the simulated robot differs from the described one."""
    said = ["--metal", str(settings.metal)] if settings.metal else []
    said += ["--domain", settings.domain] if settings.domain else []
    return said if settings.seed is None else [*said, "--seed", str(settings.seed)]


def _drive_twin(settings: LaunchSettings, line: Path) -> list[str]:
    """Return what has the simulator play a base at a line."""
    own = settings.twin_firmware
    return ["--twin", str(line), *(["--twin-firmware", str(own)] if own else [])]


def _mqtt(settings: LaunchSettings, common: list[str], logs: Path) -> Child:
    """Return the process that joins a smart home: a client, for which nothing waits."""
    tls = ["--tls"] if settings.tls else []
    arguments = ["pons.mqtt", *common, *address_arguments(settings), *tls]
    return Child("mqtt", arguments, logs / "mqtt.log", waits_for_ready=True)


def _ros2(common: list[str], port: str | None, logs: Path) -> Child:
    """Return the process that speaks to a ROS 2 base, at its twin's port where that plays it."""
    at_port = ["--port", port] if port else []
    return Child("ros2", ["ros2", *common, *at_port], logs / "ros2.log")
