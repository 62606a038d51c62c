"""Keep the stop pose away from the fence: how much of a motion the fence lets pass.

Owns the FENCE gate. A motion whose stop would end within the margin is scaled down along its curve;
one that leads away from the fence passes at a creep, so that a robot beside it or outside can come
back in. Knows no lidar, no modes.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from bridge.core.braking import STANDING_MPS, TURNING_MPS, stop_length_m
from bridge.core.odometry import along_arc

if TYPE_CHECKING:
    from bridge.core.fence import Fence
    from wire.geometry import Pose2, Twist2
    from wire.robot import Base, Limits

FENCE_MARGIN_M = 0.15
INWARD_MPS = 0.15
_STEP_M = 0.05
_HALVINGS = 5


def fence_scale(
    fence: Fence,
    base_in_map: Pose2,
    twist: Twist2,
    base: Base,
    limits: Limits,
    reaction: float,
    share: float = 1.0,
) -> float:
    """Return the factor in [0, 1] on a motion so that it stops clear of the fence.

    Args:
        fence: bounds the robot's centre.
        base_in_map: where the robot is, to the best of knowledge.
        twist: what is asked; turning in place moves no centre and always passes.
        base: wheel geometry.
        limits: robot.toml's bounds.
        reaction: how long the robot goes on before it slows [s]: age of the pose, lag, jerk.
        share: of robot.toml's deceleration, what the robot has shown to reach.
    """
    speed = abs(twist.v_mps)
    if not (speed < inf and abs(twist.w_radps) < inf):
        return 0.0
    if speed < TURNING_MPS:
        return 1.0
    length = stop_length_m(twist, base, limits, reaction, share)
    here = fence.margin_m(base_in_map.x_m, base_in_map.y_m)
    if here >= FENCE_MARGIN_M + length:
        return 1.0  # distance changes by no more than the way gone
    if here < FENCE_MARGIN_M and _inward(fence, base_in_map, twist, here):
        return min(1.0, INWARD_MPS / speed)
    return _largest(fence, base_in_map, twist, length, reaction)


def _largest(
    fence: Fence,
    base_in_map: Pose2,
    twist: Twist2,
    whole: float,
    reaction: float,
) -> float:
    """Find by halving the largest factor whose stop pose keeps the margin; 0 if it is no speed."""
    low, high = 0.0, 1.0
    flow = twist.w_radps / abs(twist.v_mps)
    if _clear(fence, base_in_map, twist.v_mps, flow, whole):
        return 1.0
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        speed = abs(twist.v_mps) * middle
        length = speed * reaction + (whole - abs(twist.v_mps) * reaction) * middle * middle
        if _clear(fence, base_in_map, twist.v_mps, flow, length):
            low = middle
        else:
            high = middle
    return low if low * abs(twist.v_mps) >= STANDING_MPS else 0.0


def _clear(fence: Fence, start: Pose2, direction: float, flow: float, length: float) -> bool:
    """Tell whether a stop of this length, and half way to it, keeps the margin."""
    for part in (length / 2, length):
        place = along_arc(start, part if direction > 0.0 else -part, flow * part)
        if not fence.margin_m(place.x_m, place.y_m) >= FENCE_MARGIN_M:
            return False
    return True


def _inward(fence: Fence, start: Pose2, twist: Twist2, here: float) -> bool:
    """Tell whether going on gains distance from the fence, or comes in from outside."""
    flow = twist.w_radps / abs(twist.v_mps)
    step = _STEP_M if twist.v_mps > 0.0 else -_STEP_M
    place = along_arc(start, step, flow * _STEP_M)
    return fence.margin_m(place.x_m, place.y_m) > here
