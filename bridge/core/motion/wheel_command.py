"""Turn the request into the tick's one command. The only place where a command is born.

In ACTIVE and TELEOP the source in charge is followed, through caps, gate and limiter; in every
other mode the target is zero and the output ramps to it, or the torque is off.

Behind the limiter, whose memory keeps what was meant, each wheel is controlled by itself. Fed
forward are the dead zone and the motor's lag (a first-order motor told ``meant + T d(meant)/dt``
turns as meant); the same model says what the encoder should show by now, and a PI law works on the
difference alone. Zero meant is zero told. A wheel is never told to turn against what is meant. The
correction is bounded; without feedback, or with one not to be believed, there is none. While
stopping it may only brake, nothing is integrated, and what is told never grows.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.authority import external_velocity
from bridge.core.faults.fault_latch import cap
from bridge.core.geometry.kinematics import saturate, wheels_of
from bridge.core.modes import teleop
from bridge.core.modes.mode_logic import arrive
from bridge.core.motion import motion_gates
from bridge.core.motion.limiter import shape, tick_length
from bridge.core.motion.pursuit import carry_over, follow
from bridge.core.state_motion import AT_REST, NEW, LimiterState, Profile, Wheel, profile_of
from bridge.core.tick_context import POWERED, STANDING_MPS, STANDING_RADPS
from wire import STILL, DriveCommand, Mode, Twist2

if TYPE_CHECKING:
    from bridge.core.motion.pursuit import PursuitCommand
    from bridge.core.state_orders import LegMemory
    from bridge.core.tick_context import TickContext
    from wire.drive_config import DriveConfig
    from wire.robot import RobotDescription

STALE = "ENC_STALE.0"
"""The row that says that nothing is measured: no feedback, so feed-forward alone."""


def move(tick: TickContext) -> None:
    """Follow the source in charge, as far as caps, gates and limits let pass.

    What is asked is noted before the gates judge it, since they name it where they shut the way.
    """
    motion = tick.s.motion
    asked, at_end = requested_twist(tick)
    arrive(tick, at_end=at_end)
    if tick.s.gate.blocked:
        motion_gates.reconsider(tick, _wish(tick))
    motion.turns_out = False
    if tick.s.watch.blind_way:
        wish = asked if tick.is_moving else _wish(tick)
        turns = abs(wish.v_mps) < STANDING_MPS and abs(wish.w_radps) >= STANDING_RADPS
        motion.turns_out = turns
    motion.asked = asked if tick.is_moving else STILL
    motion.limiter = limit(tick, motion.asked)


def _wish(tick: TickContext) -> Twist2:
    """Return what the owner of a robot that is held asks now: a fresh velocity, or the follower's.

    What the follower would remember of it is not kept: a held robot stands and follows nothing.
    """
    owner = tick.s.ownership.owner
    if owner is not None and owner.kind == "external":
        fresh = external_velocity.asks_to_move(tick)
        return external_velocity.requested_twist(tick) if fresh else STILL
    answer = follow_horizon(tick)
    return STILL if answer is None else answer.target


def requested_twist(tick: TickContext) -> tuple[Twist2, bool]:
    """Return the twist that the source in charge asks for, and whether its leg has ended."""
    s = tick.s
    if s.mode is Mode.TELEOP:
        return teleop.requested_twist(tick), False
    if s.mode is not Mode.ACTIVE:
        return STILL, False
    if s.source == "X":
        return external_velocity.requested_twist(tick), False
    answer = follow_horizon(tick)
    if answer is None:
        return STILL, False
    s.motion.follow = answer.state
    return answer.target, answer.at_end


def follow_horizon(tick: TickContext) -> PursuitCommand | None:
    """Return the twist that the horizon asks for; None without a horizon or a pose in ``map``."""
    s = tick.s
    if s.leg.path is None or tick.robot_in_map is None:
        return None
    robot = tick.config.robot
    return follow(
        s.motion.follow,
        s.leg.path,
        tick.robot_in_map,
        s.motion.limiter.sent,
        robot.base,
        robot.limits,
        robot.drive.lag_s,
    )


def take_horizon(tick: TickContext, before: LegMemory) -> None:
    """Begin to follow a horizon that was just taken, or go on where the one before it was left.

    Within a leg each horizon is the same way cut anew: what was learnt on it stays, and at its
    end the place that was settled stays settled.

    Args:
        tick: the tick in the making.
        before: the leg as it was before the waypoints were heard.
    """
    leg, motion = tick.s.leg, tick.s.motion
    if leg.horizon is None or leg.horizon is before.horizon:
        return  # refused: nothing was taken
    same_leg = before.mission == leg.mission and before.leg == leg.leg
    if before.horizon is None or not same_leg:
        motion.follow = NEW
    elif leg.goal is not None and leg.goal == before.goal:
        motion.follow = carry_over(motion.follow)
    else:
        motion.follow = replace(NEW, turning=motion.follow.turning)


def forget_after_gap(tick: TickContext) -> None:
    """Begin at zero after a gap in which the drive has timed out: it stands, or is coming to.

    A loop that was frozen for seconds would otherwise ramp down a speed that nobody has any more.
    """
    if not tick.dt_s <= tick.config.robot.drive.dead_man_s:
        tick.s.motion.limiter = LimiterState()
        tick.s.motion.left = tick.s.motion.right = AT_REST


def limit(tick: TickContext, asked: Twist2) -> LimiterState:
    """Return the limited twist: request, then caps, gate and rates. Zero unless moving."""
    s = tick.s
    robot = tick.config.robot
    powered = s.mode in POWERED or (s.mode is Mode.ESTOPPED and s.stopping is not None)
    s.motion.powered = powered
    if not powered:
        s.motion.free_m, s.motion.bound_by, s.motion.cap = None, "unpowered", 0.0
        return LimiterState()
    target, profile = STILL, Profile.STOP
    s.motion.cap, s.motion.bound_by = cap(tick)
    if tick.is_moving:
        target = motion_gates.apply(tick, saturate(asked, robot.base, robot.limits, s.motion.cap))
        profile = Profile.NORMAL
    elif s.stopping is not None:
        profile = profile_of(s.stopping.action)
    return shape(
        target,
        s.motion.limiter,
        robot.base,
        robot.limits,
        tick.dt_s,
        period_s=tick.config.period_s,
        profile=profile,
        room_m=tick.room_m,
    )


def command(tick: TickContext) -> DriveCommand:
    """Set both wheels' speeds so that they turn as the sent twist means.

    Behind the limiter's memory, which keeps what was meant: rates and stopping stay true.
    """
    s = tick.s
    motion = s.motion
    if motion.powered:
        _control(tick)
    else:
        motion.left = motion.right = AT_REST
    s.command_seq += 1
    return DriveCommand(
        boot=tick.config.boot,
        seq=s.command_seq,
        left_radps=motion.left.told_radps,
        right_radps=motion.right.told_radps,
        enable=motion.powered,
    )


def _control(tick: TickContext) -> None:
    """Take both wheels one tick further. Readings of a drive that is not to be trusted are none."""
    s, robot = tick.s, tick.config.robot
    motion, drive, report = s.motion, s.drive, s.drive.newest
    meant = wheels_of(motion.limiter.sent, robot.base)
    dt_s = tick_length(tick.dt_s, tick.config.period_s)
    trusted, left_radps, right_radps = False, None, None
    if (
        report is not None
        and report.enabled
        and report.timed_out is not True
        and STALE not in s.rows
    ):
        trusted = drive.reborn_s != tick.now_s
        if drive.received_s == tick.now_s:
            left_radps, right_radps = report.left_radps, report.right_radps
    moving, limiter = tick.is_moving, motion.limiter
    motion.left = control_wheel(
        motion.left,
        meant.left_radps,
        limiter.left_mps2,
        left_radps,
        dt_s,
        robot,
        trusted=trusted,
        stopping=not moving,
    )
    motion.right = control_wheel(
        motion.right,
        meant.right_radps,
        limiter.right_mps2,
        right_radps,
        dt_s,
        robot,
        trusted=trusted,
        stopping=not moving,
    )


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
