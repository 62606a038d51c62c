"""Warm up a tick's code before the first one: imports, validators, serialisers, the step.

What is made here goes nowhere: no key is published, no state is kept. Without it the first scan or
the first stop pays for what Python and pydantic put off, milliseconds late.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core import (
    ArrivedAt,
    Inbox,
    LoopFacts,
    OperatorArrival,
    RejectedAt,
    initial,
    step,
)
from bridge.core.inbox import FenceArrival, FenceDone
from bridge.recording.encode import warm_frames
from wire import (
    IDENTITY,
    VIRTUAL_KEY,
    DecodeFailure,
    DriveState,
    EstopLink,
    FenceRequest,
    Grant,
    Heartbeat,
    Hello,
    Imu,
    Localization,
    OpRequest,
    Scan,
    Stop,
    Velocity,
    Waypoint,
    Waypoints,
    authentic,
    authentic_fence,
    decode,
    encode,
    sign,
    sign_fence,
)
from wire.bounded_types import PROTOCOL
from wire.keys import (
    ARM,
    DRIVE_STATE,
    ESTOP_LINK,
    FENCE,
    GRANT,
    HEARTBEAT,
    HELLO,
    IMU,
    LOCALIZATION,
    SCAN,
    STOP,
    TELEOP,
    WAYPOINTS,
)

if TYPE_CHECKING:
    from typing import TypeVar

    from bridge.core import CoreConfig
    from wire.base import Record
    from wire.keys import Key

    M = TypeVar("M", bound=Record)

TICKS = 200
_BEAMS = 360
_NAME = "warmup"
_CHANCE = "0" * 16


def warm_up(config: CoreConfig, now_s: float) -> int:
    """Run the core on a made-up world for TICKS ticks; return how many bytes were serialised."""
    state = initial(config, now_s)
    size = 0
    for count in range(TICKS):
        now_s += config.period_s
        inbox = _inbox(config, count, now_s, state.command_seq)
        decision = step(config, state, inbox, now_s)
        frames = warm_frames(config, state, inbox, now_s, decision, whole=count % 100 == 99)
        said = (decision.command, decision.status, decision.odometry, *decision.events)
        size += len(frames) + sum(len(encode(word)) for word in said if word is not None)
        state = decision.state
    return size


def _inbox(config: CoreConfig, count: int, now_s: float, echo_seq: int) -> Inbox:
    """Make one tick's inbox, each message through the codec."""
    tenth = count % 10 == 0
    drive = DriveState(
        boot_id=_NAME, seq=count, stamp_s=now_s, echo_boot=config.boot, echo_seq=echo_seq,
        enabled=False, timed_out=False, left_rad=0.0, right_rad=0.0, left_radps=0.0,
        right_radps=0.0, estop_pressed=False, bumper_front=False, bumper_rear=False, cliff=False,
    )  # fmt: skip
    imu = Imu(
        boot_id=_NAME, seq=count, stamp_s=now_s, yaw_rate_radps=0.0, accel_x_mps2=0.0,
        accel_y_mps2=0.0,
    )  # fmt: skip
    always = Inbox(
        drive=(_through_codec(DRIVE_STATE, drive),),
        imu=_through_codec(IMU, imu),
        loop=LoopFacts(late_s=1e-4),
        recorder_ok=True,
        chance=_CHANCE,
    )
    return _lively(config, count, now_s, always) if tenth else always


