"""Hold the robot's messages back, or lose them, on their way out of motor controller and sensors.

Stamps and numbers stay as they were given: that they are old is what a receiver has to see.
"""

from __future__ import annotations

from collections import deque
from random import Random
from typing import TYPE_CHECKING, Generic, TypeVar

if TYPE_CHECKING:
    from sim.domain import Domain
    from wire import DriveState, Imu, Scan

T = TypeVar("T")


class DelayLine(Generic[T]):
    """Carry one kind of message; without delay and loss it passes everything on at once."""

    def __init__(self, random: Random, delay_ticks: int, loss_share: float) -> None:
        self._random, self._delay_ticks, self._loss_share = random, delay_ticks, loss_share
        self._coming: deque[tuple[int, T]] = deque()
        self._tick = 0

    def carry(self, message: T | None) -> T | None:
        """Take this tick's message, if there is one; return the one that arrives now, if any."""
        self._tick += 1
        if message is not None and self._loss_share > 0.0:
            message = None if self._random.random() < self._loss_share else message
        if self._delay_ticks == 0:
            return message
        if message is not None:
            self._coming.append((self._tick + self._delay_ticks, message))
        if self._coming and self._coming[0][0] <= self._tick:
            return self._coming.popleft()[1]
        return None


class MessageDelays:
    """Hold the ways of all that a domain may hold back."""

    def __init__(self, domain: Domain, tick_s: float) -> None:
        def way(key: str, delay_s: float, loss_share: float) -> tuple[Random, int, float]:
            return Random(f"{key} {domain.seed}"), round(delay_s / tick_s), loss_share

        d = domain
        self.drive: DelayLine[DriveState] = DelayLine(
            *way("drive", d.drive_delay_s, d.drive_loss_share)
        )
        self.imu: DelayLine[Imu] = DelayLine(*way("imu", d.imu_delay_s, d.imu_loss_share))
        self.scan: DelayLine[Scan] = DelayLine(*way("scan", d.scan_delay_s, d.scan_loss_share))
