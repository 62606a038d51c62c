"""Try a robot of metal with its wheels off the ground, and write what was proved into robot.toml.

``pons robot try``. Takes the base's own port, so nothing else may drive it meanwhile; the motors
turn slowly, for about half a minute in all, and stop when this program does.
"""

from __future__ import annotations

import secrets
import select
import sys
import time
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from bridge.drive import open_serial_drive, require_brakes
from devices import LastingPort, PortTrouble
from pons.calibrate.robot_toml import replace
from pons.robot.gyro_trial import try_gyro
from pons.robot.lidar_trial import try_lidar
from pons.robot.trial_words import PROMPTS, REFUSALS
from pons.robot.wheel_trial import TrialRefusal, WheelTrial
from pons_assets import IS_INSTALLED, ROBOT_FILE
from sensors.imu.bus import SmBus
from sensors.imu.reader import ImuReader
from sensors.lidar.kinds import kind_of
from sensors.lidar.reader import LidarReader
from wire import ConfigError, load_robot
from wire.ros2_config import ROS2
from wire.trial_record import TrialRecord, wiring_of

if TYPE_CHECKING:
    from bridge.drive import SerialDrive
    from pons.robot.gyro_trial import GyroSource, Timed
    from pons.robot.wheel_trial import WheelFindings
    from pons.settings import LaunchSettings
    from wire import RobotDescription, Scan

EXIT_PROVED, EXIT_REFUSED, EXIT_INTERRUPTED = 0, 3, 130
LIFTED = "UP"
TICK_S = 0.01
SCANS_WITHIN_S = 6.0
"""An RPLidar begins to turn when it is opened."""


def run_trial(settings: LaunchSettings) -> int:
    """Try the robot; 0 proved and written, 3 refused, 130 interrupted."""
    try:
        if IS_INSTALLED and settings.robot == ROBOT_FILE:
            raise TrialRefusal("trial_shipped", f"cp {ROBOT_FILE} robot.toml")
        robot = load_robot(settings.robot)
        if robot.drive.virtual:
            raise TrialRefusal("trial_virtual")
        if robot.drive.kind == ROS2:
            raise TrialRefusal("trial_ros2")
        before = settings.robot.read_text("utf-8")
        person = TerminalPerson()
        person.ask_and_wait("wheels_up")
        if person.answer.strip() != LIFTED:
            raise TrialRefusal("not_lifted")
        found, turned_rad = _try_base(robot, person)
        print(
            f"wheels: {found.report_hz:.0f} states a second; without a command they stand after "
            f"{found.dead_man_s:.2f} s, {found.brake_s:.2f} s of it braking",
            flush=True,
        )
        if turned_rad is not None:
            print(f"gyro: turned left by {turned_rad:.2f} rad", flush=True)
        if not robot.lidar.is_simulated:
            _try_lidar(robot, person)
        _write(settings.robot, before, robot, found, gyro=turned_rad is not None)
    except TrialRefusal as refused:
        print("\n".join(refusal_lines(refused)), file=sys.stderr)
        return EXIT_REFUSED
    except (ConfigError, OSError) as trouble:
        print(f"{trouble}\nnothing was written", file=sys.stderr)
        return EXIT_REFUSED
    except KeyboardInterrupt:
        print("interrupted / 已中断: the wheels stand, nothing was written", file=sys.stderr)
        return EXIT_INTERRUPTED
    return EXIT_PROVED


def refusal_lines(refused: TrialRefusal) -> list[str]:
    """Return what a person is told of a refusal: code, what came, and the cure in two languages."""
    english, chinese = REFUSALS[refused.code]
    detail = f" ({refused.detail})" if refused.detail else ""
    return [f"{refused.code}{detail}", f"  {english}", f"  {chinese}", "nothing was written"]


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
    values = [f"{key} = {_toml_of(value)}" for key, value in record.model_dump().items()]
    return "\n".join([*kept, "", "[trial]", "# written by pons robot try", *values]) + "\n"


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


