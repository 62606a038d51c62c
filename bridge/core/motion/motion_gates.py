"""Pass the part of a command that lidar, fence and bumpers leave, by direction.

The gate scales, down to nothing towards the trouble; what loses no clearance passes slowly. Shut
for 0.5 s while waypoints or external velocities move the robot it is ``blocked``: a HOLD2 that ends
when the arc that the follower or the external brain asks for has been free in five scans.

FENCE: a motion whose stop would touch the margin is scaled down along its curve; one that leads
away from the fence passes at a creep, so that a robot beside it or outside can come back in.
CONTACT: what goes on into a bumper's contact or towards a cliff is blocked; what leads away passes
slowly, and so does a turn in place, which sweeps nothing but the disc itself. Bumpers sit front and
rear, the cliff sensor in front; one that is not told counts as pressed.
"""

from __future__ import annotations

from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING

from bridge.core.geometry.kinematics import along_arc, saturate, scale_twist
from bridge.core.geometry.stopping import reaction_s, stop_length_m
from bridge.core.motion.braking import CREEP_MPS, CREEP_RADPS, TURNING_MPS
from bridge.core.motion.free_distance import free_length
from bridge.core.motion.obstacle_gate import obstacle_gate
from bridge.core.sensing.sensor_update import FREE_M, look_m
from bridge.core.state_motion import Gate
from bridge.core.tick_context import STANDING_MPS, STANDING_RADPS, fill, sensor_age_s
from wire import STILL, Mode, Twist2, margins, wrap

if TYPE_CHECKING:
    from bridge.core.geometry.fence import FenceGrid
    from bridge.core.motion.free_distance import FreeLength
    from bridge.core.tick_context import TickContext
    from wire import DriveState
    from wire.geometry import Pose2
    from wire.robot import Base, Limits

SHUT_S = 0.5
TURNED_RAD = 0.05
"""Progress by turning, as the row STUCK counts it; a creep of 0.3 rad/s takes a quarter second."""
FREE_SCANS = 5
TELEOP_FENCE_MPS = 0.2
POSE_S = 0.1
"""Localization's period: the pose moved by odometry is good, its correction may be so late."""
UNKNOWN_MPS = 0.2
"""Where fewer than half of the beams came back, silence may be a mirror or a black sofa."""


def apply(tick: TickContext, twist: Twist2) -> Twist2:
    """Return the gated command; remember how free its way is, and the room to stop in."""
    s = tick.s
    motion, picture = s.motion, s.lidar.picture
    motion.free_m = tick.room_m = None
    if twist == STILL:
        _note(tick, "")
        return twist
    if picture is None:
        motion.bound_by = "no_scan"
        _note(tick, "obstacle")
        return STILL
    way = obstacle_gate(
        picture,
        s.odometry.base_in_odom,
        twist,
        s.odometry.measured,
        scan_age_s(tick),
        tick.config.robot,
        s.learnt.in_force(),
    )
    motion.free_m, tick.room_m = way.free_m, way.room_m
    if way.scale < 1.0:
        motion.bound_by = "obstacle"
    passed = way.twist
    fastest = abs(passed.v_mps)
    if not way.known and fastest > UNKNOWN_MPS:
        motion.bound_by = "unseen"
        passed = scale_twist(passed, UNKNOWN_MPS / fastest)
    inside = _inside_fence(tick, passed)
    felt = contact_gate(s.drive.newest, inside)
    if felt != inside:
        motion.bound_by = "contact"
    _note(tick, _shut_by(twist, passed, inside, felt))
    return felt


def _shut_by(asked: Twist2, seen: Twist2, inside: Twist2, felt: Twist2) -> str:
    """Name the first gate that leaves nothing of the way asked for; "" where some passes."""
    for name, passed in (("obstacle", seen), ("fence", inside), ("contact", felt)):
        if _shut(asked, passed):
            return name
    return ""


def _shut(asked: Twist2, passed: Twist2) -> bool:
    """Tell whether nothing of the way asked for passes.

    Where a way is asked for, the turn that passes beside it is no way: it would swing to and fro
    before a closed door for ever.
    """
    if abs(asked.v_mps) >= STANDING_MPS:
        return abs(passed.v_mps) < STANDING_MPS
    return abs(asked.w_radps) >= STANDING_RADPS > abs(passed.w_radps)


def _inside_fence(tick: TickContext, twist: Twist2) -> Twist2:
    """Scale a motion so that it stops clear of the fence; a hand on the stick may cross, slowly."""
    fence, here = tick.fence, tick.robot_in_map
    if fence is None:
        return twist
    if here is None:  # where the fence is cannot be told: no row is trusted to have held already
        if tick.s.mode is Mode.TELEOP:
            return twist  # POSE_LOST caps it at the speed at which a hand may cross
        tick.s.motion.bound_by = "pose_lost"
        return STILL
    if tick.s.mode is Mode.TELEOP or tick.s.watch.outside:
        _tell_crossing(tick, fence.margin_m(here.x_m, here.y_m))
    robot = tick.config.robot
    learnt = tick.s.learnt
    lag_s = robot.drive.late_s + learnt.lag_more_s
    reaction = reaction_s(0.0, POSE_S, lag_s, robot.limits)
    share = learnt.decel_share
    scale = fence_scale(fence, here, twist, robot.base, robot.limits, reaction, share)
    if scale >= 1.0:
        return twist
    tick.s.motion.bound_by = "fence"
    if tick.s.mode is Mode.TELEOP:
        scale = max(scale, min(1.0, TELEOP_FENCE_MPS / max(abs(twist.v_mps), 1e-9)))
    return scale_twist(twist, scale)


