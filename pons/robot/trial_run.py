"""Try one robot of metal, whoever the person is: open its lines, run the engine, write the record.

Knows robot.toml and the ports; not whether a terminal or a page asks.
"""

from __future__ import annotations

import secrets
import time
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING, Final

from bridge.drive import open_serial_drive, require_brakes
from devices import PORT_CURES, LastingPort, PortTrouble
from pons.calibrate.robot_toml import replace
from pons.robot.gyro_trial import BaseGyroSource, I2cGyroSource, try_gyro
from pons.robot.lidar_trial import try_lidar
from pons.robot.port_finder import CHATTER_BYTES, name_speaker
from pons.robot.presets import is_shipped
from pons.robot.trial_parties import TrialRefusal
from pons.robot.wheel_trial import WheelTrial
from sensors.lidar.kinds import kind_of
from sensors.lidar.reader import LidarReader
from wire import ConfigError, load_robot
from wire.ros2_config import ROS2
from wire.trial_record import TrialRecord, wiring_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from bridge.drive import SerialDrive
    from pons.robot.trial_parties import TrialPace, TrialPerson
    from pons.robot.wheel_trial import WheelFindings
    from sensors.camera.shot import CameraShot
    from wire import RobotDescription, Scan

TICK_S = 0.01
SCANS_WITHIN_S = 6.0
"""An RPLidar begins to turn when it is opened."""
PICTURES_WITHIN_S = 10.0
"""Five of them; a network camera waits for its next whole picture."""
MEASURED: Final = ("wheel_radius_m", "wheel_separation_m", "radius_m")
"""Of [base]; a base of metal has none of them by default."""
WHEEL_STEPS: Final = (
    "wheels_up", "listen", "hand_left", "hand_right", "power_left", "power_right",
    "power_back", "silence",
)  # fmt: skip
GYRO_STEPS: Final = ("gyro_left",)
ENDED_BY_PERSON: Final = frozenset({"trial_stopped", "trial_unwatched"})
LIDAR_STEPS: Final = ("lidar_clear", "lidar_front", "lidar_left")
CAMERA_STEPS: Final = ("camera_clear", "camera_left", "camera_cover")


@dataclass(frozen=True, slots=True)
class TrialResult:
    """Hold what a trial proved and where it stands written."""

    record: TrialRecord
    kept: Path
    """The robot.toml before."""


def plan_steps(robot: RobotDescription) -> tuple[str, ...]:
    """Return the steps that a trial of this robot has, in order."""
    gyro = GYRO_STEPS if has_gyro(robot) else ()
    lidar = () if robot.lidar.is_simulated else LIDAR_STEPS
    camera = CAMERA_STEPS if robot.camera.is_real else ()
    return (*WHEEL_STEPS, *gyro, *lidar, *camera, "write")


def has_gyro(robot: RobotDescription) -> bool:
    """Return whether robot.toml counts on a gyro: the base's own, or a chip on I2C."""
    return robot.inputs.imu and robot.has_gyro


def load_triable(path: Path) -> RobotDescription:
    """Return the robot of a robot.toml that a trial may turn and may write to.

    Raises:
        TrialRefusal: ``trial_shipped``, ``trial_virtual`` or ``trial_ros2``.
        ConfigError: robot.toml can't be used.
    """
    if is_shipped(path):
        raise TrialRefusal("trial_shipped", f"pons robot new NAME --from {path.stem}")
    robot = load_robot(path)
    if robot.drive.virtual:
        stated = "is" if "kind" in robot.drive.model_fields_set else "is left out, and so"
        raise TrialRefusal("trial_virtual", f"{path}: drive.kind {stated} 'sim'")
    if robot.drive.kind == ROS2:
        raise TrialRefusal("trial_ros2")
    return robot


def require_base(path: Path, robot: RobotDescription) -> None:
    """Hold that robot.toml states what distances and brakes hang on; a file may have lost it.

    Raises:
        TrialRefusal: ``trial_base``.
    """
    lacks = [f"base.{key}" for key in MEASURED if key not in robot.base.model_fields_set]
    if lacks:
        raise TrialRefusal("trial_base", f"{path} lacks {', '.join(lacks)}")


def refusal_of(trouble: Exception) -> TrialRefusal:
    """Return an error of robot.toml or of a port as the trial tells it, with its cure's code."""
    if isinstance(trouble, ConfigError) and trouble.code in PORT_CURES:
        cure = PORT_CURES[trouble.code][0]  # stands beside it, in both languages
        return TrialRefusal(trouble.code, trouble.detail.removesuffix(f"; {cure}"))
    return TrialRefusal("trial_config", " ".join(str(trouble).split()))


