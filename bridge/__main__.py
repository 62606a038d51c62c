"""Start the bridge: ``python -m bridge --home DIR --robot robot.toml --site sites/home``.

Chooses the concrete classes and the order of the real-time recipe; decides nothing about driving.
Exit status: 0 left when asked, 1 its home can't be written at present, 2 refused to start, 3 to be
started anew with the fence that an operator put in force, 70 the loop broke.
"""

from __future__ import annotations

import argparse
import logging
import os
import secrets
import signal
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from bridge.braking_file import BrakingKeeper, load_learnt, path_of
from bridge.core import CoreConfig
from bridge.drive import Ros2Drive, SimDrive, open_serial_drive, require_brakes
from bridge.fence_file import load_fence
from bridge.fence_update import FenceDesk, Ground
from bridge.link import BridgeLink
from bridge.marks_update import MarksDesk, Paper, load_marks, marks_path
from bridge.node import EXIT_LEFT, BridgeNode, Parts
from bridge.operator_key import load_operator_key
from bridge.realtime import (
    MonotonicClock,
    Pacer,
    Right,
    SlackCollector,
    all_granted,
    lock_memory,
    pin,
    take_fifo,
    transport_fifo,
)
from bridge.recording.recorder import Recorder
from bridge.warmup import warm_up
from processes.log_lines import begin_log
from processes.service import Service
from wire import ConfigError, RobotDescription, load_robot
from wire.keys import Party
from wire.ros2_config import ROS2
from wire.session import open_session
from wire.site_map import read_map_id

if TYPE_CHECKING:
    from bridge.drive import Drive
    from wire.robot import RealTime
    from wire.session import Session

log = logging.getLogger("bridge")

EXIT_AGAIN = 3


def main(arguments: list[str] | None = None) -> int:
    """Return the exit status."""
    begin_log()
    options = _options(arguments)
    try:
        return _serve(options)
    except ConfigError as error:
        print(f"bridge: {error}", file=sys.stderr)
        return error.exit_status


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m bridge", description=__doc__)
    parser.add_argument(
        "--site", type=Path, required=True, help="folder with fence.json and map.yaml"
    )
    parser.add_argument(
        "--robot", type=Path, help="robot.toml (default: the built-in robot, said in the log)"
    )
    parser.add_argument("--home", type=Path, help="$PONS_HOME (default: ./.pons)")
    parser.add_argument(
        "--drive-port", type=Path, help="in place of robot.toml's drive.port: a twin's line"
    )
    return parser.parse_args(arguments)


def _serve(options: argparse.Namespace) -> int:
    asked = (
        _LeaveRequest()
    )  # first: a signal during the slow part of the start must end it cleanly too
    robot = _robot(options.robot)
    home = options.home or Path(os.environ.get("PONS_HOME") or ".pons")
    config = _config(robot, options.site, home)
    key = load_operator_key(home, virtual=robot.drive.virtual)
    with transport_fifo(robot.realtime.priority) as carried:
        opened = open_session(Party.BRIDGE, robot.id, home)
    with opened as session:
        drive = _drive(session, robot, config.boot, options.drive_port)
        link = BridgeLink(session, robot.id, key)
        recorder = Recorder(home.absolute() / "recordings", config)
        keeper = BrakingKeeper(path_of(home, robot), robot, config.learnt)
        desk = FenceDesk(Ground(options.site, home, config.map_id, config.fence_hash))
        drawn = MarksDesk(Paper(marks_path(home, config.map_id), config.map_id, config.fence))
        parts = Parts(link, drive, recorder, SlackCollector(), Service(), keeper, desk, drawn)
        try:
            return _loop(config, parts, asked, carried)
        finally:
            parts.service.stopping()
            keeper.close()
            desk.close()
            drawn.close()
            recorder.close()


def _robot(path: Path | None) -> RobotDescription:
    """Load robot.toml and log which: nobody is to drive by defaults unawares."""
    log.info("robot: %s", path.absolute() if path else "the built-in default: no --robot was given")
    return load_robot(path) if path else RobotDescription()


def _config(robot: RobotDescription, site: Path, home: Path) -> CoreConfig:
    """Read the site's fence, map and learnt brakes; mint this run's name."""
    learnt, trouble = load_learnt(path_of(home, robot), robot)
    trial = robot.valid_trial
    fence, fence_hash = load_fence(site / "fence.json")
    map_id = read_map_id(site)
    marks = load_marks(marks_path(home, map_id), map_id)
    if marks:
        fence.with_marks(marks)  # prepared before the first tick
    return CoreConfig(
        robot=robot,
        robot_hash=robot.hash,
        fence=fence,
        fence_hash=fence_hash,
        map_id=map_id,  # the self test faults a fence drawn on another
        marks=marks,
        boot=secrets.token_hex(6),
        dead_man_s=trial.dead_man_s if trial else None,
        learnt=learnt,
        braking_trouble=trouble,
    )


def _drive(session: Session, robot: RobotDescription, boot: str, line: Path | None = None) -> Drive:
    if robot.drive.virtual:
        return require_brakes(SimDrive(session, boot))
    if robot.drive.kind == ROS2:
        return require_brakes(Ros2Drive(session, boot))
    return require_brakes(open_serial_drive(robot, boot, line))


def _loop(config: CoreConfig, parts: Parts, asked: _LeaveRequest, carried: Right) -> int:
    clock = MonotonicClock()
    warm_up(config, clock.now_s())
    rights = (carried, *_rights(config.robot.realtime, parts.collector))
    for right in rights:
        level = logging.INFO if right.granted else logging.WARNING
        log.log(level, "%s %s: %s", right.name, "granted" if right.granted else "refused",
                right.detail)  # fmt: skip
    log.info("run %s, %s drive, %s", config.boot, parts.drive.kind, config.robot.id)
    shell = BridgeNode(config, parts, clock.now_s(), real_time=all_granted(rights))
    parts.service.ready()
    desk = parts.desk
    status = shell.run(
        Pacer(clock, config.period_s), lambda: asked.to_leave() or desk.is_over(clock.now_s())
    )
    if status == EXIT_LEFT and not asked.to_leave():
        log.warning("fence_changed: leaving, so that the next start loads the fence put in force")
        return EXIT_AGAIN
    return status


def _rights(wanted: RealTime, collector: SlackCollector) -> tuple[Right, ...]:
    """Take real-time rights in the order that works: memory once all is touched, rank last."""
    memory = lock_memory()
    collector.freeze()
    return memory, pin(wanted.cpu), take_fifo(wanted.priority)


class _LeaveRequest:
    """Note SIGTERM and SIGINT, so that the loop ends between two ticks."""

    def __init__(self) -> None:
        self._by = 0
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, self._note)

    def to_leave(self) -> bool:
        return self._by != 0

    def _note(self, number: int, _frame: object) -> None:
        self._by = number


if __name__ == "__main__":
    sys.exit(main())
