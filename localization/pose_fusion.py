"""Weigh the pose that a scan fits best against the one that odometry carried there.

A cheap lidar's scans place a robot differently each time, by centimetres where a view holds one
direction weakly; wheels and gyro between two scans do not. A Kalman update keeps what many scans
agree on: x = p + P (P + R)^-1 (m - p), with p carried, m matched, P the spread of p, R of m. It
weighs and never decides: whether a pose counts is the score's to say (localization.quality), for
the spread that Gauss-Newton claims is too small wherever it converges. Pure numpy.
"""

from __future__ import annotations

from math import radians
from typing import TYPE_CHECKING

import numpy as np

from wire import wrap

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from wire import Pose2

    Floats = NDArray[np.float64]

BEAMS_A_FACT = 20.0
"""Beams that err together: neighbours meet one wall, whose cells on the map are all off alike."""
LEAST_SCAN_M, LEAST_SCAN_RAD = 0.004, radians(0.1)
"""No scan places a robot better than this."""
DRIFT_M, DRIFT_RAD = 0.002, radians(0.05)
"""Spread that each scan adds, however little the wheels turned: people lean on robots."""
DRIFT_PER_M, DRIFT_PER_RAD = 0.10, 0.05
"""Wheels 5 % wrong and a gyro's scale, twice: what is carried errs alike from scan to scan."""
DRIFT_PER_SLIP_M, DRIFT_PER_SLIP = 1.0, 1.0
"""By radians of turn that wheels and gyro tell differently: a wheel that slips drives nowhere."""

EXPECTED_SIGMAS, EXPECTED_M, EXPECTED_RAD = 3.0, 0.02, radians(1.0)
"""So many times the spread, and so much the map may be wrong by, are no surprise."""


class PoseFusion:
    """Hold the spread of the tracked pose: covariance of x [m], y [m], yaw [rad] in ``map``."""

    def __init__(self) -> None:
        self._spread: Floats
        self.restart()

    def restart(self) -> None:
        """Believe the next scan alone: the robot was placed anew."""
        self._spread = np.diag((1.0, 1.0, 1.0))

    def carry(self, metres: float, turn_rad: float, slip_rad: float) -> None:
        """Add what odometry may have wrong since the last scan that counted.

        Args:
            metres: of wheels.
            turn_rad: by the gyro, without sign.
            slip_rad: sum of the differences between the turns of wheels and gyro.
        """
        across_m = DRIFT_M + DRIFT_PER_M * metres + DRIFT_PER_SLIP_M * slip_rad
        turn = DRIFT_RAD + DRIFT_PER_RAD * turn_rad + DRIFT_PER_SLIP * slip_rad
        self._spread = self._spread + np.diag((across_m**2, across_m**2, turn**2))

    def expects(self, carried: Floats, other: Floats) -> bool:
        """Return whether odometry may have erred so much that the robot is at another pose."""
        off = other - carried
        off[2] = wrap(off[2])
        spread = self._spread + np.diag((EXPECTED_M**2, EXPECTED_M**2, EXPECTED_RAD**2))
        return bool(off @ np.linalg.solve(spread, off) <= EXPECTED_SIGMAS**2)

    def fuse(self, carried: Floats, matched: Floats, information: Floats) -> Floats:
        """Return the pose between a carried and a matched one; both shape (3,), in ``map``.

        Args:
            carried: by odometry.
            matched: where the scan fits best.
            information: of the scan, as :class:`localization.scan_matching.Alignment` has it.
        """
        least = np.diag((LEAST_SCAN_M**2, LEAST_SCAN_M**2, LEAST_SCAN_RAD**2))
        # A direction that nothing holds has no inverse; a millionth makes it very wide instead.
        scan = np.linalg.inv(information / BEAMS_A_FACT + 1e-6 * np.eye(3)) + least
        off = matched - carried
        off[2] = wrap(off[2])
        gain = self._spread @ np.linalg.inv(self._spread + scan)
        self._spread = (np.eye(3) - gain) @ self._spread
        self._spread = 0.5 * (self._spread + self._spread.T)
        fused: Floats = carried + gain @ off
        fused[2] = wrap(fused[2])
        return fused


def pose_array(pose: Pose2) -> Floats:
    """Return a pose as x [m], y [m], yaw [rad], shape (3,)."""
    return np.array((pose.x_m, pose.y_m, pose.yaw_rad))
