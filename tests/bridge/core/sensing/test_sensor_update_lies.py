"""Let senses lie: false numbers, poses that creep, a drive that somebody else commands.

Who reaches the sensors' socket can lie in each message; here is what no lie may bring about.
"""

from __future__ import annotations

from dataclasses import replace
from math import cos, hypot, sin

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from bridge.core import Inbox
from bridge.core.geometry.kinematics import along_arc
from bridge.core.sensing import sensor_update
from bridge.core.sensing.sensor_update import DRIFT_M, DRIFT_RAD, JUMP_M, SEQ_AHEAD
from bridge.core.state_senses import Drift
from bridge.core.tick_context import TickContext
from localization.noise import PoseNoise
from tests.bridge.core.fake_planner import BOOT, MAP_ID
from tests.bridge.core.reached import reached, tick_of
from tests.bridge.core.scripted import World
from tests.laws import at_least
from wire import IDENTITY, Localization, Mode, Pose2, Scan, compose, wrap
from wire.geometry import inverse

POSE_CODES = {"pose_jump", "pose_drift"}


def raised(world: World, stage: str) -> bool:
    return stage in world.state.rows


def hear(tick: TickContext, odom_in_map: Pose2) -> None:
    new = Localization(
        odom_id=BOOT, seq=1, stamp_s=tick.now_s, odom_in_map=odom_in_map, quality=1.0, map_id=MAP_ID
    )
    sensor_update._hear_localization(tick, new)


def told(tick: TickContext) -> list[str]:
    return [code for code, _ in tick.events if code in POSE_CODES]


def standing(base_in_odom: Pose2 = IDENTITY) -> TickContext:
    """Return a tick of a robot that stands, localized where ``odom`` says."""
    tick = tick_of(reached("hold_granted"))
    tick.s.odometry = replace(tick.s.odometry, base_in_odom=base_in_odom)
    tick.s.pose = replace(tick.s.pose, good=None, drift=Drift())
    hear(tick, IDENTITY)
    return tick


steps = st.tuples(st.floats(0.0, JUMP_M), st.floats(-3.2, 3.2), st.floats(-0.08, 0.08))


@at_least(100)
@given(st.lists(steps, min_size=1, max_size=60))
@example([(0.0005, 0.0, 0.0)] * 4_000)  # 670 a second once moved the robot by 2 m, and nobody saw
@example([(0.0, 0.0, 0.01)] * 60)
def test_no_small_steps_move_the_pose_of_a_standing_robot_far(
    moves: list[tuple[float, float, float]],
) -> None:
    tick = standing()
    at = settled = IDENTITY
    for by_m, towards_rad, turn_rad in moves:
        at = Pose2(
            at.x_m + by_m * cos(towards_rad),
            at.y_m + by_m * sin(towards_rad),
            wrap(at.yaw_rad + turn_rad),
        )
        before = len(told(tick))
        hear(tick, at)
        if len(told(tick)) > before:
            settled = at
        assert hypot(at.x_m - settled.x_m, at.y_m - settled.y_m) <= DRIFT_M + 1e-9
        assert abs(wrap(at.yaw_rad - settled.yaw_rad)) <= DRIFT_RAD + 1e-9


def test_a_pose_that_drifts_on_and_on_disarms() -> None:
    world = World().driving((4.0, 0.0))
    world.events.clear()
    for _ in range(1_000):
        world.odom_in_map = Pose2(world.odom_in_map.x_m, world.odom_in_map.y_m + 0.0033, 0.0)
        world.tick()
        if world.is_in(Mode.DISARMED):
            break
    assert raised(world, "POSE_JUMP.1")
    codes = [event.code for event in world.events]
    assert codes.count("pose_drift") == 3
    assert "pose_jump" not in codes, "no single message went too far"
    assert world.odom_in_map.y_m < 1.5
    world.run(1.0)
    assert world.is_in(Mode.DISARMED), "until a person arms"
    world.arm()
    assert not raised(world, "POSE_JUMP.1")


def test_jumps_that_take_no_grant_disarm_nobody() -> None:
    world = World().armed()
    for number in range(8):
        world.odom_in_map = Pose2(0.3 * (number % 2), 0.0, 0.0)
        world.run(0.3)
    assert world.is_in(Mode.HOLD)
    assert not raised(world, "POSE_JUMP.1")


