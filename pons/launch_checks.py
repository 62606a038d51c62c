"""Look, before anything starts, for causes of a later and less clear failure of ``pons up``."""

from __future__ import annotations

import contextlib
import shutil
import socket
from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.operator_key import FILE as KEY_FILE
from pons.key import run as make_key
from pons.launch_words import PAIR
from pons.settings import robot_of
from pons.terminal import pick, speaks_chinese
from pons_assets import DEFAULT_SITE
from wire import ConfigError, load_robot

if TYPE_CHECKING:
    from pons.settings import LaunchSettings
    from wire import RobotDescription

MIN_FREE_BYTES = 200 * 1024 * 1024


class CannotStart(Exception):
    """Something outside must change first; nothing was left running."""

    def __init__(self, text: str, chinese: str = "") -> None:
        """Keep the sentence, and the same in Chinese where there is one."""
        super().__init__(text)
        self.chinese = chinese


class ChildRefusal(CannotStart):
    """A process that was started ended, because a setting or a file is wrong."""

    def __init__(self, text: str, *, is_late: bool = False) -> None:
        """Keep whether the robot had been ready before."""
        super().__init__(text)
        self.is_late = is_late


def check(settings: LaunchSettings) -> RobotDescription:
    """Look for causes of a later and less clear failure.

    Raises:
        CannotStart: a file is missing or wrong, or the disk is full.
    """
    try:
        robot = load_robot(settings.robot)
    except ConfigError as wrong:
        raise CannotStart(str(wrong)) from None
    if not (settings.site / "map.yaml").is_file():
        from pons.site import site_missing  # brings numpy: for who is refused alone

        refused = site_missing(str(settings.site), settings.home)
        raise CannotStart(str(refused), refused.message["zh"])
    if settings.mapping is not None:
        from pons.mapping import prepare_canvas

        prepare_canvas(settings, settings.mapping, robot)
    real = not robot.lidar.is_simulated or robot.camera.is_real
    if settings.twin and robot.drive.virtual and not real:
        raise CannotStart(
            "twin_needless: drive.kind and lidar.kind 'sim' are simulated as they are; --twin "
            "plays a base, a lidar or a camera of metal"
        )
    if robot.drive.virtual and not robot.lidar.is_simulated and not settings.twin:
        raise CannotStart(
            f"lidar_of_another_world: lidar.kind {robot.lidar.kind!r} sees real walls, drive.kind "
            "'sim' drives among simulated ones; add --twin, or make both real"
        )
    if robot.drive.virtual and robot.camera.is_real and not settings.twin:
        raise CannotStart(
            f"camera_of_another_world: camera.kind {robot.camera.kind!r} sees a real room, "
            "drive.kind 'sim' drives in a simulated one; add --twin, or make both real"
        )
    try:
        (settings.home / "logs").mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CannotStart(
            f"home_unwritable: {settings.home}: {error.strerror}; "
            "set PONS_HOME to a folder that you may write"
        ) from None
    free = shutil.disk_usage(settings.home).free
    if not free >= MIN_FREE_BYTES:
        raise CannotStart(f"disk_full: {settings.home} has {free} bytes, needs {MIN_FREE_BYTES}")
    return robot


def take_robot(settings: LaunchSettings) -> tuple[LaunchSettings, RobotDescription]:
    """Return what runs from now on: the robot that the page's wizard has written.

    Metal needs an operator's key; nobody may be at the terminal to be asked for it.

    Raises:
        CannotStart: something is wrong with it.
    """
    taken = replace(settings, robot=robot_of("", settings.home))
    robot = check(taken)
    if not robot.drive.virtual and not (taken.home / KEY_FILE).exists():
        make_key(taken)
        print(f"pons: {pick(*PAIR)}", flush=True)
    return taken, robot


def change_map(settings: LaunchSettings) -> tuple[LaunchSettings, RobotDescription]:
    """Return what runs from now on: a map of this home that grows, or the site made of it.

    Raises:
        CannotStart, ConfigError: something is wrong with it.
    """
    changed = replace(settings, mapping=DEFAULT_SITE.name, set_up=False)
    if settings.mapping is not None:
        site = settings.home / "sites" / settings.mapping
        changed = replace(changed, mapping=None, site=site)
    robot = check(changed)
    if robot.localization.kind == "scans":  # a stand-in knows the simulator's own places alone
        changed = replace(changed, world=settings.world or settings.site)
    return changed, robot


def in_chinese(why: Exception) -> str:
    """Return the line below a refusal where the person reads Chinese; empty where there is none."""
    if not speaks_chinese():
        return ""
    if isinstance(why, CannotStart):
        return f"\n{why.chinese}" if why.chinese else ""
    from maps.errors import SiteError  # brings YAML: for who is refused alone

    return f"\n{why.message['zh']}" if isinstance(why, SiteError) else ""


def site_flaw(settings: LaunchSettings, told: str, *, planner: bool) -> str:
    """Return lines that say what is wrong with the site; empty where it loads.

    Each process that reads it refuses by itself, and which one does first is chance.

    Args:
        settings: of the launch.
        told: what that process said, which is not said again.
        planner: whether places matter, which the planner alone reads.
    """
    from planner.site import Site, SiteError, load_map

    if settings.mapping is not None:
        return ""
    try:
        if planner:
            Site.load(settings.site)
        else:
            load_map(settings.site / "map.yaml")
    except SiteError as refused:
        said = f"\nthe site: {refused}" if str(refused) not in told else ""
        said = f"\n站点：{refused.message['zh']}" if speaks_chinese() else said
        return f"{said}\n{pick('check it', '检查站点')}: pons site check {settings.site}"
    return ""


def check_port(settings: LaunchSettings) -> None:
    """Hold that the planner's port is free.

    Raises:
        CannotStart: something listens there.
    """
    with contextlib.closing(socket.socket()) as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((settings.host, settings.port))
        except OSError as error:
            raise CannotStart(
                f"port_in_use: {settings.host}:{settings.port}: {error.strerror}; stop what "
                "listens there or set PONS_PORT"
            ) from None