class TerminalPerson:
    """Ask at the terminal; Enter is the answer."""

    def __init__(self) -> None:
        self.answer = ""

    def ask(self, code: str) -> None:
        """Print what is asked for."""
        english, chinese = PROMPTS[code]
        print(f"\n{english}\n{chinese} … ", end="", flush=True)

    def has_answered(self) -> bool:
        """Tell whether Enter was pressed; an end of input is an interrupt: nobody watches."""
        if not select.select([sys.stdin], [], [], 0.0)[0]:
            return False
        self.answer = sys.stdin.readline()
        if not self.answer:
            raise KeyboardInterrupt
        return True

    def ask_and_wait(self, code: str) -> None:
        """Ask, and return when it is done."""
        self.ask(code)
        while not self.has_answered():
            time.sleep(TICK_S)


class BaseGyroSource:
    """Be the gyro of a base that says nothing of itself unless it is asked."""

    def __init__(self, drive: SerialDrive) -> None:
        self._drive = drive

    def readings(self) -> list[Timed]:
        """Ask and read; no command goes with it."""
        gyro = self._drive.gyro
        if gyro is None:
            return []
        self._drive.ask()
        self._drive.read()
        heard = list(gyro.heard)
        gyro.heard.clear()
        return heard


class I2cGyroSource:
    """Be a chip on an I2C bus, read as its process reads it."""

    def __init__(self, robot: RobotDescription) -> None:
        bus = robot.imu.bus or 0
        self._reader = ImuReader(robot.imu, partial(SmBus, bus), "trial", time.monotonic())

    def readings(self) -> list[Timed]:
        """Read once.

        Raises:
            ConfigError: the chip can't be read.
        """
        now_s = time.monotonic()
        self._reader.turn(now_s)
        trouble = self._reader.judge(now_s)
        if trouble is not None and trouble.code not in {"imu_starting", "imu_unsettled"}:
            raise ConfigError(trouble.code, trouble.detail)
        return [] if self._reader.reading is None else [self._reader.reading]


def _try_base(
    robot: RobotDescription, person: TerminalPerson
) -> tuple[WheelFindings, float | None]:
    """Try wheels and, where robot.toml counts on it, the base's own gyro."""
    boot = secrets.token_hex(6)
    drive = open_serial_drive(robot, boot, for_trial=True)
    try:
        require_brakes(drive)
        found = WheelTrial(drive, robot, _WallPace(), person, boot).run()
        if not robot.inputs.imu:
            return found, None
        source: GyroSource = BaseGyroSource(drive)
        if robot.imu.is_on_i2c:
            source = I2cGyroSource(robot)
        return found, try_gyro(robot.imu, source, _WallPace(), person)
    finally:
        drive.close()


def _try_lidar(robot: RobotDescription, person: TerminalPerson) -> None:
    kind = kind_of(robot.lidar)
    path = Path(robot.lidar.port or "")
    try:
        port = LastingPort(path, kind.baud, dtr=kind.dtr)
    except PortTrouble as trouble:
        raise ConfigError(trouble.code, f"lidar.port {trouble.detail}") from None
    reader = LidarReader(kind, port, str(path), "trial")

    def look() -> Scan:
        return _newest_scan(reader)

    try:
        seen = try_lidar(robot.lidar, look, person.ask_and_wait)
        print(f"lidar: front at {seen['front']:+.2f} rad, left at {seen['left']:+.2f}", flush=True)
    finally:
        reader.close()
        port.close()


def _newest_scan(reader: LidarReader) -> Scan:
    """Return a scan that began after now; what waited in the port is of another time."""
    began_s = time.monotonic()
    while time.monotonic() - began_s < SCANS_WITHIN_S:
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
) -> None:
    record = TrialRecord(
        date=time.strftime("%Y-%m-%d", time.gmtime()),
        wiring=wiring_of(robot),
        dead_man_s=round(found.dead_man_s, 3),
        brake_s=round(found.brake_s, 3),
        gyro=gyro,
    )
    stamp = time.strftime("%Y%m%dT%H%M%SZ", time.gmtime())
    kept = replace(path, before, set_trial(before, record), stamp)
    print(f"proved; wrote [trial] into {path}, the old one is {kept.name}", flush=True)