def _tell_crossing(tick: TickContext, margin_m: float) -> None:
    """Say once that a hand moves the robot outside the fence.

    Said anew only once it has been inside by the margin: the pose's noise is far smaller.
    """
    watch = tick.s.watch
    if watch.outside:
        watch.outside = not margin_m >= FENCE_MARGIN_M
    elif tick.s.mode is Mode.TELEOP and not margin_m >= 0.0:
        watch.outside = True
        tick.say("outside_fence", "a hand on the stick moves the robot outside the fence")


def forget_block(tick: TickContext) -> None:
    """Forget a blocked way once nothing is granted: the next mission asks for another way."""
    if tick.s.gate.blocked and tick.s.grants.mission is None:
        tick.s.gate = Gate()


def scan_age_s(tick: TickContext) -> float:
    """Return the age of the newest scan [s], as its row judges it."""
    scan, received_s = tick.s.lidar.newest, tick.s.lidar.received_s
    if scan is None or received_s is None:
        return 0.0
    same_host = tick.inbox.sensors_same_host
    return max(0.0, sensor_age_s(tick.now_s, received_s, scan.stamp_s, same_host=same_host))


def look(tick: TickContext, twist: Twist2) -> FreeLength | None:
    """Return how far the arc of a motion is free, as far as one looks; None where no scan says."""
    picture, robot = tick.s.lidar.picture, tick.config.robot
    if picture is None:
        return None
    here = tick.s.odometry.base_in_odom
    reach_m = look_m(robot, tick.s.learnt.in_force())
    return free_length(picture, here, twist, robot.base.radius_m, reach_m)


def reconsider(tick: TickContext, asked: Twist2) -> None:
    """Judge a blocked robot once per scan, on the arc that its owner asks, by all three gates."""
    gate, scan = tick.s.gate, tick.s.lidar.newest
    if not gate.blocked or scan is None or scan.seq == gate.judged_scan:
        return
    if tick.s.mode not in {Mode.HOLD, Mode.STOPPING, Mode.ACTIVE}:
        return
    free = look(tick, asked) if asked != STILL else None
    clear = free is not None and free.s_m >= FREE_M
    clear = clear and touched_input(tick.s.drive.newest, asked.v_mps) is None
    robot = tick.config.robot
    wish = saturate(asked, robot.base, robot.limits)
    clear = clear and not _shut(wish, _inside_fence(tick, wish))
    count = gate.free_scans + 1 if clear else 0
    if count >= FREE_SCANS:
        tick.s.gate = Gate()
        tick.say("unblocked")
    else:
        tick.s.gate = replace(gate, free_scans=count, judged_scan=scan.seq)


def _note(tick: TickContext, shut_by: str) -> None:
    """Call it blocked after 0.5 s; a robot that turns away meanwhile is given the time anew.

    The follower's wish sways with the pose's noise, so a turn to and fro is no turning away, and a
    tick in which something passes does not open a way.
    """
    s = tick.s
    gate, yaw_rad, shut = s.gate, s.odometry.base_in_odom.yaw_rad, bool(shut_by)
    if gate.shut_s == 0.0 and gate.shut_since_s is None and not shut:
        return
    turned = abs(wrap(yaw_rad - gate.shut_yaw_rad)) >= TURNED_RAD
    begins = gate.shut_s == 0.0 or (shut and turned)
    since_s = gate.shut_since_s if gate.shut_since_s is not None else tick.now_s
    gate = replace(
        gate,
        shut_since_s=since_s if shut else None,
        shut_s=fill(0.0 if begins else gate.shut_s, tick.dt_s, SHUT_S, dirty=shut),
        shut_yaw_rad=yaw_rad if begins else gate.shut_yaw_rad,
    )
    if shut and s.mode is Mode.ACTIVE and not gate.blocked and gate.shut_s >= SHUT_S:
        gate = Gate(blocked=True, by=shut_by)
        tick.say("blocked", f"by {shut_by}, asked {s.motion.asked.v_mps:.2f} m/s")
    s.gate = gate


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


def touched_input(state: DriveState | None, v_mps: float) -> str | None:
    """Name the input that forbids going on in this direction; None if none does."""
    if state is None:
        return None
    if v_mps > 0.0:
        if state.bumper_front is not False:
            return "bumper_front"
        return "cliff" if state.cliff is not False else None
    return "bumper_rear" if v_mps < 0.0 and state.bumper_rear is not False else None


def contact_gate(state: DriveState | None, twist: Twist2) -> Twist2:
    """Return the part of a motion that passes while the drive state shows a contact or a cliff."""
    if state is None or state.bumper_front is state.bumper_rear is state.cliff is False:
        return twist
    if touched_input(state, twist.v_mps) is not None:
        return Twist2(0.0, min(max(twist.w_radps, -CREEP_RADPS), CREEP_RADPS))
    v, w = abs(twist.v_mps), abs(twist.w_radps)
    share = min(1.0, CREEP_MPS / v if v > 0.0 else 1.0, CREEP_RADPS / w if w > 0.0 else 1.0)
    return scale_twist(twist, share)
