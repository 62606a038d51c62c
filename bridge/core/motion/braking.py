"""Say how fast a free length lets a motion be, and learn how late and hard this robot brakes.

Owns the one law that obstacles, the fence and the end of a path share, v t + v^2 / 2a = s, and what
a stop teaches: the wheels' path until standstill against the path that was sent. What is worse than
robot.toml says counts from that stop on; what is better counts only after many such stops in a row,
and never beyond robot.toml. Knows no geometry, no gate, no file, and no time but what it is told.

A stop is any ramp of what was sent down to standstill, STOPPING's or an ordinary one. Let m be the
measured speed of the faster rim when it begins, S the path sent and R the path rolled from there.

- A drive that is only late, be it a delay or a first order lag T, rolls R = S + m T.
- A drive that can't brake as told falls behind ever more: three quarters down it is three times as
  late as one quarter down, where one that is only late is as late as before. Its deceleration is
  then the slope between the two.

What lag and deceleration together leave unexplained counts as lag, so that the law with what was
learnt covers the path of every stop seen.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.geometry.kinematics import fastest_rim
from bridge.core.geometry.stopping import path_decel_mps2, speed_within
from bridge.core.state_motion import LEAST_SHARE, MOST_LAG_S, MOST_STOPS, Learnt, Ramp
from bridge.core.tick_context import STANDING_MPS

if TYPE_CHECKING:
    from bridge.core.state import BridgeState
    from bridge.core.tick_context import TickContext
    from wire import RobotDescription
    from wire.geometry import Twist2
    from wire.robot import Base, Limits

CREEP_MPS, CREEP_RADPS = 0.1, 0.3
"""What loses no clearance may move this fast beside or inside the margin."""
TURNING_MPS = 1e-4
"""Slower than this is turning in place, which sweeps nothing but the disc itself."""


def speed_scale(
    free_m: float,
    twist: Twist2,
    base: Base,
    limits: Limits,
    reaction: float,
    share: float = 1.0,
    *,
    touching: bool = False,
) -> float:
    """Return the factor in [0, 1] that lets a motion stop within its free length.

    Where something touches the margin already and the motion loses no clearance to it, it creeps.
    A speed below what counts as standing is none: the gate is then shut, not creeping.
    """
    v, w = abs(twist.v_mps), abs(twist.w_radps)
    creep = min(_ratio(CREEP_MPS, v), _ratio(CREEP_RADPS, w))
    if v < TURNING_MPS:
        return creep if touching else 1.0
    allowed = speed_within(free_m, path_decel_mps2(twist, base, limits, share), reaction)
    scale = _ratio(allowed, v)
    if touching:
        return min(creep, scale)
    return 0.0 if scale < 1.0 and allowed < STANDING_MPS else scale


def _ratio(limit: float, value: float) -> float:
    """Return the factor in [0, 1] that brings a value >= 0 down to its limit; no number, none."""
    if value <= limit:
        return 1.0
    return limit / value if value > limit else 0.0


BEGIN_MPS = 0.10
"""Slower stops are too short to tell: their path is that of a few encoder counts and one tick."""
OLD_S = 0.05
"""Without a reading for so long nothing is measured; a drive that reports seldom is given more."""
LONGEST_S = 5.0
HIGH, LOW = 0.75, 0.25
RISE_SHARE = 0.05
"""A ramp that rises in between by more than this is none to judge a slope by."""
SLOPE_S = 0.2
"""Between the two marks what was sent must take so long: in less, a lag looks like weak brakes."""
LATER = 2.0
"""So many times as late at the second mark as at the first: weak brakes 2.2 to 3, a lag of up to
0.3 s 1.8 at most (both computed for 0.4 to 0.5 m/s at 1 m/s2)."""
WEAKER = 0.85
"""Slopes nearer to what was sent are within what encoders and ticks can tell."""
LAG_GRAIN_S = 0.01
"""One tick: less is the loop's own grain."""
SHARE_GRAIN = 0.05
WILD_MPS = 0.15
"""A wheel so much faster than the ramp's beginning runs away; nothing about brakes is learnt."""
BETTER_STOPS = 50
"""A kind of stop that is bad once in 17 shows itself in 50 with 95 % (0.05^(1/50) = 0.94), so what
was learnt is let go only by 50 better ones in a row, each from nearly the speed that taught it."""
ALIKE = 0.8


