"""Keep the way of a stop away from the fence: how much of a motion the fence lets pass.

Owns the FENCE gate. A motion whose stop would touch the margin is scaled down along its curve;
one that leads away from the fence passes at a creep, so that a robot beside it or outside can come
back in. Knows no lidar, no modes.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from bridge.core.geometry.kinematics import along_arc
from bridge.core.motion.braking import STANDING_MPS, TURNING_MPS, stop_length_m
from wire import margins

if TYPE_CHECKING:
    from bridge.core.geometry.fence import FenceGrid
    from wire.geometry import Pose2, Twist2
    from wire.robot import Base, Limits

FENCE_MARGIN_M = margins.FENCE_MARGIN_M
INWARD_MPS = 0.15
_STEP_M = 0.05
_EDGE_M = 1e-6
_LOOKS = 100
"""So many reach 5 m along a wall at the very margin, 85 m where nothing is near."""
_HALVINGS = 5


def fence_scale(
    fence: FenceGrid,
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
    return _largest(fence, base_in_map, twist, length, reaction, here)


def _largest(
    fence: FenceGrid,
    base_in_map: Pose2,
    twist: Twist2,
    whole: float,
    reaction: float,
    here: float,
) -> float:
    """Find by halving the largest factor whose stop ends on the clear way; 0 if it is no speed."""
    speed = abs(twist.v_mps)
    clear = _clear_m(fence, base_in_map, twist, whole, here)
    if clear >= whole:
        return 1.0
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        length = speed * middle * reaction + (whole - speed * reaction) * middle * middle
        if length <= clear:
            low = middle
        else:
            high = middle
    return low if low * speed >= STANDING_MPS else 0.0


def _clear_m(fence: FenceGrid, start: Pose2, twist: Twist2, whole: float, here: float) -> float:
    """Return how much of a motion's way keeps the margin all along [m], at most ``whole``.

    Distance changes by no more than the way gone, so that what is left beyond the margin may be
    skipped; no skip is so short that it takes for ever, and none so long that it steps over a post:
    between two places 5 cm apart that keep the margin it is less by 2.5 cm at most.
    """
    clear, margin = 0.0, here
    if not (whole < inf and here >= FENCE_MARGIN_M):
        return 0.0
    for _ in range(_LOOKS):
        gone = min(whole, clear + max(margin - FENCE_MARGIN_M, _STEP_M))
        margin = _margin_m(fence, start, twist, gone)
        if not margin >= FENCE_MARGIN_M:
            return _edge_m(fence, start, twist, clear, gone)
        if gone >= whole:
            return whole
        clear = gone
    return clear  # what is further off has not been looked at


def _edge_m(fence: FenceGrid, start: Pose2, twist: Twist2, clear: float, shut: float) -> float:
    """Return where the margin is left between a clear and a shut place, to a micrometre [m]."""
    while shut - clear > _EDGE_M:
        middle = (clear + shut) / 2
        if _margin_m(fence, start, twist, middle) >= FENCE_MARGIN_M:
            clear = middle
        else:
            shut = middle
    return clear


def _margin_m(fence: FenceGrid, start: Pose2, twist: Twist2, gone: float) -> float:
    """Return the distance to the fence after a way along a motion's arc [m]."""
    flow = twist.w_radps / abs(twist.v_mps)
    place = along_arc(start, gone if twist.v_mps > 0.0 else -gone, flow * gone)
    return fence.margin_m(place.x_m, place.y_m)


def _inward(fence: FenceGrid, start: Pose2, twist: Twist2, here: float) -> bool:
    """Tell whether going on gains distance from the fence, or comes in from outside."""
    return _margin_m(fence, start, twist, _STEP_M) > here
