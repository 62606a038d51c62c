"""Be the smallest robot that passes a self test: it echoes, times out, stands, and sees walls."""

from __future__ import annotations

import math
import threading
import time
from pathlib import Path

from wire import DriveCommand, DriveState, Imu, Scan
from wire.keys import DRIVE_COMMAND, DRIVE_STATE, IMU, SCAN, Party
from wire.session import open_session

PERIOD_S = 0.01
TIMEOUT_S = 0.2
BEAMS = 180


class FakeRobot(threading.Thread):
    """Answer as a drive at 100 Hz, with a lidar at 10 Hz, until closed. It never moves."""

    def __init__(self, home: Path) -> None:
        super().__init__(daemon=True)
        self._session = open_session(Party.ROBOT, "r1", home)
        self._commands = self._session.subscriber(DRIVE_COMMAND)
        self._states = self._session.publisher(DRIVE_STATE)
        self._scans = self._session.publisher(SCAN)
        self._imu = self._session.publisher(IMU)
        self._over = threading.Event()
        self.heard: list[tuple[float, DriveCommand]] = []
        """Every command with the monotonic time of its receipt."""

    def run(self) -> None:
        seq = 0
        while not self._over.wait(PERIOD_S):
            seq += 1
            now_s = time.monotonic()
            for item in self._commands.drain().items:
                if isinstance(item, DriveCommand):
                    self.heard.append((now_s, item))
            self._report(seq, now_s)

    def close(self) -> None:
        """End and leave."""
        self._over.set()
        self.join()
        self._session.close()

    def __enter__(self) -> FakeRobot:
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def last(self) -> DriveCommand | None:
        """Return the newest command."""
        return self.heard[-1][1] if self.heard else None

    def _report(self, seq: int, now_s: float) -> None:
        at_s, last = self.heard[-1] if self.heard else (-math.inf, None)
        timed_out = now_s - at_s > TIMEOUT_S
        self._states.put(
            DriveState(
                boot_id="fake",
                seq=seq,
                stamp_s=now_s,
                echo_boot=None if last is None else last.boot,
                echo_seq=0 if last is None else last.seq,
                enabled=last is not None and last.enable and not timed_out,
                timed_out=timed_out,
                left_rad=0.0,
                right_rad=0.0,
                left_radps=0.0,
                right_radps=0.0,
                estop_pressed=False,
                bumper_front=False,
                bumper_rear=False,
                cliff=False,
            )
        )
        self._imu.put(
            Imu(
                boot_id="fake",
                seq=seq,
                stamp_s=now_s,
                yaw_rate_radps=0.0,
                accel_x_mps2=0.0,
                accel_y_mps2=0.0,
            )
        )
        if seq % 10 == 0:
            self._scans.put(self._scan(seq, now_s))

    def _scan(self, seq: int, now_s: float) -> Scan:
        wobble_m = 0.001 * (seq % 70)  # no two scans of a real lidar are equal
        return Scan(
            boot_id="fake",
            seq=seq,
            stamp_s=now_s,
            angle_min_rad=-math.pi,
            angle_increment_rad=2 * math.pi / BEAMS,
            range_min_m=0.12,
            range_max_m=8.0,
            ranges_m=(2.0 + wobble_m,) * BEAMS,
        )
