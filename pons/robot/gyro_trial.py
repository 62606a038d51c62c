"""Try a gyro: does it turn left when a person turns the robot left?

A gyro that sits upside down says the turns of another robot, and one on its side says next to
nothing. First the robot stands, so that what the gyro says standing is known; then it is turned.
"""

from __future__ import annotations

import time
from functools import partial
from math import degrees, isfinite
from typing import TYPE_CHECKING, Final, Protocol

from devices.inertial import MOST_RADPS, Mounting, Vector
from pons.robot.trial_parties import TrialRefusal
from sensors.imu.bus import SmBus
from sensors.imu.reader import ImuReader

if TYPE_CHECKING:
    from collections.abc import Callable

    from bridge.drive import SerialDrive
    from devices.inertial import InertialReading
    from pons.robot.trial_parties import TrialPace, TrialPerson
    from sensors.imu.bus import I2cBus
    from wire import RobotDescription
    from wire.imu_config import Axis, ImuConfig

STILL_S = 2.0
FEWEST = 20
SHAKES_RADPS = 0.1
SILENT_S = 2.0
GAP_S = 0.5
"""Between two readings; a turn across a longer silence is not known."""
TURNED_RAD = 0.6
"""A third less than the quarter that is asked for."""
OTHER_SHARE = 0.5
"""So much of the largest turn about another axis is a robot that was tipped."""
AXES: Final[tuple[Axis, ...]] = ("x", "y", "z")
_SETTLES: Final = frozenset({"imu_starting", "imu_unsettled"})
"""A chip that was just opened; and one that is turned, whose bias the trial takes away itself."""

Timed = tuple[float, "InertialReading"]


class GyroSource(Protocol):
    """Be a gyro as the robot reads it, in the sensor's axes."""

    def readings(self) -> list[Timed]:
        """Return what came since the last call, each with its stamp [s], oldest first."""


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

    def close(self) -> None:
        """Hold nothing: the base's port is the trial's."""


class I2cGyroSource:
    """Be a chip on an I2C bus, read as its process reads it."""

    def __init__(
        self,
        robot: RobotDescription,
        open_bus: Callable[[], I2cBus] | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Read nothing yet.

        Args:
            robot: its ``[imu]`` names bus and chip.
            open_bus: opens another bus than that one.
            clock: now [s].
        """
        opens = open_bus or partial(SmBus, robot.imu.bus or 0)
        self._clock = clock
        self._reader = ImuReader(robot.imu, opens, "trial", clock())

    def readings(self) -> list[Timed]:
        """Read once.

        Raises:
            TrialRefusal: ``gyro_silent``, with the code of what is wrong with the chip.
        """
        now_s = self._clock()
        self._reader.turn(now_s)
        trouble = self._reader.judge(now_s)
        if trouble is not None and trouble.code not in _SETTLES:
            raise TrialRefusal("gyro_silent", f"{trouble.code}: {trouble.detail}")
        return [] if self._reader.reading is None else [self._reader.reading]

    def close(self) -> None:
        """Give the bus back."""
        self._reader.close()


def try_gyro(imu: ImuConfig, source: GyroSource, pace: TrialPace, person: TrialPerson) -> float:
    """Have a person turn the robot left; return by how much the gyro says it did [rad].

    Raises:
        TrialRefusal: ``gyro_silent``, ``gyro_shakes``, ``gyro_none``, ``gyro_backwards`` or
            ``gyro_axis``.
    """
    bias_radps = _standing(source, pace)
    person.ask("gyro_left")
    turned = [0.0, 0.0, 0.0]
    last: Timed | None = None
    count, heard_s = 0, pace.now_s()
    while not person.has_answered():
        person.require_watch()
        pace.wait()
        if pace.now_s() - heard_s > SILENT_S:
            raise TrialRefusal("gyro_silent", f"for {SILENT_S:g} s while it was to be turned")
        for at_s, reading in source.readings():
            heard_s = pace.now_s()
            rates = [rate - bias for rate, bias in zip(reading.gyro_radps, bias_radps, strict=True)]
            if last is not None and at_s - last[0] > GAP_S:
                raise TrialRefusal("gyro_silent", f"for {at_s - last[0]:.1f} s while it turned")
            if last is not None and all(map(isfinite, rates)):
                for axis in range(3):
                    turned[axis] += rates[axis] * (at_s - last[0])
                count += 1
            last = at_s, reading
    if not count:
        raise TrialRefusal("gyro_silent", "while the robot was turned")
    return _judge(imu, (turned[0], turned[1], turned[2]))


def _standing(source: GyroSource, pace: TrialPace) -> Vector:
    """Return what each axis says while the robot stands [rad/s]."""
    source.readings()
    until_s = pace.now_s() + STILL_S
    seen: list[Vector] = []
    while pace.now_s() < until_s:
        pace.wait()
        seen += [reading.gyro_radps for _, reading in source.readings()]
    if len(seen) < FEWEST:
        raise TrialRefusal("gyro_silent", f"{len(seen)} readings in {STILL_S:g} s")
    means = []
    for axis, rates in zip(AXES, zip(*seen, strict=True), strict=True):
        mean, spread = sum(rates) / len(rates), max(rates) - min(rates)
        if not (spread <= SHAKES_RADPS and abs(mean) <= MOST_RADPS):
            raise TrialRefusal("gyro_shakes", f"{axis}: {mean:+.2f} rad/s, {spread:.2f} apart")
        means.append(mean)
    return means[0], means[1], means[2]


def _judge(imu: ImuConfig, turned: Vector) -> float:
    yaw_rad = Mounting(imu.up, imu.forward).turn(turned)[2]
    told = ", ".join(
        f"{axis} {degrees(angle):+.0f} deg" for axis, angle in zip(AXES, turned, strict=True)
    )
    largest = max(turned, key=abs)
    if not abs(largest) >= TURNED_RAD:
        raise TrialRefusal("gyro_none", told)
    axis = AXES[turned.index(largest)]
    up = axis if largest > 0.0 else f"-{axis}"
    if axis != imu.up.strip("-") or sorted(map(abs, turned))[1] > OTHER_SHARE * abs(largest):
        raise TrialRefusal("gyro_axis", f"{told}; imu.up is {imu.up!r} and may be {up!r}")
    if yaw_rad < 0.0:
        raise TrialRefusal("gyro_backwards", f"{told}; imu.up is {imu.up!r} and may be {up!r}")
    return yaw_rad
