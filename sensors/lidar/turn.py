"""Collect a lidar's beams into whole turns, and turns into scans of the wire.

Owns what a scan promises to a bridge that reads a missing return as free floor: every direction was
looked at. A turn with a gap, as a lost frame leaves one, makes no scan. Knows no sensor's bytes.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field
from itertools import pairwise
from math import ceil, tau
from typing import TYPE_CHECKING

from wire import Scan

if TYPE_CHECKING:
    from collections.abc import Sequence

    from wire.lidar_config import LidarConfig

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
COUNTED_WINDOW_S = 0.5
"""SensorClock's window where a sensor sends no time and its beams are counted: a rate that is 2 %
off then dates a beam 10 ms too old, not 40."""
FRESH_S = 0.22
"""How old a scan's first beam may be when the next comes: LIDAR_STALE's 0.25 s less the way."""
MOST_CUTS = 8


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
    cut: int = 0
    """At which of the shape's cuts it begins; the first is the sensor's zero."""


@dataclass(slots=True)
class _Part:
    """Collect the beams between two cuts."""

    angles: list[float] = field(default_factory=list)
    swept: list[float] = field(default_factory=list)
    distances: list[float] = field(default_factory=list)
    first_s: float = 0.0
    last_s: float = 0.0


def cuts_for(turn_s: float) -> int:
    """Return at how many places a turn may end, so that scans of slow turns stay fresh.

    A scan's first beam is one turn old when the scan is whole, and older by the wait for the next
    when that comes. One scan a turn keeps within FRESH_S up to turns of 0.11 s; a slower lidar
    gives a scan of its last 360 degrees several times a turn.
    """
    spare_s = FRESH_S - turn_s
    return min(MOST_CUTS, ceil(turn_s / spare_s)) if spare_s > 0.0 else MOST_CUTS


class TurnCollector:
    """Cut a stream of beams into whole turns; count the turns that were not whole.

    Turns end at ``cuts`` places evenly around the sensor; with more than one they overlap.
    """

    def __init__(self, max_gap_deg: float = MAX_GAP_DEG, cuts: int = 1) -> None:
        self._max_gap_deg = max_gap_deg
        self._cuts = cuts
        self._width_deg = 360.0 / cuts
        self._cut = 0
        """Where the part that is being collected began; the next is one further."""
        self._into_deg = 0.0
        """How far the newest beam lies beyond that place."""
        self._last_deg: float | None = None
        self._part = _Part()
        self._parts: deque[_Part] = deque(maxlen=cuts)
        self._begun = False
        self.turns = 0
        self.broken = 0
        """Turns with a gap or too long; the first, which was joined half-way, does not count."""
        self.gaps = 0
        """Of those, the ones with a gap: bytes were lost."""

    def forget(self) -> None:
        """Drop the unfinished turn: what comes next is of another time."""
        self._last_deg, self._part, self._begun = None, _Part(), False
        self._parts.clear()

    def add(self, beams: Beams) -> list[LidarTurn]:
        """Take beams in the order of their times; return the turns that they complete."""
        whole: list[LidarTurn] = []
        taken_s = beams.first_s
        for angle, swept, distance in zip(
            beams.angles_deg, beams.swept_deg, beams.distances_m, strict=True
        ):
            if self._moves_on(swept):
                whole += self._cut_off()
            part = self._part
            if not part.angles:
                part.first_s = taken_s
            part.angles.append(angle)
            part.swept.append(swept)
            part.distances.append(distance)
            part.last_s = taken_s
            taken_s += beams.period_s
        return whole

    def _moves_on(self, swept_deg: float) -> bool:
        """Note where the head stands now; tell whether it passed a cut."""
        last_deg, self._last_deg = self._last_deg, swept_deg
        if last_deg is None:
            self._cut = int(swept_deg / self._width_deg) % self._cuts
            self._into_deg = swept_deg - self._cut * self._width_deg
            return False
        step_deg = (swept_deg - last_deg) % 360.0
        if step_deg > 360.0 - BACK_DEG:
            step_deg -= 360.0
        reckoned_deg = self._into_deg + step_deg
        # From the angle itself, so that the steps' rounding errors do not add up.
        seen_deg = (swept_deg - self._cut * self._width_deg) % 360.0
        self._into_deg = seen_deg + 360.0 * round((reckoned_deg - seen_deg) / 360.0)
        return self._into_deg >= self._width_deg

    def _cut_off(self) -> list[LidarTurn]:
        """End the part, and as many empty ones as were passed unseen; return the whole turns."""
        whole = []
        while self._into_deg >= self._width_deg:
            self._into_deg -= self._width_deg
            self._cut = (self._cut + 1) % self._cuts
            part, self._part = self._part, _Part()
            if not self._begun:
                self._begun = True  # it was joined half-way
                continue
            self._parts.append(part)
            if len(self._parts) == self._cuts:
                turn = self._join()
                if turn is not None:
                    whole.append(turn)
        return whole

    def _join(self) -> LidarTurn | None:
        parts = self._parts
        first_s, last_s = parts[0].first_s, parts[-1].last_s
        swept = [angle for part in parts for angle in part.swept]
        is_whole = all(part.swept for part in parts) and has_no_gap(swept, self._max_gap_deg)
        if not (is_whole and 0.0 <= last_s - first_s <= MAX_TURN_S):
            self.broken += 1
            self.gaps += not is_whole
            return None
        self.turns += 1
        return LidarTurn(
            tuple(angle for part in parts for angle in part.angles),
            tuple(distance for part in parts for distance in part.distances),
            first_s,
            last_s,
            self._cut,
        )


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
    cuts: int = 1
    """At how many places turns begin; ``beams`` is a multiple of it."""

    def scan(self, turn: LidarTurn, boot_id: str, seq: int) -> Scan:
        """Return a turn as a scan: each direction holds the nearest return that fell into it.

        The frame's x is the sensor's own zero; how that is mounted is ``[lidar] yaw_rad``. The
        list begins where the turn began, or ends there if that was clockwise.

        A direction in which no beam fell (there are more of them than beams, or the motor is not
        even) takes the nearer of its neighbours: never less than what was seen beside it.
        """
        step_rad = tau / self.beams
        begun_rad = tau * turn.cut / self.cuts
        return Scan(
            boot_id=boot_id,
            seq=seq,
            stamp_s=turn.first_s,
            time_increment_s=max(0.0, turn.last_s - turn.first_s) / max(1, self.beams - 1),
            clockwise=self.clockwise,
            angle_min_rad=0.5 * step_rad + (-begun_rad if self.clockwise else begun_rad),
            angle_increment_rad=step_rad,
            range_min_m=self.lidar.range_min_m,
            range_max_m=self.lidar.range_max_m,
            ranges_m=self._ranges(turn),
        )

    def _ranges(self, turn: LidarTurn) -> tuple[float | None, ...]:
        nearest: list[float | None] = [None] * self.beams
        looked = [False] * self.beams
        share = self.beams / 360.0
        first = turn.cut * self.beams // self.cuts
        high = self.lidar.range_max_m
        for angle, distance in zip(turn.angles_deg, turn.distances_m, strict=True):
            swept = (int(angle * share) - first) % self.beams
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
