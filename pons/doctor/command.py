"""Run every check in order, print the findings, and return the worst verdict as exit status."""

from __future__ import annotations

import json
import logging
from collections.abc import Callable
from dataclasses import asdict
from subprocess import SubprocessError
from typing import TYPE_CHECKING

from pons.doctor import (
    board_checks,
    camera_checks,
    detector_checks,
    drive_checks,
    gyro_checks,
    host_checks,
    lidar_checks,
    model_checks,
    path_checks,
    ros2_checks,
    voice_checks,
)
from pons.doctor import jitter as late
from pons.doctor.finding import BilingualWords, HealthFinding, HealthVerdict, fail, warn
from pons.terminal import paint, pick

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

EXIT = {HealthVerdict.OK: 0, HealthVerdict.WARN: 1, HealthVerdict.FAIL: 2}
"""0: all is well; 1: something works less well; 2: something must be mended first."""
NO_CYCLICTEST = (
    "cyclictest did not run beside it -> sudo apt install rt-tests; it needs the same rights",
    "cyclictest 未能同时运行 -> sudo apt install rt-tests；需要同样的权限",
)
UNREAD = (
    BilingualWords("not looked at: robot.toml can't be read", "未检查：无法读取 robot.toml"),
    BilingualWords("mend it first (line robot)", "请先修正它（见 robot 一行）"),
)
MARKS = {
    HealthVerdict.OK: ("ok  ", "green"),
    HealthVerdict.WARN: ("warn", "yellow"),
    HealthVerdict.FAIL: ("FAIL", "red"),
}


def run(settings: LaunchSettings, *, as_json: bool = False, jitter: bool = False) -> int:
    """Be ``pons doctor``."""
    logging.getLogger().addHandler(logging.NullHandler())  # its lines say what drivers would log
    found = findings(settings)
    _, robot = path_checks.robot(settings.robot)
    rows = late.measure(robot.realtime.priority) if jitter else []
    if as_json:
        content = {"findings": [asdict(one) for one in found]}
        if jitter:
            content["jitter"] = [asdict(row) for row in rows]
        print(json.dumps(content, ensure_ascii=False, indent=1))
    else:
        print("\n".join(line for one in found for line in lines(one)))
        if jitter:
            print(f"\n{late.table(rows)}")
            if len(rows) < 2:
                print(pick(*NO_CYCLICTEST))
    return max(EXIT[one.verdict] for one in found)


def findings(settings: LaunchSettings) -> list[HealthFinding]:
    """Return every check's findings, the machine first."""
    described, robot = path_checks.robot(settings.robot)
    sited, site = path_checks.site(settings.site)
    running = bool(path_checks.listening(settings.home))
    priority, virtual = robot.realtime.priority, robot.drive.virtual

    def of_robot(name: str, check: Callable[[], HealthFinding]) -> HealthFinding:
        if described.verdict is HealthVerdict.FAIL:
            return warn(name, *UNREAD)
        return run_check(name, check)

    return [
        host_checks.python(),
        host_checks.page_size(),
        run_check("real_time", lambda: host_checks.real_time(priority, virtual=virtual)),
        run_check("locked_memory", host_checks.locked_memory),
        host_checks.node(),
        run_check("power", board_checks.power),
        run_check("usb_power", board_checks.usb_power),
        run_check("heat", board_checks.heat),
        run_check("processor", board_checks.processor_clock),
        run_check("time_of_day", board_checks.time_of_day),
        run_check("modem_manager", board_checks.modem_manager),
        run_check("home", lambda: path_checks.home(settings.home)),
        run_check("secrets", lambda: path_checks.secrets(settings.home, virtual=virtual)),
        run_check("disk", lambda: path_checks.disk(settings.home)),
        run_check("sockets", lambda: path_checks.sockets(settings.home)),
        run_check("port", lambda: path_checks.port(settings, running=running)),
        described,
        of_robot("drive", lambda: drive_checks.drive(settings.home, robot)),
        of_robot("trial", lambda: drive_checks.trial(robot)),
        of_robot("gyro", lambda: gyro_checks.gyro(settings.home, robot)),
        of_robot("lidar", lambda: lidar_checks.lidar(settings.home, robot)),
        of_robot("camera", lambda: camera_checks.camera(settings.home, robot)),
        of_robot("detector", lambda: detector_checks.detector(settings.home, robot)),
        of_robot("ros2", lambda: ros2_checks.ros2(settings.home, robot)),
        sited,
        run_check("model", lambda: model_checks.model(settings.home)),
        *model_checks.tools(settings.home),
        run_check("recogniser", lambda: model_checks.recogniser(site)),
        run_check("transcription", lambda: voice_checks.transcription(settings.home)),
        run_check("speech", lambda: voice_checks.speech(settings.home)),
    ]


def run_check(name: str, check: Callable[[], HealthFinding]) -> HealthFinding:
    """Return a check's findings; one that the system itself cuts short must not hide the others."""
    try:
        return check()
    except (OSError, SubprocessError, RuntimeError) as error:
        return fail(
            name,
            BilingualWords(f"could not be checked: {error}", f"无法检查：{error}"),
            BilingualWords("run as the user that runs the robot, and mend what it names",
                  "请以运行机器人的用户执行，并修正上述问题"),
        )  # fmt: skip


def lines(one: HealthFinding) -> list[str]:
    """Return a finding for a terminal: one line, with its fix."""
    mark, colour = MARKS[one.verdict]
    fix = "" if one.fix is None else f" -> {pick(one.fix.en, one.fix.zh)}"
    return [f"{paint(mark, colour)}  {one.name:<14} {pick(one.found.en, one.found.zh)}{fix}"]
