"""Check the gyro: whose it is, whether somebody saw which way it turns, and how a chip is read."""

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING

from pons.doctor.finding import BilingualWords, HealthFinding, fail, ok, warn
from pons.doctor.running_process import hear_state
from sensors.imu.bus import ImuTrouble, SmBus
from sensors.imu.reader import CODES, ImuReader
from wire import keys
from wire.doors import IMU_COPY_DOOR
from wire.drive_config import DRIVE_KINDS
from wire.ros2_config import ROS2
from wire.sockets import Endpoints, is_listening

if TYPE_CHECKING:
    from pathlib import Path

    from wire import RobotDescription

READ_S = 3.0
PERIOD_S = 0.01


def gyro(home: Path, robot: RobotDescription) -> HealthFinding:
    """Say whose gyro counts, whether somebody has seen which way it turns, and read a chip."""
    if not robot.inputs.imu:
        return warn(
            "gyro",
            BilingualWords(
                "inputs.imu is false: at most 0.3 m/s, and slipping wheels are not seen",
                "inputs.imu 为 false：最高 0.3 m/s，且无法发现打滑",
            ),
            BilingualWords(
                "where there is one, say so (docs/sensors.md)",
                "若有陀螺仪请写明（docs/sensors.md）",
            ),
        )
    if robot.drive.virtual or robot.drive.kind == ROS2:
        return ok("gyro", "comes with the drive", "随驱动提供")
    if not robot.has_gyro:
        kinds = ", ".join(name for name, kind in DRIVE_KINDS.items() if kind.has_gyro)
        return fail(
            "gyro",
            BilingualWords(
                f"inputs.imu is true, and a base of kind {robot.drive.kind!r} brings no gyro",
                f"inputs.imu 为 true，而 {robot.drive.kind!r} 底盘没有陀螺仪",
            ),
            BilingualWords(
                f"inputs.imu = false, or an [imu] on I2C; {kinds} bring their own",
                f"设 inputs.imu = false，或配置 I2C 的 [imu]；{kinds} 自带",
            ),
        )
    if robot.imu.is_on_i2c:
        trouble = _trouble_of(home, robot)
        if trouble is not None:
            english, chinese = CODES.get(trouble.code, ("see docs/sensors.md",) * 2)
            found = BilingualWords(str(trouble), str(trouble))
            return fail("gyro", found, BilingualWords(english, chinese))
    whose = robot.imu.kind if robot.imu.is_on_i2c else "the base's own"
    valid = robot.valid_trial
    if valid is None or not valid.gyro:
        return warn(
            "gyro",
            BilingualWords(
                f"{whose}; nobody has seen which way it turns", f"{whose}：尚未确认转动方向"
            ),
            BilingualWords("pons robot try asks for it", "pons robot try 会要求确认"),
        )
    return ok("gyro", f"{whose}, tried on {valid.date}", f"{whose}，{valid.date} 已测试")


def _trouble_of(home: Path, robot: RobotDescription) -> ImuTrouble | None:
    """Return what is wrong with a chip, by its running process or by reading it for a while."""
    if is_listening(Endpoints(home).socket(IMU_COPY_DOOR)):
        return _hear_process(home, robot)
    reader = ImuReader(robot.imu, partial(SmBus, robot.imu.bus or 0), "doctor", time.monotonic())
    end_s = time.monotonic() + READ_S
    try:
        while time.monotonic() < end_s:
            reader.turn(time.monotonic())
            trouble = reader.judge(time.monotonic())
            if trouble is None or trouble.code != "imu_starting":
                return trouble
            time.sleep(PERIOD_S)
    finally:
        reader.close()
    return ImuTrouble("imu_unsettled", "what it says standing is not known")


def _hear_process(home: Path, robot: RobotDescription) -> ImuTrouble | None:
    status = hear_state(home, robot, keys.IMU_STATE)
    if status is None:
        return ImuTrouble("imu_silent", "its process runs and says nothing: logs/imu.log")
    return None if status.code is None else ImuTrouble(status.code, status.detail)
