"""STAND-IN for a localizer: the simulator's truth plus noise. It localizes nothing.

It exists so that everything above can be built and judged before a real localizer does; it works
in the simulator only, and its name says so in every log. It gives what a localizer gives, and no
more: ``odom`` in ``map``, for the odometry it has seen, at a time when both sources were known.

Pure: told messages and the time. Law: no truth, no odometry, or both too old: no word.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from localization.interpolation import PoseTrack
from localization.noise import NoiseParams, PoseNoise
from wire import Localization, compose, inverse

if TYPE_CHECKING:
    from wire import Odometry, SimTruth

STAND_IN_QUALITY = 0.95
"""Constant: the noise is stationary. A real localizer's quality comes from its scan match."""
OLDEST_S = 0.25
"""An answer about a time further back is none; the bridge calls 0.3 s without one POSE_LOST."""


class StandIn:
    """Turn truth and odometry into localization messages."""

    def __init__(self, map_id: str, *, seed: int = 0, noise: NoiseParams | None = None) -> None:
        self._map_id = map_id
        self._noise = PoseNoise(seed, noise)
        self._truth, self._odom = PoseTrack(), PoseTrack()
        self._truth_boot: str | None = None
        self._odom_id: str | None = None
        self._answered_s: float | None = None
        self._seq = 0

    def hear_truth(self, truth: SimTruth) -> None:
        """Take the simulator's true pose; another boot of it starts a new track."""
        if truth.boot_id != self._truth_boot:
            self._truth_boot = truth.boot_id
            self._truth.clear()
        self._truth.add(truth.stamp_s, truth.base_in_map)

    def hear_odometry(self, odometry: Odometry) -> None:
        """Take the bridge's odometry; another odom_id is another frame and starts anew."""
        if odometry.odom_id != self._odom_id:
            self._odom_id = odometry.odom_id
            self._odom.clear()
        self._odom.add(odometry.stamp_s, odometry.base_in_odom)

    def answer(self, now_s: float) -> Localization | None:
        """Return ``odom`` in ``map`` at the newest time known from both; None if too old."""
        at_s = self._common_s()
        if at_s is None or self._odom_id is None or not now_s - at_s <= OLDEST_S:
            return None
        truth, odom = self._truth.at(at_s), self._odom.at(at_s)
        if truth is None or odom is None or at_s == self._answered_s:
            return None
        self._noise.advance(0.0 if self._answered_s is None else at_s - self._answered_s)
        self._answered_s = at_s
        self._seq += 1
        return Localization(
            odom_id=self._odom_id,
            seq=self._seq,
            stamp_s=at_s,
            odom_in_map=compose(self._noise.disturb(truth), inverse(odom)),
            quality=STAND_IN_QUALITY,
            map_id=self._map_id,
        )

    def _common_s(self) -> float | None:
        truth_s, odom_s = self._truth.newest_s, self._odom.newest_s
        return None if truth_s is None or odom_s is None else min(truth_s, odom_s)
