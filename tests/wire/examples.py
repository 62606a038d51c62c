"""Give one valid message of every kind, for all wire tests."""

from __future__ import annotations

from typing import Any

from wire import (
    IDENTITY,
    STILL,
    Action,
    Answer,
    DriveCommand,
    DriveReport,
    DriveState,
    EstopLink,
    Event,
    Grant,
    GrantLeft,
    Heartbeat,
    Held,
    HeldReason,
    Hello,
    ImageHeader,
    Imu,
    LegReport,
    LimitsInForce,
    Localization,
    Mode,
    Odometry,
    OpRequest,
    Owner,
    Pose2,
    Proof,
    Record,
    RowReport,
    Scan,
    SimControl,
    SimTruth,
    Status,
    Stop,
    TickStats,
    Twist2,
    Velocity,
    Waypoint,
    Waypoints,
)

PRINT = "0123456789abcdef"
EPOCH = "boot1-7"
STAMP: dict[str, Any] = {"seq": 3, "stamp_s": 12.25}

STATUS = Status(
    protocol=1,
    robot="r1",
    boot="boot1",
    seq=41,
    at_s=100.125,
    mode=Mode.ACTIVE,
    action=Action.CAP,
    epoch=EPOCH,
    nonce="boot1.2",
    owner=Owner(planner_id="p1", kind="planner"),
    held=Held(reason=HeldReason.STOP, id="stop-1"),
    grant=GrantLeft(mission="m1", metres=12.5, seconds=60.0),
    leg=LegReport(
        mission="m1",
        leg=2,
        following=True,
        reached=False,
        residual_m=1.5,
        residual_rad=0.25,
        refusal="bad_spacing",
    ),
    base_in_odom=IDENTITY,
    base_in_map=Pose2(1.0, 2.0, -0.5),
    asked=Twist2(0.5, 0.1),
    sent=Twist2(0.4, 0.08),
    measured=STILL,
    limits=LimitsInForce(v_mps=0.25, w_radps=0.5, by="brain_late", free_m=2.0, margin_m=1.5),
    rows=(
        RowReport(
            row="BRAIN_LATE", action=Action.CAP, for_s=0.2, evidence="seen 180 ms ago", binding=True
        ),
    ),
    answers=(Answer(id="a1", kind="arm", accepted=True, code="ok", detail=""),),
    waiting_for=("lidar",),
    blocked=False,
    robot_hash=PRINT,
    fence_hash=PRINT,
    map_id=PRINT,
    operator_metres=500.0,
    operator_seconds=3600.0,
    drive=DriveReport(
        kind="sim",
        virtual=True,
        enabled=True,
        timed_out=False,
        boot_id="d1",
        battery=0.8,
        real_time=True,
    ),
    ticks=TickStats(
        ticks=10_000,
        missed=1,
        late_p50_us=60.0,
        late_max_us=900.0,
        step_max_us=180.0,
        dropped=0,
        record_gaps=0,
    ),
)

_MESSAGES: tuple[Record, ...] = (
    Hello(
        planner_id="p1",
        kind="planner",
        seen=40,
        protocol=1,
        robot_hash=PRINT,
        fence_hash=PRINT,
        map_id=PRINT,
    ),
    Grant(planner_id="p1", epoch=EPOCH, seen=40, mission="m1", metres=20.0, seconds=90.0),
    Waypoints(
        planner_id="p1",
        epoch=EPOCH,
        seq=5,
        seen=40,
        mission="m1",
        leg=2,
        map_id=PRINT,
        ttl_s=0.5,
        points=(
            Waypoint(x_m=1.0, y_m=2.0, speed_mps=0.3),
            Waypoint(x_m=1.1, y_m=2.0, speed_mps=0.3, heading_rad=1.5),
        ),
        final=True,
    ),
    Heartbeat(planner_id="p1", epoch=EPOCH, seen=40, used=39),
    Stop(id="stop-1", source="cli"),
    Velocity(
        source_id="stick", epoch=EPOCH, seq=1, seen=40, v_mps=0.2, w_radps=-0.3, dead_man=True
    ),
    OpRequest(id="op-1", source="cli", proof=Proof(nonce="boot1.2", mac="a" * 64)),
    EstopLink(seq=1, pressed=False),
    STATUS,
    Event(
        boot="boot1", seq=1, tick=100, at_s=1.0, code="transition", mode=Mode.HOLD, detail="armed"
    ),
    Odometry(
        odom_id="boot1", base_in_odom=Pose2(1.0, 0.5, 3.0), twist=STILL, yaw_rate_radps=0.1, **STAMP
    ),
    Localization(odom_id="boot1", odom_in_map=IDENTITY, quality=0.9, map_id=PRINT, **STAMP),
    DriveCommand(boot="boot1", seq=9, left_radps=1.0, right_radps=-1.0, enable=True),
    DriveState(
        boot_id="d1",
        echo_boot="boot1",
        echo_seq=8,
        enabled=True,
        timed_out=False,
        left_rad=10.0,
        right_rad=11.0,
        left_radps=1.0,
        right_radps=1.5,
        **STAMP,
    ),
    Scan(
        boot_id="d1",
        angle_min_rad=-3.0,
        angle_increment_rad=0.02,
        range_min_m=0.1,
        range_max_m=8.0,
        ranges_m=(1.0, None, 0.05, 7.5),
        **STAMP,
    ),
    Imu(boot_id="d1", yaw_rate_radps=0.1, accel_x_mps2=0.0, accel_y_mps2=0.0, **STAMP),
    ImageHeader(boot_id="d1", width=320, height=240, focal_px=277.0, **STAMP),
    SimTruth(
        boot_id="d1",
        base_in_map=IDENTITY,
        twist=STILL,
        contacts=0,
        contacts_total=2,
        real_time_factor=1.0,
        **STAMP,
    ),
    SimControl(id="c1", place_robot=Pose2(1.0, 1.0, 0.0)),
)
EXAMPLES: dict[type[Record], Record] = {type(message): message for message in _MESSAGES}