def try_robot(path: Path, robot: RobotDescription, person: TrialPerson) -> TrialResult:
    """Try wheels, gyro, lidar and camera, and write ``[trial]``.

    However it ends, the wheels are told to stand.

    Raises:
        TrialRefusal: something must be mended first, or the person ended it.
        ConfigError: a port can't be used, or the new robot.toml would be refused.
        CalibrationRefusal, OSError: robot.toml was changed meanwhile, or can't be written.
    """
    require_base(path, robot)
    before = path.read_text("utf-8")
    found, turned_rad = _try_base(robot, person)
    seen = f"{found.dead_man_s:.2f} s ({found.brake_s:.2f} s)"
    if turned_rad is not None:
        seen = f"{degrees(turned_rad):+.0f}°"
    if not robot.lidar.is_simulated:
        seen = _try_lidar(robot, person, seen)
    if robot.camera.is_real:
        seen = watch_camera(robot, person, seen)
    person.tell("write", seen)
    return _write(path, before, robot, found, gyro=turned_rad is not None)


def wait_for(person: TrialPerson, code: str) -> None:
    """Ask for something to be done, and return when it is."""
    person.ask(code)
    while not person.has_answered():
        person.require_watch()
        time.sleep(TICK_S)


def set_trial(text: str, record: TrialRecord) -> str:
    """Return robot.toml's text with this trial in place of the one that it had."""
    kept: list[str] = []
    within = False
    for line in text.splitlines():
        if line.strip().startswith("["):
            within = line.split("#")[0].strip() == "[trial]"
        if not within:
            kept.append(line)
    while kept and not kept[-1].strip():
        kept.pop()
    return "\n".join([*kept, "", *record_lines(record)]) + "\n"


def record_lines(record: TrialRecord) -> list[str]:
    """Return a trial as robot.toml has it."""
    values = [f"{key} = {_toml_of(value)}" for key, value in record.model_dump().items()]
    return ["[trial]", "# written by pons robot try", *values]


