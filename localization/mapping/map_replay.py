"""Build a map from what a robot heard on a drive: its odometry and scans, in the order they came.

Odometry may come after the scan that it places; a scan waits until odometry covers its sweep.
"""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

import numpy as np

from localization.deskew import deskew, sweep_s
from localization.mapping.map_builder import MapBuilder
from localization.mapping.scan_tracker import ScanTracker
from localization.odometry_integration import OdometryTrail
from maps.errors import BilingualError
from wire import Odometry

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from localization.mapping.scan_tracker import KeyframeLink
    from wire import Scan
    from wire.lidar_config import LidarConfig

    Floats = NDArray[np.float64]

MOST_WAITING = 20
"""Scans whose odometry never comes are dropped, the oldest first."""


class MapReplay:
    """Feed a drive to a tracker and a map builder."""

    def __init__(self, lidar: LidarConfig, *, closes_loops: bool = True) -> None:
        """Begin a map at the drive's first scan.

        Args:
            lidar: where it is on the robot.
            closes_loops: False where the chain of keyframes alone is wanted, for a map that stands.
        """
        self.builder = MapBuilder((lidar.x_m, lidar.y_m))
        self.links: list[KeyframeLink] = []
        """The chain of keyframes, as the tracker made it."""
        self._closes_loops = closes_loops
        self.scans = 0
        """How many were placed."""
        self._lidar = lidar
        self._tracker = ScanTracker()
        self._trail = OdometryTrail()
        self._odom_id: str | None = None
        self._waiting: deque[Scan] = deque(maxlen=MOST_WAITING)
        self._placed_s = -np.inf

    @property
    def pose(self) -> Floats:
        """Return x, y, yaw of ``base`` in ``map`` at the newest scan."""
        return self._tracker.pose

    def hear(self, messages: Iterable[Odometry | Scan]) -> None:
        """Take messages in the order of their arrival.

        Raises:
            BilingualError: ``odom_id`` changed: how the robot moved between two frames is unknown.
        """
        for message in messages:
            if isinstance(message, Odometry):
                if self._odom_id not in {None, message.odom_id}:
                    text = f"odometry {message.odom_id} after {self._odom_id}"
                    raise BilingualError(
                        f"{text}; give the recordings of one run of the bridge",
                        f"里程计 {message.odom_id} 接在 {self._odom_id} 之后；"
                        "请给出桥接进程同一次运行的记录",
                    )
                self._odom_id = message.odom_id
                self._trail.add(message)
            else:
                self._waiting.append(message)
            self._use_waiting()

    def _use_waiting(self) -> None:
        newest = self._trail.newest
        while newest is not None and self._waiting:
            scan = self._waiting[0]
            end_s = scan.stamp_s + sweep_s(scan)
            if newest.stamp_s < end_s:
                return
            self._waiting.popleft()
            if scan.stamp_s > self._placed_s and self._trail.covers(scan.stamp_s, end_s):
                self._placed_s = scan.stamp_s
                self._use(scan)

    def _use(self, scan: Scan) -> None:
        cloud = deskew(scan, self._lidar, self._trail)
        at = self._trail.at(cloud.stamp_s)
        carried = np.array((at.x_m, at.y_m, at.yaw_rad))
        self.place_scan(cloud.points_m, carried, cloud.stamp_s)

    def place_scan(self, points_m: Floats, carried: Floats, stamp_s: float) -> None:
        """Place a scan whose pose by odometry is known.

        Args:
            points_m: returns in ``base``, of one instant, shape (n, 2).
            carried: x, y, yaw by odometry.
            stamp_s: the instant; it is kept with the keyframe and decides nothing.
        """
        link = self._tracker.use_scan(points_m, carried, stamp_s)
        self.scans += 1
        if link is None:
            return
        self.links.append(link)
        if self._closes_loops and self.builder.add(link):
            self._tracker.correct(self.builder.poses)