@settings(max_examples=10)
@given(st.integers(0, 2**32))
@example(2)
def test_the_noise_of_an_honest_localizer_is_no_drift(seed: int) -> None:
    """Ten minutes of a robot that stands."""
    noise, tick = PoseNoise(seed), standing(Pose2(3.0, 1.0, 0.7))
    for _ in range(6_000):
        noise.advance(0.1)
        here = tick.s.odometry.base_in_odom
        hear(tick, compose(noise.disturb(here), inverse(here)))
    assert told(tick) == []


@pytest.mark.parametrize("every_m", [0.02, 0.25, 1.5])
@pytest.mark.parametrize(("scale", "turn"), [(0.05, 0.0), (-0.05, 0.02), (0.0, -0.03)])
def test_what_corrects_wheels_that_measure_wrong_is_no_drift(
    every_m: float, scale: float, turn: float
) -> None:
    """Corrections at each message, at AMCL's quarter metre, and at the end of a long corridor."""
    tick = standing()
    odometry = tick.s.odometry
    real = measured = IDENTITY
    for number in range(1, 2_001):  # 40 m, round and round
        real = along_arc(real, 0.02, 0.01)
        measured = along_arc(measured, 0.02 * (1.0 + scale), 0.01 + 0.02 * turn)
        travelled_m = odometry.travelled_m + 0.02 * (1.0 + scale) * number
        turned_rad = odometry.turned_rad + (0.01 + 0.02 * turn) * number
        tick.s.odometry = replace(
            odometry, base_in_odom=measured, travelled_m=travelled_m, turned_rad=turned_rad
        )
        if number % round(every_m / 0.02) == 0:
            hear(tick, compose(real, inverse(measured)))
    assert told(tick) == []


def test_turning_forgives_the_heading_that_wheels_measure_wrong() -> None:
    for wrong, codes in ((0.09, []), (0.3, ["pose_drift"])):
        tick = standing()
        for number in range(1, 60):
            turned_rad = 0.1 * number
            tick.s.odometry = replace(tick.s.odometry, turned_rad=turned_rad)
            hear(tick, Pose2(0.0, 0.0, wrong * turned_rad))
        assert told(tick)[:1] == codes


def test_a_slip_that_the_gyro_saw_forgives_the_heading() -> None:
    for slip_rad, codes in ((0.05, []), (0.02, ["pose_drift"])):
        tick = standing()
        for number in range(1, 11):
            slipped_rad = tick.s.pose.slipped_rad + slip_rad
            tick.s.pose = replace(tick.s.pose, slipped_rad=slipped_rad)
            hear(tick, Pose2(0.0, 0.0, 0.05 * number))
        assert told(tick)[:1] == codes


def test_what_was_driven_forgives_ever_less_than_is_there() -> None:
    tick = standing()
    hear(tick, Pose2(0.1, 0.0, 0.08))
    tick.s.odometry = replace(tick.s.odometry, travelled_m=tick.s.odometry.travelled_m + 0.5)
    hear(tick, Pose2(0.1, 0.0, 0.08))
    drift = tick.s.pose.drift
    assert (drift.x_m, drift.y_m) == pytest.approx((0.05, 0.0))
    assert drift.yaw_rad == pytest.approx(0.055)
    tick.s.odometry = replace(tick.s.odometry, travelled_m=tick.s.odometry.travelled_m + 9.0)
    hear(tick, Pose2(0.1, 0.0, 0.08))
    assert (tick.s.pose.drift.x_m, tick.s.pose.drift.yaw_rad) == (0.0, 0.0)


def scan_of(world: World, seq: int) -> Scan:
    newest = world.state.lidar.newest
    assert newest is not None
    return newest.model_copy(update={"seq": seq, "stamp_s": world.now_s + 0.01})


@pytest.mark.parametrize("ahead", [SEQ_AHEAD + 1, 1_000_000])
def test_one_number_far_ahead_shuts_no_lidar_out(ahead: int) -> None:
    world = World().driving((4.0, 0.0))
    newest = world.state.lidar.newest
    assert newest is not None
    while world.ticks % 10 == 3 or (world.ticks + 1) % 10 == 3:
        world.tick()
    world.extra = Inbox(scan=scan_of(world, newest.seq + ahead))
    decision = world.tick()
    assert "scan_ahead" in decision.reasons
    world.run(0.5)
    assert world.is_in(Mode.ACTIVE)
    assert not raised(world, "LIDAR_STALE.0")


