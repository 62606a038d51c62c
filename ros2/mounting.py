"""Find where a sensor sits on the robot, by what /tf_static says. Pure.

A chain of transforms leads from the sensor's frame up to the base's; base_link is preferred to
base_footprint, which lies below it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, hypot
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ros2.robot_words import FrameWords

BASES = ("base_link", "base_footprint")
LEVEL = 0.985
"""Cosine of the tilt that a planar lidar may have, 10 degrees."""
Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
"""x, y, z, w."""


class NoMounting(Exception):
    """Raised where the frames do not say where a sensor sits; says what they say."""


@dataclass(frozen=True, slots=True)
class SensorMounting:
    """Hold where a planar sensor sits: its place and heading on the robot."""

    base: str
    x_m: float
    y_m: float
    z_m: float
    yaw_rad: float


def find_mounting(frames: Iterable[FrameWords], frame: str) -> SensorMounting:
    """Return where ``frame`` sits on the robot.

    Raises:
        NoMounting: no chain of transforms leads to a base, or it hangs head down or tilted.
    """
    parents = {one.child.lstrip("/"): one for one in frames}
    at: Vector = (0.0, 0.0, 0.0)
    turned: Quaternion = (0.0, 0.0, 0.0, 1.0)
    name = frame.lstrip("/")
    passed, found = [name], None
    while name != BASES[0] and name in parents and len(passed) <= len(parents):
        if name in BASES:
            found = _planar(name, at, turned)
        step = parents[name]
        if not abs(hypot(*step.turned) - 1.0) < 0.05:
            raise NoMounting(f"the rotation of {name} in {step.parent} is none")
        at = _add(step.at_m, _rotate(step.turned, at))
        turned = _multiply(step.turned, turned)
        name = step.parent.lstrip("/")
        passed.append(name)
    if name in BASES:
        return _planar(name, at, turned)
    if found is not None:
        return found
    raise NoMounting(f"{' > '.join(passed)} leads to none of {', '.join(BASES)}")


def _planar(base: str, at: Vector, turned: Quaternion) -> SensorMounting:
    ahead, up = _rotate(turned, (1.0, 0.0, 0.0)), _rotate(turned, (0.0, 0.0, 1.0))
    if up[2] < -LEVEL:
        raise NoMounting(
            "it hangs head down: have its driver turn the scan (inverted), and its frame"
        )
    if up[2] < LEVEL:
        raise NoMounting(
            f"it is tilted: its z axis points to ({up[0]:.2f}, {up[1]:.2f}, {up[2]:.2f})"
        )
    return SensorMounting(base, *at, atan2(ahead[1], ahead[0]))


def _add(a: Vector, b: Vector) -> Vector:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def _multiply(a: Quaternion, b: Quaternion) -> Quaternion:
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def _rotate(turned: Quaternion, vector: Vector) -> Vector:
    conjugate = (-turned[0], -turned[1], -turned[2], turned[3])
    x, y, z, _ = _multiply(_multiply(turned, (*vector, 0.0)), conjugate)
    return x, y, z
