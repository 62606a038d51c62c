"""Read the gyro of robot.toml's [imu]: ``python -m sensors.imu --robot robot.toml [--home DIR]``.

It says ``imu`` 100 times a second, and on ``imu/state`` how the chip is (docs/sensors.md). A bus or
chip that is missing is waited for. Exit status: 0 left when asked, 1 its home can't be written at
present, 2 refused.
"""

from __future__ import annotations

import logging
import secrets
import sys
import time
from functools import partial
from typing import TYPE_CHECKING

from processes.priority import set_fifo
from sensors.imu.bus import ImuTrouble, SmBus, load_library
from sensors.imu.reader import ImuReader
from sensors.process import run_sensor
from wire import ConfigError, keys
from wire.keys import Party
from wire.session import open_session

if TYPE_CHECKING:
    from collections.abc import Callable

    from sensors.process import SensorRun
    from wire.imu_config import ImuConfig
    from wire.session import Session

log = logging.getLogger("imu")

PRIORITY = 35
"""Of SCHED_FIFO, as the lidar's."""
PERIOD_S = 0.01
STATE_S = 0.5


class ImuNode:
    """Connect one gyro to the wire."""

    def __init__(self, reader: ImuReader, session: Session) -> None:
        self._reader = reader
        self._imu = session.publisher(keys.IMU)
        self._state = session.publisher(keys.IMU_STATE)
        self._code: str | None = "imu_starting"
        self._said_s = float("-inf")
        self._seq = 0

    def run(self, stopped: Callable[[], bool]) -> None:
        """Read until told to stop; missed periods are skipped."""
        next_s = time.monotonic()
        while not stopped():
            time.sleep(max(0.0, next_s - time.monotonic()))
            now_s = time.monotonic()
            next_s = max(next_s + PERIOD_S, now_s)
            self.turn(now_s)

    def turn(self, now_s: float) -> None:
        """Say a reading, and twice a second how the chip is."""
        imu = self._reader.turn(now_s)
        if imu is not None:
            self._imu.put(imu)
        trouble = self._reader.judge(now_s)
        code = trouble.code if trouble else None
        if code == self._code and now_s - self._said_s < STATE_S:
            return
        if code != self._code:
            level = logging.INFO if code in (None, "imu_starting") else logging.WARNING
            log.log(level, "%s", trouble or "the gyro is read well")
        self._code, self._said_s = code, now_s
        self._seq += 1
        self._state.put(self._reader.status(self._seq, now_s))


def _serve(run: SensorRun) -> None:
    imu = run.robot.imu
    bus = _bus_of(imu)
    set_fifo(PRIORITY)  # before the session, whose threads inherit it
    with open_session(Party.IMU, run.robot.id, run.home) as session:
        boot_id = f"imu-{secrets.token_hex(4)}"
        reader = ImuReader(imu, partial(SmBus, bus), boot_id, time.monotonic())
        node = ImuNode(reader, session)
        run.settle()
        log.info("%s on /dev/i2c-%d", imu.kind, bus)
        node.run(run.is_stopped)
        reader.close()


def _bus_of(imu: ImuConfig) -> int:
    """Return the bus's number.

    Raises:
        ConfigError: ``imu_not_on_i2c`` or ``imu_library_missing``.
    """
    if imu.bus is None:
        raise ConfigError("imu_not_on_i2c", f"imu.kind is {imu.kind!r}; this one reads I2C chips")
    try:
        load_library()
    except ImuTrouble as trouble:
        raise ConfigError(trouble.code, trouble.detail) from None
    return imu.bus


def main(arguments: list[str] | None = None) -> int:
    """Return 0 after a clean end, 1 where its home can't be written at present, 2 when refused."""
    return run_sensor("imu", __doc__, _serve, arguments)


if __name__ == "__main__":
    sys.exit(main())