def test_a_number_that_is_near_ahead_is_believed_and_the_true_ones_after_a_silence() -> None:
    world = World().armed()
    newest = world.state.lidar.newest
    assert newest is not None
    world.lidar_silent = True
    world.run(0.1)
    world.extra = Inbox(scan=scan_of(world, newest.seq + SEQ_AHEAD))
    world.tick()
    assert world.state.lidar.newest is not newest
    world.lidar_silent = False
    world.run(0.2)
    assert world.state.lidar.received_s is not None
    assert world.now_s - world.state.lidar.received_s > 0.15, "the true ones are old"
    world.run(0.3)
    assert raised(world, "LIDAR_STALE.0"), "seen for a second after"
    assert world.now_s - world.state.lidar.received_s < 0.12
    world.run(1.5)
    assert not raised(world, "LIDAR_STALE.0")


@pytest.mark.parametrize(
    ("further", "silent_s", "order"),
    [
        (1, 0.1, ""), (SEQ_AHEAD, 0.1, ""), (SEQ_AHEAD + 1, 0.1, "ahead"), (0, 0.1, "old"),
        (-1, 0.1, "old"), (1, 0.3, ""), (10**6, 0.3, ""), (-1, 0.3, "again"), (0, 0.3, "old"),
        (-1, 0.25, "old"), (-1, None, "again"),
    ],
)  # fmt: skip
def test_what_a_number_tells(further: int, silent_s: float | None, order: str) -> None:
    received_s = None if silent_s is None else 10.0 - silent_s
    assert sensor_update.order_of(further, 10.0, received_s, 0.25) == order


def test_a_drive_that_counts_from_below_after_silence_is_another_life() -> None:
    world = World().driving((4.0, 0.0))
    world.drive_silent = True
    world.run(0.3)
    world.drive.seq, world.drive_silent = 0, False
    world.run(0.02)
    assert raised(world, "DRIVE_REBOOT.0")
    world.run(2.0)
    assert world.is_in(Mode.DISARMED)
    assert not raised(world, "ENC_STALE.0")
    world.arm()
    assert world.is_in(Mode.HOLD)


def test_a_drive_far_ahead_is_not_believed_while_it_speaks() -> None:
    world = World().armed()
    world.drive.seq += 10**6
    decision = world.tick()
    assert "drive_state_ahead" in decision.reasons
    world.drive.seq -= 10**6
    world.run(0.5)
    assert world.is_in(Mode.HOLD)
    assert not raised(world, "ENC_STALE.0")


@pytest.mark.parametrize("start", ["hold", "active", "disarmed"])
def test_an_echo_of_another_commander_stops_at_once(start: str) -> None:
    """A drive that obeyed a stranger once passed for a deaf one, for up to half a second."""
    world = reached(start)
    assert world.state.drive.echoed_us
    world.drive.deaf = True
    world.drive.echo_boot, world.drive.echo_seq = "stranger", 1
    world.tick()
    assert raised(world, "DRIVE_FOREIGN.0")
    assert world.state.rows["DRIVE_FOREIGN.0"].evidence == "it echoes a command of stranger"


@pytest.mark.parametrize("before", ["b9", None])
def test_an_echo_of_the_bridge_before_is_no_stranger_until_the_drive_has_heard_us(
    before: str | None,
) -> None:
    world = World()
    world.drive.echo_boot = before
    world.until(Mode.DISARMED)
    assert world.state.drive.echoed_us
    assert not raised(world, "DRIVE_FOREIGN.0")
    world.drive.deaf, world.drive.echo_boot = True, None  # as one that has started again
    world.tick()
    assert not raised(world, "DRIVE_FOREIGN.0")


@pytest.mark.parametrize("start", ["hold", "active", "disarmed"])
def test_an_echo_of_what_was_never_sent_stops_and_needs_a_reset(start: str) -> None:
    """A drive that somebody else commanded once said timed out, in HOLD, and no row was up."""
    world = reached(start)
    world.drive.deaf = True
    world.drive.echo_seq = world.state.command_seq + 1
    world.tick()
    assert raised(world, "DRIVE_FOREIGN.0")
    world.run(3.0)
    assert world.is_in(Mode.DISARMED if start == "disarmed" else Mode.FAULT)
    world.drive.deaf, world.drive.boot_id = False, "d9"
    world.run(2.5)
    if start != "disarmed":
        reset = world.op("reset")
        world.tick()
        assert world.verdict(reset) == "ok"
    world.arm()
    assert not raised(world, "DRIVE_FOREIGN.0")
