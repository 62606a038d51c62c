"""Say where the robot is in a map that it makes while it drives: messages and time in, pose out.

The tracker aligns each scan with what the last keyframes saw. Each keyframe goes to the builder, in
another process, which looks for loops; what a loop moves is told back and moves the robot along, by
the law of jumps: the bridge holds first. Pure: told messages, poses and the time.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from localization.deskew import deskew, sweep_s
from localization.jump_law import JumpLaw
from localization.mapping.carry_law import CarryLaw
from localization.mapping.scan_tracker import ScanTracker
from localization.odometry_integration import OdometryTrail
from localization.quality import FADING_M, FADING_S, POOR_QUALITY
from wire import Localization, Pose2, compose, inverse

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from localization.mapping.keyframes import Keyframe
    from localization.mapping.scan_tracker import KeyframeLink
    from wire import Odometry, Scan
    from wire.lidar_config import LidarConfig

    Floats = NDArray[np.float64]

OLDEST_S = 0.25
"""Odometry older than this carries no pose; the bridge calls 0.3 s POSE_LOST."""
OLD_SCAN_S = 0.5


class LiveMapper:
    """Hold one robot's pose in the map that it makes."""

    def __init__(
        self,
        lidar: LidarConfig,
        map_id: str,
        start: Floats | None = None,
        known: Sequence[Keyframe] = (),
    ) -> None:
        """Begin at a pose.

        Args:
            lidar: where it is on the robot.
            map_id: of the canvas that the map grows on.
            start: x, y, yaw in ``map``; the frame's origin if left out.
            known: keyframes of another day, which this day's go on from.
        """
        self._lidar, self._map_id = lidar, map_id
        self._carry_law = CarryLaw()
        self._tracker = ScanTracker(start, known, self._carry_law, (lidar.x_m, lidar.y_m))
        self._trail = OdometryTrail()
        self._odometry: Odometry | None = None
        self._scan: Scan | None = None
        self._links: list[KeyframeLink] = []
        self._jump_law = JumpLaw()
        self._placed: tuple[float, float] | None = None
        """Stamp [s] and metres of wheels at the newest scan that fitted."""
        self._said_s: float | None = None
        self._seq = 0

    @property
    def fit(self) -> float:
        """Return the share of the newest scan's returns that lie on what was seen before."""
        return self._tracker.fit

    @property
    def is_lost(self) -> bool:
        """Return whether the robot stands where odometry can't have brought it."""
        return self._carry_law.is_lost

    def is_placed(self, now_s: float) -> bool:
        """Return whether scans hold the pose now."""
        placed = self._placed
        return placed is not None and self._tracker.is_placed and now_s - placed[0] <= FADING_S

    def quality(self, now_s: float) -> float:
        """Return the pose's quality, in [0, 1]; it falls with time and metres without a scan."""
        newest = self._trail.newest
        if self._placed is None or newest is None or self.is_lost:
            return 0.0
        placed_s, placed_m = self._placed
        unseen = max((now_s - placed_s) / FADING_S, (newest.travelled_m - placed_m) / FADING_M)
        return min(max(1.0 - (1.0 - POOR_QUALITY) * unseen, 0.0), 1.0)

    def hear_odometry(self, odometry: Odometry) -> None:
        """Take the bridge's odometry; another odom_id is another frame, joined on here."""
        last = self._odometry
        if last is not None and odometry.odom_id != last.odom_id:
            # The bridge began anew. Nobody says that the robot was moved meanwhile; scans will.
            self._trail.clear()
            self._tracker.forget_odometry()
            self._jump_law.clear()
            self._placed = None
        self._odometry = odometry
        self._trail.add(odometry)

    def hear_scan(self, scan: Scan) -> None:
        """Keep a scan until odometry covers it; a newer one takes its place."""
        self._scan = scan

    def hear_poses(self, poses: Floats) -> None:
        """Take where the builder has keyframes now, shape (n, 3): a loop moved them."""
        self._tracker.correct(poses)

    def take_links(self) -> list[KeyframeLink]:
        """Return the keyframes made since the last call, for the builder."""
        links, self._links = self._links, []
        return links

    def work(self) -> None:
        """Use the newest scan, as soon as odometry covers it."""
        scan, newest = self._scan, self._trail.newest
        if scan is None or newest is None:
            return
        end_s = scan.stamp_s + sweep_s(scan)
        if newest.stamp_s < end_s <= newest.stamp_s + OLD_SCAN_S:
            return  # its odometry is on the way
        self._scan = None
        fresh = newest.stamp_s - scan.stamp_s <= OLD_SCAN_S
        if not fresh or not self._trail.covers(scan.stamp_s, end_s):
            return
        cloud = deskew(scan, self._lidar, self._trail)
        at = self._trail.at(cloud.stamp_s)
        link = self._tracker.use_scan(cloud.points_m, _array(at), cloud.stamp_s)
        if link is not None:
            self._links.append(link)
        if self._tracker.is_placed:
            self._placed = (cloud.stamp_s, self._trail.counters_at(cloud.stamp_s)[0])

    def answer(self, now_s: float) -> Localization | None:
        """Return ``odom`` in ``map`` for the newest odometry; None without a scan or news."""
        newest, odometry = self._trail.newest, self._odometry
        if newest is None or odometry is None or self._placed is None:
            return None
        if not now_s - newest.stamp_s <= OLDEST_S or newest.stamp_s == self._said_s:
            return None
        quality = self.quality(newest.stamp_s)
        x_m, y_m, yaw = self._tracker.predict(_array(newest.carried)).tolist()
        odom_in_map = compose(Pose2(x_m, y_m, yaw), inverse(newest.base_in_odom))
        odom_in_map, quality = self._jump_law.apply(odom_in_map, newest.base_in_odom, quality)
        self._said_s = newest.stamp_s
        self._seq += 1
        return Localization(
            odom_id=odometry.odom_id,
            seq=self._seq,
            stamp_s=newest.stamp_s,
            odom_in_map=odom_in_map,
            quality=quality,
            map_id=self._map_id,
        )


def _array(pose: Pose2) -> Floats:
    return np.array((pose.x_m, pose.y_m, pose.yaw_rad))