def watch(tick: TickContext, before: BridgeState) -> None:
    """Follow the ramp under way by one tick; called once the command is decided."""
    s = tick.s
    ramp, now = s.ramp, s.motion.limiter.sent
    if ramp is None and now == before.motion.limiter.sent:
        return  # nearly always: it stands, or keeps its speed
    separation_m = tick.config.robot.base.wheel_separation_m
    sent = fastest_rim(now, separation_m)
    if ramp is None:
        was = fastest_rim(before.motion.limiter.sent, separation_m)
        if sent >= was or was < BEGIN_MPS or not before.motion.powered or not _measures(tick):
            return
        real = fastest_rim(before.odometry.measured, separation_m)
        ramp = Ramp(before.now_s, was, real, was, real)
    if not s.motion.powered:
        _take(tick, ramp, after_cut(s.learnt, ramp, tick.config.robot, tick.now_s))
    elif sent >= ramp.from_mps or not _measures(tick):
        s.ramp = None
    else:
        _follow(tick, ramp, sent)


def _measures(tick: TickContext) -> bool:
    received_s = tick.s.drive.received_s
    old_s = OLD_S + tick.config.robot.drive.unseen_s
    return received_s is not None and tick.now_s - received_s <= old_s and tick.dt_s <= OLD_S


def _follow(tick: TickContext, ramp: Ramp, sent: float) -> None:
    """Add one tick: the motion measured now is the effect of the last tick's command."""
    s = tick.s
    robot, dt_s = tick.config.robot, tick.dt_s
    real = fastest_rim(s.odometry.measured, robot.base.wheel_separation_m)
    if real > ramp.from_mps + WILD_MPS or tick.now_s - ramp.since_s > LONGEST_S:
        s.ramp = None
        return
    high, low = HIGH * ramp.from_mps, LOW * ramp.from_mps
    now_s = tick.now_s
    followed = Ramp(
        ramp.since_s,
        ramp.from_mps,
        ramp.real_from_mps,
        sent,
        real,
        ramp.sent_m + ramp.sent_mps * dt_s,
        ramp.real_m + real * dt_s,
        ramp.rise_mps + max(0.0, sent - ramp.sent_mps),
        _crossing_s(ramp.sent_high_s, ramp.sent_mps, sent, high, now_s, dt_s),
        _crossing_s(ramp.sent_low_s, ramp.sent_mps, sent, low, now_s, dt_s),
        _crossing_s(ramp.real_high_s, ramp.real_mps, real, high, now_s, dt_s),
        _crossing_s(ramp.real_low_s, ramp.real_mps, real, low, now_s, dt_s),
    )
    if sent == 0.0 and s.drive.still_since_s is not None:
        _take(tick, followed, after_stop(s.learnt, followed, robot))
    else:
        s.ramp = followed


def _crossing_s(
    at_s: float | None, before: float, after: float, mark: float, now_s: float, dt_s: float
) -> float | None:
    """Return when a speed first fell below a mark, between two ticks by proportion."""
    if at_s is not None or not after <= mark:
        return at_s
    fell = before - after
    return now_s - dt_s * (mark - after) / fell if fell > 0.0 else now_s


def after_stop(known: Learnt, ramp: Ramp, robot: RobotDescription) -> Learnt:
    """Return the brakes' estimate after a ramp has come to standstill.

    One sent harder than the robot brakes says nothing of how late it was, unless it took longer
    than all that is known explains.
    """
    moved = ramp.real_from_mps
    if moved < BEGIN_MPS:
        return known
    after = _with_slope(known, ramp, robot)
    braked_m = moved * moved / (2 * robot.limits.max_decel_mps2 * after.decel_share)
    more_s = (ramp.real_m - max(ramp.sent_m, braked_m)) / moved - robot.drive.lag_s
    if ramp.sent_m >= braked_m or more_s > after.lag_more_s:
        after = _with_lag(after, more_s, ramp.from_mps)
    return replace(after, stops=min(MOST_STOPS, after.stops + 1))


