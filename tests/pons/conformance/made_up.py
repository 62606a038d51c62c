"""Make up records of a robot, as a judge would have seen them."""

from __future__ import annotations

from collections.abc import Callable

from pons.conformance.bounds import MotionBounds
from pons.conformance.record import Command, DriveRecord, Truth, WheelSample, Word
from wire import RobotDescription

BOUNDS = MotionBounds.of(RobotDescription())
PERIOD_S = 0.01
OFFSET = 40
"""Ticks of a self test in which no command was sent."""


def record(
    seconds: float,
    left_mps: Callable[[float], float],
    right_mps: Callable[[float], float] | None = None,
    *,
    mode: Callable[[float], str] = lambda _s: "ACTIVE",
    told: Callable[[float], float] | None = None,
    rests: bool = True,
) -> DriveRecord:
    """Return what a judge sees of wheels that turn so; time 0 is the first command.

    Args:
        seconds: how long.
        left_mps: the left rim's real speed over time.
        right_mps: the right rim's; like the left one's if None.
        mode: what the bridge says over time.
        told: what both wheels are told; the real speeds if None.
        rests: the truth shows the robot as the wheels turn; False: it moves all the time.
    """
    made, right_mps = DriveRecord(), right_mps or left_mps
    radius_m, dead = BOUNDS.wheel_radius_m, BOUNDS.dead_zone_radps
    turned = [0.0, 0.0]
    for tick in range(round(seconds / PERIOD_S)):
        at_s = tick * PERIOD_S
        rims = (left_mps(at_s), right_mps(at_s))
        asked = (told(at_s), told(at_s)) if told is not None else rims
        wheels = [rim / radius_m + (dead if rim > 0 else -dead if rim < 0 else 0) for rim in asked]
        turned = [
            angle + rim / radius_m * PERIOD_S for angle, rim in zip(turned, rims, strict=True)
        ]
        made.commands.append(Command(at_s, tick, wheels[0], wheels[1], enabled=True))
        made.wheels.append(WheelSample(at_s, at_s, tick, turned[0], turned[1], torque=True))
        v = sum(rims) / 2 if rests else 0.3
        made.truths.append(Truth(at_s, v, 0.0, contacts=0))
        if tick % 5 == 0:
            said = mode(at_s)
            moves = said in {"ACTIVE", "TELEOP"}
            made.words.append(Word(at_s, at_s, "boot", tick + OFFSET, 0, said, moves))
            made.learn()
    return made


def ramp(from_s: float, v_mps: float, rate_mps2: float) -> Callable[[float], float]:
    """Return a speed that goes to zero from a moment on."""
    return lambda at_s: max(0.0, v_mps - rate_mps2 * max(0.0, at_s - from_s))
