"""Try a lidar: is what stands in front seen in front, and what stands left, left?

A person holds something before the robot, then beside it; what came nearer since is looked for in
the scans. A mirrored lidar draws mirrored maps, and one that is turned drives into what it sees.
"""

from __future__ import annotations

from math import atan2, cos, degrees, hypot, pi, sin
from typing import TYPE_CHECKING, Literal

from pons.robot.trial_parties import TrialRefusal

if TYPE_CHECKING:
    from collections.abc import Callable

    from wire import Scan
    from wire.lidar_config import LidarConfig

NEARER_M = 0.25
FEWEST_BEAMS = 3
NEAREST_M = 1.2
"""What was held up is at most so far away; what moves beyond it is not looked at."""
OFF_RAD = pi / 6

Where = Literal["front", "left"]
_EXPECTED: dict[Where, float] = {"front": 0.0, "left": pi / 2}


def try_lidar(
    config: LidarConfig, look: Callable[[], Scan], ask: Callable[[str], None]
) -> dict[Where, float]:
    """Have a person hold something up in front and at the left; return where it was seen [rad].

    Args:
        config: [lidar] of robot.toml.
        look: returns a scan of now.
        ask: asks for something to be done, and returns when it is.

    Raises:
        TrialRefusal: ``lidar_nothing``, ``lidar_mirrored`` or ``lidar_turned``; or what ``look``
            raises.
    """
    ask("lidar_clear")
    empty = look()
    ask("lidar_front")
    front_rad = _bearing(config, empty, look(), "front")
    ask("lidar_left")
    left_rad = _bearing(config, empty, look(), "left")
    seen = f"front seen at {degrees(front_rad):+.0f} deg, left at {degrees(left_rad):+.0f} deg"
    between_rad = _wrap(left_rad - front_rad)
    if abs(_wrap(between_rad + pi / 2)) < abs(_wrap(between_rad - pi / 2)):
        raise TrialRefusal("lidar_mirrored", f"{seen}; upside_down is {config.upside_down}")
    if abs(front_rad) > OFF_RAD or abs(_wrap(left_rad - pi / 2)) > OFF_RAD:
        yaw_rad = _wrap(config.yaw_rad - front_rad)
        raise TrialRefusal("lidar_turned", f"{seen}; lidar.yaw_rad may be {yaw_rad:.2f}")
    return {"front": front_rad, "left": left_rad}


def _bearing(config: LidarConfig, empty: Scan, now: Scan, where: Where) -> float:
    """Return in which direction from the middle of the robot something came nearer [rad]."""
    found = []
    for index, (before_m, after_m) in enumerate(zip(empty.ranges_m, now.ranges_m, strict=False)):
        if after_m is None or after_m > NEAREST_M:
            continue
        if before_m is not None and before_m - after_m < NEARER_M:
            continue
        angle_rad = now.angle_min_rad + index * now.angle_increment_rad + config.yaw_rad
        found.append((config.x_m + after_m * cos(angle_rad), config.y_m + after_m * sin(angle_rad)))
    if len(found) < FEWEST_BEAMS:
        raise TrialRefusal("lidar_nothing", f"{where}: {len(found)} beams are shorter than before")
    middle = sorted(found, key=lambda point: hypot(*point))[: max(FEWEST_BEAMS, len(found) // 2)]
    return atan2(sum(y for _, y in middle), sum(x for x, _ in middle))


def _wrap(angle_rad: float) -> float:
    return atan2(sin(angle_rad), cos(angle_rad))