def after_cut(known: Learnt, ramp: Ramp, robot: RobotDescription, now_s: float) -> Learnt:
    """Return the brakes' estimate after a stop whose torque went away, judged until then.

    Such a stop was found too slow. Lag and the time that the jerk limit takes are left out of it.
    """
    late_s = robot.drive.lag_s + known.lag_more_s
    build_s = robot.limits.max_decel_mps2 / (2 * robot.limits.stop_jerk_mps3)
    braked_s = now_s - ramp.since_s - late_s - build_s
    told_mps, slowed_mps = ramp.from_mps - ramp.sent_mps, ramp.real_from_mps - ramp.real_mps
    if not (braked_s >= SLOPE_S and slowed_mps < WEAKER * told_mps):
        return known
    share = slowed_mps / (braked_s * robot.limits.max_decel_mps2)
    after = _with_weaker(known, share, ramp.from_mps) if share < WEAKER else known
    return replace(after, stops=min(MOST_STOPS, after.stops + 1))


def _with_slope(known: Learnt, ramp: Ramp, robot: RobotDescription) -> Learnt:
    """Return the brakes' estimate with the slope of a ramp taken into account.

    One that kept up with what was sent shows that the robot can brake so hard at least.
    """
    if ramp.sent_high_s is None or ramp.sent_low_s is None:
        return known
    if ramp.real_high_s is None or ramp.real_low_s is None:
        return known
    sent_s = ramp.sent_low_s - ramp.sent_high_s
    real_s = ramp.real_low_s - ramp.real_high_s
    smooth = ramp.rise_mps <= RISE_SHARE * ramp.from_mps
    if not (smooth and sent_s >= SLOPE_S and real_s > 0.0):
        return known
    share = (HIGH - LOW) * ramp.from_mps / (real_s * robot.limits.max_decel_mps2)
    if sent_s >= WEAKER * real_s:
        return _with_better(known, share / WEAKER, ramp.from_mps)
    late_s, later_s = ramp.real_high_s - ramp.sent_high_s, ramp.real_low_s - ramp.sent_low_s
    return _with_weaker(known, share, ramp.from_mps) if later_s >= LATER * late_s else known


def _take(tick: TickContext, ramp: Ramp, after: Learnt) -> None:
    """Add one stop's measurement to the estimate; report it where the gates' figures change."""
    s = tick.s
    before, s.learnt, s.ramp = s.learnt, after, None
    if after.lag_more_s != before.lag_more_s or after.decel_share != before.decel_share:
        robot = tick.config.robot
        tick.say(
            "braking_learnt",
            f"a stop from {ramp.real_from_mps:.2f} m/s took {ramp.real_m:.3f} m, sent "
            f"{ramp.sent_m:.3f} m: lag {robot.drive.lag_s + after.lag_more_s:.3f} s, "
            f"deceleration {robot.limits.max_decel_mps2 * after.decel_share:.2f} m/s2",
        )


def _with_weaker(known: Learnt, share: float, from_mps: float) -> Learnt:
    """Take brakes at their word that could not keep up."""
    share = max(LEAST_SHARE, share)
    if share < known.decel_share - SHARE_GRAIN:
        return replace(
            known, decel_share=share, share_at_mps=from_mps, share_better=0, share_worst=1.0
        )
    return replace(known, share_better=0, share_worst=1.0)


def _with_better(known: Learnt, share: float, from_mps: float) -> Learnt:
    """Count a stop that shows stronger brakes than are known; let many in a row be believed."""
    share = min(1.0, share)
    if known.decel_share >= 1.0 or share <= known.decel_share + SHARE_GRAIN:
        return known
    if from_mps < ALIKE * known.share_at_mps:
        return known
    count, worst = known.share_better + 1, min(known.share_worst, share)
    if count < BETTER_STOPS:
        return replace(known, share_better=count, share_worst=worst)
    return replace(known, decel_share=worst, share_better=0, share_worst=1.0)


def _with_lag(known: Learnt, more_s: float, from_mps: float) -> Learnt:
    more_s = min(MOST_LAG_S, max(0.0, more_s))
    if more_s > known.lag_more_s + LAG_GRAIN_S:
        return replace(known, lag_more_s=more_s, lag_at_mps=from_mps, lag_better=0, lag_worst_s=0.0)
    if known.lag_more_s <= 0.0:
        return known
    if more_s >= known.lag_more_s - LAG_GRAIN_S:
        return replace(known, lag_better=0, lag_worst_s=0.0)
    if from_mps < ALIKE * known.lag_at_mps:
        return known
    count, worst_s = known.lag_better + 1, max(known.lag_worst_s, more_s)
    if count < BETTER_STOPS:
        return replace(known, lag_better=count, lag_worst_s=worst_s)
    return replace(known, lag_more_s=worst_s, lag_better=0, lag_worst_s=0.0)
