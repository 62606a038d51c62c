"""Decode LDS-02, LDRobot's LD08, which TurtleBot 3 carries: an LD19's frames at 115 200 baud.

Layout: ROBOTIS' e-Manual of the LDS-02 (2 300 points/s, 0.16 to 8 m, talks by itself). It
triangulates: each distance is along its own tilted ray from a lens beside the axis. The numbers of
lens and tilt are those of ROBOTIS' driver (ld08_driver, Apache-2.0). The manual does not say at
which number the milliseconds begin again, so a step back begins the clock anew.
"""

from __future__ import annotations

from dataclasses import replace
from math import atan2, degrees, hypot
from statistics import median
from typing import TYPE_CHECKING

from devices.port_probe import PortAnswer, PortProbe
from sensors.lidar.ldrobot import LdRobotDecoder, describe
from sensors.lidar.turn import Beams

if TYPE_CHECKING:
    from collections.abc import Sequence

BAUD = 115_200
POINTS_PER_S = 2_300
TILT = 0.11923
"""To the side, of each metre along the beam."""
LENS_AHEAD_M, LENS_ASIDE_M = 0.0059, -0.02014


def seen_from_the_axis(angle_deg: float, distance_m: float) -> tuple[float, float]:
    """Return angle, clockwise, and distance of what a beam met, seen from the turning axis."""
    if not distance_m > 0.0:
        return angle_deg, 0.0
    ahead_m = distance_m + LENS_AHEAD_M
    aside_m = distance_m * TILT + LENS_ASIDE_M
    shift_deg = degrees(atan2(aside_m, ahead_m))
    return (angle_deg - shift_deg) % 360.0, hypot(ahead_m, aside_m)


class Ld08Decoder(LdRobotDecoder):
    """Turn the sensor's bytes into beams around its axis."""

    baud = BAUD
    points_per_s = POINTS_PER_S

    def __init__(self) -> None:
        super().__init__()
        self._last_ms = 0

    def _sensor_s(self, time_ms: int) -> float:
        if time_ms < self._last_ms:
            self._clock.reset()
        self._last_ms = time_ms
        return time_ms / 1000.0

    def _beams(self, frame: bytes, arrival_s: float) -> Beams:
        beams = super()._beams(frame, arrival_s)
        seen = [
            seen_from_the_axis(angle_deg, distance_m)
            for angle_deg, distance_m in zip(beams.swept_deg, beams.distances_m, strict=True)
        ]
        angles_deg, distances_m = zip(*seen, strict=True)
        return replace(beams, angles_deg=angles_deg, distances_m=distances_m)


def is_slow(beams: Sequence[Beams]) -> bool:
    """Tell whether frames are an LD08's: its kin, in the same frames, take 4 500 beams a second."""
    return median(each.period_s for each in beams) > 1.0 / 3_000


def recognise(data: bytes) -> PortAnswer | None:
    """Return what the sensor says of itself; it speaks unasked."""
    beams = LdRobotDecoder().feed(data, 0.0)
    return describe(data, "lidar LDS-02 (LD08)") if beams and is_slow(beams) else None


PROBES = (PortProbe("lidar", "ld08", BAUD, recognise),)