def _lively(config: CoreConfig, count: int, now_s: float, base: Inbox) -> Inbox:
    """Return an inbox with a message of every kind."""
    proof = sign(VIRTUAL_KEY, "arm", config.robot.id, _NAME, _NAME)
    arm = _through_codec(ARM, OpRequest(id=_NAME, source=_NAME, proof=proof))
    fits = authentic(VIRTUAL_KEY, "arm", config.robot.id, proof, _NAME)
    bad = decode(WAYPOINTS, b'{"points":[')
    return replace(
        _orders(config, count),
        stops=(_through_codec(STOP, Stop(id=_NAME, source=_NAME)),) if count % 50 == 0 else (),
        ops=(OperatorArrival("arm", arm, fits),),
        localization=_through_codec(
            LOCALIZATION,
            Localization(
                odom_id=config.boot, seq=count, stamp_s=now_s, odom_in_map=IDENTITY, quality=1.0,
                map_id=config.map_id,
            ),
        ),
        drive=base.drive,
        imu=base.imu,
        scan=_through_codec(
            SCAN,
            Scan(
                boot_id=_NAME, seq=count, stamp_s=now_s, angle_min_rad=-3.14,
                angle_increment_rad=0.01745, range_min_m=0.12, range_max_m=8.0,
                ranges_m=tuple(3.0 + 0.001 * beam for beam in range(_BEAMS)),
            ),
        ),
        estop_link=_through_codec(ESTOP_LINK, EstopLink(seq=count, pressed=False)),
        rejected=(RejectedAt(WAYPOINTS.path, bad),) if isinstance(bad, DecodeFailure) else (),
        arrived=(ArrivedAt(WAYPOINTS.path, 1),),
        fences=(_fence(config),),
        fence_done=FenceDone(_NAME, _NAME, ""),
        marks=(_fence(config),),
        marks_done=FenceDone(_NAME, _NAME, ""),
        recorder_ok=True,
        recorder_says=_NAME,
    )  # fmt: skip


def _fence(config: CoreConfig) -> FenceArrival:
    """Return an operator's fence as the link hands it over; nothing is asked to write it."""
    robot = config.robot.id
    proof = sign_fence(VIRTUAL_KEY, robot, _NAME, _NAME, "{}")
    request = _through_codec(FENCE, FenceRequest(id=_NAME, source=_NAME, fence="{}", proof=proof))
    fits = authentic_fence(VIRTUAL_KEY, robot, request)
    return FenceArrival(_NAME, _NAME, _NAME, fits, request.fence)


def _orders(config: CoreConfig, count: int) -> Inbox:
    """Return an inbox of an owner's orders and a teleop command."""
    epoch = f"{config.boot}-1"
    points = tuple(Waypoint(x_m=0.1 * n, y_m=0.0, speed_mps=0.3) for n in range(50))
    hello = Hello(
        planner_id=_NAME, kind="planner", seen=1, protocol=PROTOCOL, robot_hash=config.robot_hash,
        fence_hash=config.fence_hash, map_id=config.map_id,
    )  # fmt: skip
    grant = Grant(
        planner_id=_NAME, epoch=epoch, seen=1, mission=_NAME, metres=1.0, seconds=1.0
    )  # fmt: skip
    velocity = Velocity(
        source_id=_NAME, epoch=epoch, seq=count, seen=1, v_mps=0.0, w_radps=0.0, dead_man=False
    )  # fmt: skip
    waypoints = Waypoints(
        planner_id=_NAME, epoch=epoch, seq=count, seen=1, mission=_NAME, leg=1,
        map_id=config.map_id, ttl_s=0.5, points=points, final=False,
    )  # fmt: skip
    beat = Heartbeat(planner_id=_NAME, epoch=epoch, seen=1, used=1)
    return Inbox(
        hellos=(_through_codec(HELLO, hello),),
        grants=(_through_codec(GRANT, grant),),
        heartbeats=(_through_codec(HEARTBEAT, beat),),
        teleop=(_through_codec(TELEOP, velocity),),
        waypoints=(_through_codec(WAYPOINTS, waypoints),),
    )


def _through_codec(key: Key[M], message: M) -> M:
    """Send a message through the codec, as if it came over the wire."""
    back = decode(key, encode(message))
    if isinstance(back, DecodeFailure):
        raise TypeError(f"the warm-up's own {key.path} is refused: {back.detail}")
    return back
