"""Make one wheel turn at its target speed: feed the motor's model forward, correct the rest.

Stands behind the limiter, whose memory keeps what was meant. Fed forward are the dead zone and the
motor's lag (a first-order motor told ``meant + T d(meant)/dt`` turns as meant); the same model says
what the encoder should show by now, and a PI law works on the difference alone. Knows one wheel;
no mode, no limits of the body, no time but the tick's length.

Laws: zero meant is zero told. A wheel is never told to turn against what is meant. The correction
is bounded; without feedback, or with one not to be believed, there is none. While stopping it may
only brake, nothing is integrated, and what is told never grows.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.state_motion import AT_REST, Wheel

if TYPE_CHECKING:
    from wire.robot import DriveConfig, RobotDescription

CREEP_RADPS = 0.01
"""Below it a dead zone's step would only make the wheel chatter: it is told to stand."""
CORRECTION_MPS = 0.10
"""At the rim; two thirds of the slack of row RUNAWAY. So much faster than meant, and no more, can a
lying encoder make a wheel; and the correction of an honest one can never look like a runaway."""
BEYOND_MPS, DOUBT_S = 0.03, 0.2
"""A wheel that for so long is so far off, beyond what may be corrected, is blocked, pushed,
reversed or misread: no motor like the one described. It is fed forward alone until it stands, and
the detectors of such faults see it as if nobody controlled it."""


def control_wheel(
    wheel: Wheel,
    meant_radps: float,
    by_mps2: float,
    reading_radps: float | None,
    dt_s: float,
    robot: RobotDescription,
    *,
    trusted: bool,
    stopping: bool,
) -> Wheel:
    """Return the wheel's control after this tick; its ``told_radps`` is the command.

    Args:
        wheel: this function's last answer, or AT_REST.
        meant_radps: what the limiter lets this wheel turn.
        by_mps2: how fast that changes, at the rim.
        reading_radps: what a state that came in this tick shows; None where none came.
        dt_s: the tick's length.
        robot: motor, wheel and limits as robot.toml describes them.
        trusted: readings are fresh and the drive has torque.
        stopping: the target is zero, whoever wants it: no correction may add speed.
    """
    if not (meant_radps >= CREEP_RADPS or meant_radps <= -CREEP_RADPS):
        return AT_REST  # all it had learnt is forgotten with it
    drive, radius_m = robot.drive, robot.base.wheel_radius_m
    most_radps = robot.limits.max_wheel_radps
    dead_zone, lag_s = drive.dead_zone_radps, min(drive.response_s, drive.lag_s)
    sign = 1.0 if meant_radps > 0.0 else -1.0
    if not wheel.told_radps * sign > 0.0:
        wheel = _begin_turning(reading_radps if trusted else None, most_radps)
    meant, expected = meant_radps * sign, wheel.expected_radps
    ahead = _clamp_speed(meant + lag_s * by_mps2 * sign / radius_m, most_radps)
    bound = min(dead_zone + drive.max_correction * meant, CORRECTION_MPS / radius_m)
    integral, push, doubt_s = wheel.integral, wheel.push, wheel.doubt_s
    if not trusted:
        integral = push = 0.0
    elif reading_radps is not None:
        off = (wheel.due_radps - reading_radps) * sign
        doubt_s = _doubt_s(doubt_s, off, bound + BEYOND_MPS / radius_m, dt_s)
        spare = most_radps - ahead - dead_zone
        had = 0.0 if stopping else integral
        integral = push = 0.0
        if doubt_s < DOUBT_S and bound > 0.0:
            integral, push = _correct(had, off / bound, spare / bound, dt_s, drive)
    if stopping:
        integral, push = 0.0, min(0.0, push)
        told = _clamp_speed(ahead + dead_zone + push * bound, meant + dead_zone)
        told = min(told, wheel.told_radps * sign)
    else:
        told = _clamp_speed(ahead + dead_zone + push * bound, most_radps)
    return Wheel(
        integral,
        push,
        expected + (ahead * sign - expected) * dt_s / (lag_s + dt_s),
        expected,
        told * sign,
        doubt_s,
    )


def _begin_turning(reading_radps: float | None, most_radps: float) -> Wheel:
    """Begin anew with a wheel that stood, or turned the other way: from its speed, if known."""
    if reading_radps is not None and -most_radps <= reading_radps <= most_radps:
        return Wheel(expected_radps=reading_radps, due_radps=reading_radps)
    return AT_REST


def _doubt_s(doubt_s: float, off: float, most: float, dt_s: float) -> float:
    """Return how long a wheel has been further off than any motor explains; DOUBT_S stays."""
    if doubt_s >= DOUBT_S:
        return doubt_s
    return 0.0 if abs(off) <= most else doubt_s + dt_s


def _correct(
    integral: float, off: float, spare: float, dt_s: float, drive: DriveConfig
) -> tuple[float, float]:
    """Return integral and whole correction after a reading that is ``off``, as shares of the bound.

    Where both together reach the bound, or the wheel's limit by using up what is ``spare``, the
    integral goes no further that way. What is no number brakes.
    """
    grown = integral + drive.ki_per_s * dt_s * off
    if not -1.0 <= grown <= 1.0:
        grown = 1.0 if grown > 1.0 else -1.0
    whole = drive.kp * off + grown
    if not -1.0 <= whole <= 1.0:
        whole = 1.0 if whole > 1.0 else -1.0
        if (grown - integral) * whole > 0.0:
            grown = integral
    if whole > spare and grown > integral:
        grown = integral
    return grown, whole


def _clamp_speed(speed: float, most: float) -> float:
    """Hold a speed between zero and the maximum; NaN counts as zero."""
    return speed if 0.0 <= speed <= most else most if speed > most else 0.0