def _toml_of(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else repr(value)


class _WallPace:
    """Let real time pass, a tick of 10 ms at once."""

    def __init__(self) -> None:
        self._next_s = time.monotonic()

    def now_s(self) -> float:
        return time.monotonic()

    def wait(self) -> None:
        now_s = time.monotonic()
        self._next_s = max(self._next_s + TICK_S, now_s)
        time.sleep(max(0.0, self._next_s - now_s))


def _try_base(robot: RobotDescription, person: TrialPerson) -> tuple[WheelFindings, float | None]:
    """Try the wheels and, where there is one, the gyro: by how much it turned [rad]."""
    boot = secrets.token_hex(6)
    drive = open_serial_drive(robot, boot, for_trial=True)
    try:
        require_brakes(drive)
        return try_base(drive, robot, _WallPace(), person, boot)
    finally:
        drive.close()


def try_base(
    drive: SerialDrive, robot: RobotDescription, pace: TrialPace, person: TrialPerson, boot: str
) -> tuple[WheelFindings, float | None]:
    """Try a base whose port is open; the wheels are told to stand however this ends.

    Raises:
        TrialRefusal: ``trial_port`` before all else that a lost port may look like.
    """
    _require_port(drive)
    opened = drive.times_opened
    try:
        found = WheelTrial(drive, robot, pace, person, boot).run()
        if not has_gyro(robot):
            return found, None
        person.tell("gyro_left", f"{found.dead_man_s:.2f} s ({found.brake_s:.2f} s)")
        gyro = I2cGyroSource(robot) if robot.imu.is_on_i2c else BaseGyroSource(drive)
        with closing(gyro):
            turned_rad = try_gyro(robot.imu, gyro, pace, person)
        _require_port(drive, opened)
    except TrialRefusal as refusal:
        if refusal.code not in ENDED_BY_PERSON:
            _require_port(drive, opened)  # it went meanwhile: that is the better word
        if refusal.code == "trial_silent":
            raise _explain_silence(drive, refusal) from None
        raise
    return found, turned_rad


def _explain_silence(drive: SerialDrive, refusal: TrialRefusal) -> TrialRefusal:
    """Return why no state came: nothing speaks there, or something that can't be driven."""
    if drive.base_trouble is not None:
        return TrialRefusal(drive.base_trouble, refusal.detail)
    if len(drive.unread) < CHATTER_BYTES:
        return refusal
    speaker = name_speaker(drive.unread) or f"bytes of no base of kind {drive.kind!r}"
    return TrialRefusal("trial_other", f"{speaker}; {refusal.detail}")


def _require_port(drive: SerialDrive, opened: int | None = None) -> None:
    """Hold that the base's port is open, and was throughout: a bridge may wait for a cable.

    Raises:
        TrialRefusal: ``trial_port``.
    """
    trouble = drive.trouble
    if trouble is not None:
        raise TrialRefusal("trial_port", f"{trouble.code}: {trouble.detail}")
    if opened is not None and drive.times_opened != opened:
        raise TrialRefusal("trial_port", "port_gone: it was unplugged meanwhile, and is back")


def _try_lidar(robot: RobotDescription, person: TrialPerson, seen: str) -> str:
    """Return where the lidar saw what was held up."""
    kind = kind_of(robot.lidar)
    path = Path(robot.lidar.port or "")
    try:
        port = LastingPort(path, kind.baud, dtr=kind.dtr)
    except PortTrouble as trouble:
        raise ConfigError(trouble.code, f"lidar.port {trouble.detail}") from None
    reader = LidarReader(kind, port, str(path), "trial")

    def look() -> Scan:
        return _newest_scan(reader, person)

    try:
        where = try_lidar(robot.lidar, look, _asking(person, seen))
    finally:
        reader.close()
        port.close()
    return f"{degrees(where['front']):+.0f}°, {degrees(where['left']):+.0f}°"


def watch_camera(robot: RobotDescription, person: TrialPerson, seen: str) -> str:
    """Try the camera of robot.toml; return what was seen of it.

    Raises:
        TrialRefusal: see :func:`pons.robot.camera_trial.try_camera`, and ``camera_unread``.
    """
    from pons.robot.camera_trial import LOOKS, try_camera  # OpenCV: not for who has no camera
    from sensors.camera.grabber import CameraGrabber
    from sensors.camera.health import STARTING, CameraHealth
    from sensors.camera.source import open_source

    grabber = CameraGrabber(partial(open_source, robot.camera, robot.ros2))
    health = CameraHealth(robot.camera)

    def look() -> list[CameraShot]:
        began_s = time.monotonic()
        shots: list[CameraShot] = []
        while len(shots) < LOOKS:
            person.require_watch()
            time.sleep(TICK_S)
            now_s = time.monotonic()
            newest, trouble = grabber.take(), health.judge(grabber, now_s)
            if newest is not None and newest.at_s > began_s:
                shots.append(newest.shot)
            if trouble is not None and trouble.code not in (STARTING, "camera_slow"):
                raise TrialRefusal("camera_unread", f"{trouble.code}: {trouble.detail}")
            if now_s - began_s > PICTURES_WITHIN_S:
                slow = f"{len(shots)} pictures in {PICTURES_WITHIN_S:g} s"
                raise TrialRefusal("camera_unread", slow)
        return shots

    try:
        return try_camera(robot.camera, look, _asking(person, seen))
    finally:
        grabber.close()


def _asking(person: TrialPerson, seen: str) -> Callable[[str], None]:
    """Return how a part of the trial asks; its first step tells what the part before saw."""
    said = [seen]

    def ask(code: str) -> None:
        person.tell(code, said.pop() if said else "")
        wait_for(person, code)

    return ask


def _newest_scan(reader: LidarReader, person: TrialPerson) -> Scan:
    """Return a scan that began after now; what waited in the port is of another time."""
    began_s = time.monotonic()
    while time.monotonic() - began_s < SCANS_WITHIN_S:
        person.require_watch()
        time.sleep(TICK_S / 2)
        now_s = time.monotonic()
        fresh = [scan for scan in reader.turn(now_s) if scan.stamp_s > began_s]
        if fresh:
            return fresh[-1]
    verdict = reader.judge(time.monotonic())
    said = f"{verdict.code}: {verdict.detail}" if verdict else ""
    raise TrialRefusal("lidar_silent", said or f"none within {SCANS_WITHIN_S:g} s")


def _write(
    path: Path, before: str, robot: RobotDescription, found: WheelFindings, *, gyro: bool
) -> TrialResult:
    record = TrialRecord(
        date=time.strftime("%Y-%m-%d", time.gmtime()),
        wiring=wiring_of(robot),
        dead_man_s=round(found.dead_man_s, 3),
        brake_s=round(found.brake_s, 3),
        gyro=gyro,
        camera=robot.camera.is_real,
    )
    stamp = time.strftime("%Y%m%dT%H%M%SZ", time.gmtime())
    return TrialResult(record, replace(path, before, set_trial(before, record), stamp))
