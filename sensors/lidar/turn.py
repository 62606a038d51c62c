"""Collect a lidar's beams into whole turns, and turns into scans of the wire.

Owns what a scan promises to a bridge that reads a missing return as free floor: every direction was
looked at. A turn with a gap, as a lost frame leaves one, makes no scan. Knows no sensor's bytes.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import tau
from typing import TYPE_CHECKING

from wire import Scan

if TYPE_CHECKING:
    from collections.abc import Sequence

    from wire.robot import LidarConfig

MAX_GAP_DEG = 3.0
"""Between two beams that follow each other. The coarsest sensor here, an RPLidar A1 at 10 Hz with
2 000 beams a second, has 1.8 degrees; a lost frame of an LD19 leaves ten."""
MAX_SHIFTED_GAP_DEG = 12.0
"""The same where only angles are known that are corrected for triangulation already: two beams that
follow each other, one near and one far, differ by up to 8 degrees more."""
BACK_DEG = 20.0
"""An angle that falls by more began a new turn; one that falls by less is jitter or
triangulation."""
MAX_TURN_S = 0.25
"""A turn that took longer (a slow motor, or two of which the seam was lost) is as old as
LIDAR_STALE."""


@dataclass(frozen=True, slots=True)
class Beams:
    """Hold beams in the order in which they were taken."""

    angles_deg: tuple[float, ...]
    """Where each looked, as the sensor counts, in [0, 360)."""
    swept_deg: tuple[float, ...]
    """Where its head stood: the same, but for triangulation. Shows what was not looked at."""
    distances_m: tuple[float, ...]
    """0 where nothing came back."""
    first_s: float
    """When the first was taken, on our clock."""
    period_s: float
    """From one beam to the next."""


@dataclass(frozen=True, slots=True)
class LidarTurn:
    """Hold one turn of the sensor without a gap, in the order of the beams."""

    angles_deg: tuple[float, ...]
    distances_m: tuple[float, ...]
    first_s: float
    last_s: float


class TurnCollector:
    """Cut a stream of beams where a turn begins; count the turns that were not whole."""

    def __init__(self, max_gap_deg: float = MAX_GAP_DEG) -> None:
        self._max_gap_deg = max_gap_deg
        self._angles: list[float] = []
        self._swept: list[float] = []
        self._distances: list[float] = []
        self._first_s = self._last_s = 0.0
        self._begun = False
        self.turns = 0
        self.broken = 0
        """Turns with a gap or too long; the first, which was joined half-way, does not count."""

    def add(self, beams: Beams) -> list[LidarTurn]:
        """Take beams in the order of their times; return the turns that they complete."""
        whole: list[LidarTurn] = []
        for index, (angle, swept, distance) in enumerate(
            zip(beams.angles_deg, beams.swept_deg, beams.distances_m, strict=True)
        ):
            taken_s = beams.first_s + index * beams.period_s
            if self._swept and self._swept[-1] - swept > BACK_DEG:
                turn = self._close()
                if turn is not None:
                    whole.append(turn)
            if not self._angles:
                self._first_s = taken_s
            self._angles.append(angle)
            self._swept.append(swept)
            self._distances.append(distance)
            self._last_s = taken_s
        return whole

    def _close(self) -> LidarTurn | None:
        turn = LidarTurn(tuple(self._angles), tuple(self._distances), self._first_s, self._last_s)
        swept = self._swept
        self._angles, self._swept, self._distances = [], [], []
        begun, self._begun = self._begun, True
        if not begun:
            return None  # it was joined half-way
        in_time = 0.0 <= turn.last_s - turn.first_s <= MAX_TURN_S
        if not (in_time and has_no_gap(swept, self._max_gap_deg)):
            self.broken += 1
            return None
        self.turns += 1
        return turn


def has_no_gap(angles_deg: Sequence[float], max_gap_deg: float) -> bool:
    """Return whether beams cover a turn with no more than so much between neighbours."""
    ordered = sorted(angles_deg)
    if not ordered:
        return False
    seam = ordered[0] + 360.0 - ordered[-1]
    return seam <= max_gap_deg and all(b - a <= max_gap_deg for a, b in pairwise(ordered))


@dataclass(frozen=True, slots=True)
class ScanShape:
    """Say how a turn becomes a scan: always the same directions, so that readers may keep
    theirs.
    """

    beams: int
    lidar: LidarConfig
    clockwise: bool = True
    """The sensor counts its angles clockwise, seen from above; False where it hangs upside down."""

    def scan(self, turn: LidarTurn, boot_id: str, seq: int) -> Scan:
        """Return a turn as a scan: each direction holds the nearest return that fell into it.

        The frame's x is the sensor's own zero; how that is mounted is ``[lidar] yaw_rad``. A turn
        begins there, so that a clockwise one ends with the first direction that is listed.

        A direction in which no beam fell (there are more of them than beams, or the motor is not
        even) takes the nearer of its neighbours: never less than what was seen beside it.
        """
        step_rad = tau / self.beams
        return Scan(
            boot_id=boot_id,
            seq=seq,
            stamp_s=turn.first_s,
            time_increment_s=max(0.0, turn.last_s - turn.first_s) / max(1, self.beams - 1),
            clockwise=self.clockwise,
            angle_min_rad=0.5 * step_rad,
            angle_increment_rad=step_rad,
            range_min_m=self.lidar.range_min_m,
            range_max_m=self.lidar.range_max_m,
            ranges_m=self._ranges(turn),
        )

    def _ranges(self, turn: LidarTurn) -> tuple[float | None, ...]:
        nearest: list[float | None] = [None] * self.beams
        looked = [False] * self.beams
        share = self.beams / 360.0
        high = self.lidar.range_max_m
        for angle, distance in zip(turn.angles_deg, turn.distances_m, strict=True):
            swept = int(angle * share) % self.beams
            index = self.beams - 1 - swept if self.clockwise else swept
            looked[index] = True
            known = nearest[index]
            if 0.0 < distance <= high and (known is None or distance < known):
                nearest[index] = distance
        for index in [i for i, seen in enumerate(looked) if not seen]:
            beside = [
                nearest[j] for j in self._looked_beside(looked, index) if nearest[j] is not None
            ]
            nearest[index] = min((r for r in beside if r is not None), default=None)
        return tuple(None if r is None else round(r, 4) for r in nearest)

    def _looked_beside(self, looked: Sequence[bool], index: int) -> tuple[int, int]:
        """Return the next directions to both sides in which a beam fell; a turn has no large
        gap.
        """
        low = high = index
        while not looked[low]:
            low = (low - 1) % self.beams
        while not looked[high]:
            high = (high + 1) % self.beams
        return low, high
