"""Choose the processes of one ``pons up``, their command lines and the order of their start."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from pons.robot_processes import address_arguments, common_arguments
from pons.settings import allowed_hosts
from pons.supervisor import Child

if TYPE_CHECKING:
    from pons.authority import IssuedCertificate
    from pons.settings import LaunchSettings
    from wire import RobotDescription


def children(
    settings: LaunchSettings,
    robot: RobotDescription,
    *,
    planner: bool = True,
    issued: IssuedCertificate | None = None,
) -> list[Child]:
    """Return the processes in the order of their start."""
    logs = settings.home / "logs"
    world = common_arguments(settings)
    canvas = settings.canvas
    common = world if canvas is None else common_arguments(replace(settings, site=canvas))
    maps = [] if canvas is None else ["--mapping"]
    domain = ["--domain", settings.domain] if settings.domain else []
    line, lidar_line = settings.home / "twin" / "drive", settings.home / "twin" / "lidar"
    has_lidar, plays_drive = not robot.lidar.is_simulated, not robot.drive.virtual and settings.twin
    at_line = ["--drive-port", str(line)] if plays_drive else []
    wanted = [("bridge", [*common, *at_line])]
    if planner:
        secured = issued.planner_arguments() if issued else []
        wanted.append(("planner", [*common, *address_arguments(settings), *secured]))
    simulated = robot.drive.virtual or settings.twin
    if simulated:
        more = ["--metal", str(settings.metal)] if settings.metal else []
        more += domain
        more += [] if settings.seed is None else ["--seed", str(settings.seed)]
        more += ["--twin", str(line)] if plays_drive else []
        own = settings.twin_firmware
        more += ["--twin-firmware", str(own)] if plays_drive and own else []
        more += ["--lidar-twin", str(lidar_line)] if has_lidar else []
        wanted = [("sim", [*world, *more]), ("localization", [*common, *maps]), *wanted]
    elif has_lidar:
        wanted = [("localization", [*common, *maps]), *wanted]
    found = [
        Child(name, [name, *more], logs / f"{name}.log", knows_tokens=name == "planner")
        for name, more in wanted
    ]
    if has_lidar:
        arguments = ["sensors.lidar", *common]
        arguments += ["--port", str(lidar_line)] if settings.twin else []
        found.insert(int(simulated), Child("lidar", arguments, logs / "lidar.log"))
    for child in found:
        if child.name == "planner" and issued:
            child.environment |= issued.planner_environment(allowed_hosts())
    if simulated and robot.camera.kind == "sim":
        arguments = ["sim.camera", *world, *domain]
        found.append(Child("camera", arguments, logs / "camera.log", waits_for_ready=True))
    return found
