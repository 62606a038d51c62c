"""Turn what is wanted into the tick's one command. The only place where a command is born.

In ACTIVE and TELEOP the source in charge is followed, through caps, gate and limiter; in every
other mode the target is zero and the output ramps to it, or the torque is off.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core import external, gate, stick
from bridge.core.kinematics import feed_forward, saturate, wheels_of
from bridge.core.latch import cap
from bridge.core.limiter import LimiterState, Profile, shape
from bridge.core.modes import POWERED
from bridge.core.pursuit import follow
from bridge.core.transition import profile_of
from wire import STILL, DriveCommand, Mode, Twist2

if TYPE_CHECKING:
    from bridge.core.tick import Tick


def wanted(tick: Tick) -> tuple[Twist2, bool]:
    """Return what the source in charge asks for, and whether it is at its leg's end."""
    s = tick.s
    if s.mode is Mode.TELEOP:
        return stick.wanted(tick), False
    if s.mode is Mode.ACTIVE and s.source == "X":
        return external.wanted(tick), False
    if s.mode is Mode.ACTIVE:
        return followed(tick)
    return STILL, False


def followed(tick: Tick) -> tuple[Twist2, bool]:
    """Return what following the horizon asks for, and whether the robot is at its end."""
    s = tick.s
    if s.leg.path is None or tick.robot_in_map is None:
        return STILL, False
    robot = tick.config.robot
    answer = follow(
        s.motion.follow,
        s.leg.path,
        tick.robot_in_map,
        s.motion.limiter.sent,
        robot.base,
        robot.limits,
        robot.drive.lag_s,
    )
    s.motion.follow = answer.state
    return answer.target, answer.at_end


def shaped(tick: Tick, asked: Twist2) -> LimiterState:
    """Return what is sent: asked, then caps, gate and rates. Zero is the target unless moving."""
    s = tick.s
    robot = tick.config.robot
    powered = s.mode in POWERED or (s.mode is Mode.ESTOPPED and s.stopping is not None)
    s.motion.powered = powered
    if not powered:
        s.motion.free_m, s.motion.bound_by, s.motion.cap = None, "unpowered", 0.0
        return LimiterState()
    target, profile = STILL, Profile.STOP
    s.motion.cap, s.motion.bound_by = cap(tick)
    if tick.moving:
        target = gate.through(tick, saturate(asked, robot.base, robot.limits, s.motion.cap))
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


def command(tick: Tick) -> DriveCommand:
    """Write down the wheel speeds of what is sent, the motors' dead zone fed forward.

    Behind the limiter's memory, which keeps what was meant: rates and stopping stay true.
    """
    s = tick.s
    robot = tick.config.robot
    wheels = feed_forward(
        wheels_of(s.motion.limiter.sent, robot.base),
        robot.drive.dead_zone_radps,
        robot.limits.max_wheel_radps,
    )
    s.command_seq += 1
    return DriveCommand(
        boot=tick.config.boot,
        seq=s.command_seq,
        left_radps=wheels.left_radps,
        right_radps=wheels.right_radps,
        enable=s.motion.powered,
    )
