"""Bring rows about motion, sight, power, zones and floods up by real inputs, and clear them."""

from __future__ import annotations

from dataclasses import replace
from math import radians

import pytest

from bridge.core import ArrivedAt, BridgeState
from bridge.core.geometry.fence import Zone, build_fence
from tests.bridge.core.fake_planner import MAP_ID
from tests.bridge.core.scripted import World, config
from tests.bridge.core.windows import raised, silent_for
from wire import Mode, RobotDescription, wrap
from wire.lidar_config import LidarConfig


def mode_of(world: World) -> Mode:
    """Tell the mode now; a question, so that no type checker remembers its answer."""
    state: BridgeState = world.state
    return state.mode


class TestRunaway:
    """Hold RUNAWAY to both of its windows."""

    def test_a_drive_faster_than_told_is_braked_and_then_cut(self) -> None:
        world = World().driving((5.0, 0.0))
        world.drive.runs_on, world.drive.speeds = True, (9.0, 9.0)
        silent_for(world, 12)
        assert raised(world, "RUNAWAY.0")
        assert world.is_in(Mode.STOPPING)
        assert not raised(world, "RUNAWAY.1")
        silent_for(world, 16)
        assert raised(world, "RUNAWAY.1")
        assert world.is_in(Mode.FAULT)
        assert not world.told.enable

    def test_a_wheel_that_turns_the_other_way_is_one_too(self) -> None:
        world = World().driving((5.0, 0.0))
        world.drive.runs_on, world.drive.speeds = True, (-3.0, -3.0)
        silent_for(world, 13)
        assert raised(world, "RUNAWAY.0")

    def test_a_hand_that_takes_over_does_not_hide_one(self) -> None:
        world = World().armed()
        world.teleop(held=False)
        silent_for(world, 3)
        world.teleop(held=True)
        world.drive.runs_on, world.drive.speeds = True, (5.0, 5.0)
        silent_for(world, 1)
        assert world.is_in(Mode.TELEOP)
        silent_for(world, 11)
        assert raised(world, "RUNAWAY.0")


class TestStuck:
    """Hold STUCK to both of its detectors and to its count."""

    def hold_wheels(self, world: World) -> None:
        world.drive.runs_on, world.drive.speeds = True, (0.0, 0.0)

    def test_wheels_that_do_not_turn_end_the_grant_after_1_s(self) -> None:
        world = World().driving((5.0, 0.0))
        self.hold_wheels(world)
        silent_for(world, 105)
        assert raised(world, "STUCK.0")
        codes = [event.code for event in world.events]
        assert "granted" in codes[codes.index("row_up") :], "what was granted before is void"
        assert world.is_in(Mode.STOPPING) or world.is_in(Mode.HOLD)

    def test_the_third_time_in_five_minutes_disarms(self) -> None:
        world = World().driving((5.0, 0.0))
        self.hold_wheels(world)
        for _ in range(1200):
            world.tick()
            if mode_of(world) is Mode.DISARMED:
                break
        assert world.is_in(Mode.DISARMED)
        assert raised(world, "STUCK.1")
        ups = [event for event in world.events if event.detail.startswith("STUCK.0")]
        assert len([event for event in ups if event.code == "row_up"]) == 3


class TestYaw:
    """Hold YAW_DISAGREE to its window."""

    def test_a_gyro_that_turns_by_itself_caps_the_speed(self) -> None:
        world = World().driving((5.0, 0.0))
        world.gyro_off_radps = 0.35
        silent_for(world, 52)
        assert raised(world, "YAW_DISAGREE.0")
        assert world.state.motion.cap == pytest.approx(0.3 / 0.5)
        assert world.is_in(Mode.ACTIVE)
        world.gyro_off_radps = 0.0
        world.run(1.9)
        assert raised(world, "YAW_DISAGREE.0")
        world.run(0.3)
        assert not raised(world, "YAW_DISAGREE.0")

    def test_a_silent_gyro_counts(self) -> None:
        world = World().driving((5.0, 0.0))
        world.gyro_silent = True
        world.run(0.8)
        assert raised(world, "YAW_DISAGREE.0")

    @pytest.mark.parametrize("silent", [True, False])
    def test_a_robot_without_a_gyro_is_slow_for_ever(self, silent: bool) -> None:
        robot = RobotDescription.model_validate({"inputs": {"imu": False}})
        world = World(core=config(robot), gyro_silent=silent).driving((5.0, 0.0))
        world.run(3.0)
        assert raised(world, "YAW_DISAGREE.0")
        assert world.state.rows["YAW_DISAGREE.0"].evidence == "no gyro"
        assert world.state.motion.cap == pytest.approx(0.3 / 0.5)
        assert world.is_in(Mode.ACTIVE)


class TestSight:
    """Hold LIDAR_BLIND and NO_RANGE to their windows."""

    def test_a_covered_lidar_holds_after_300_ms_and_disarms_after_5_s(self) -> None:
        world = World().driving((5.0, 0.0))
        world.lidar_blind = True
        world.run(0.45)
        assert raised(world, "LIDAR_BLIND.0")
        assert world.is_in(Mode.STOPPING)
        world.run(4.4)
        assert world.is_in(Mode.HOLD)
        world.run(0.6)
        assert world.is_in(Mode.DISARMED)
        assert raised(world, "LIDAR_BLIND.1")

    def test_one_that_sees_again_is_trusted_after_2_s(self) -> None:
        world = World().driving((5.0, 0.0))
        world.lidar_blind = True
        world.run(1.0)
        world.lidar_blind = False
        world.run(1.9)
        assert raised(world, "LIDAR_BLIND.0")
        assert world.is_in(Mode.HOLD)
        world.until(Mode.ACTIVE, 0.5)

    def test_without_a_living_lidar_there_is_no_range(self) -> None:
        world = World().driving((5.0, 0.0))
        world.lidar_silent = True
        world.run(4.0)
        assert not raised(world, "NO_RANGE.0")
        world.run(2.0)
        assert raised(world, "NO_RANGE.0")
        assert raised(world, "NO_RANGE.1")


def far_seeing() -> World:
    """Return a world whose lidar reaches the corners of its room, with edges near enough."""
    return World(core=config(RobotDescription(lidar=LidarConfig(range_max_m=12.0))))


class TestSector:
    """Hold LIDAR_SECTOR to the way asked for, and to silence where something must be."""

    def test_a_sector_gone_silent_ahead_holds_within_half_a_second(self) -> None:
        world = far_seeing().driving((5.0, 0.0))
        world.hidden_rad = (0.0, radians(46))
        world.run(0.4)
        assert raised(world, "LIDAR_SECTOR.0"), "LIDAR_SECTOR"
        assert world.is_in(Mode.STOPPING)
        world.run(5.0)
        assert world.is_in(Mode.HOLD)
        world.hidden_rad = None
        world.run(1.9)
        assert raised(world, "LIDAR_SECTOR.0"), "it is trusted after 2 s"
        world.until(Mode.ACTIVE, 0.5)

    def test_nothing_drives_off_into_a_sector_that_never_returned(self) -> None:
        world = far_seeing()
        world.hidden_rad = (0.0, radians(31))
        world.armed()
        world.brain.mission, world.brain.goal_m = "m1", (5.0, 0.0)
        world.until(Mode.ACTIVE)
        world.run(1.0)
        assert raised(world, "LIDAR_SECTOR.0")
        assert world.here.x_m < 0.01

    def test_what_is_hidden_aside_of_the_way_holds_nothing(self) -> None:
        world = far_seeing().driving((5.0, 0.0))
        world.hidden_rad = (2.5, radians(46))
        world.run(1.0)
        assert not raised(world, "LIDAR_SECTOR.0")
        assert world.is_in(Mode.ACTIVE)

    def test_a_held_robot_turns_in_place_where_its_way_now_begins_so(self) -> None:
        world = far_seeing().driving((5.0, 0.0))
        world.hidden_rad = (0.0, radians(46))
        world.run(3.0)
        assert raised(world, "LIDAR_SECTOR.0")
        begun = world.here
        world.brain.goal_m = (begun.x_m - 2.0, 0.0)
        world.run(8.0)
        assert abs(wrap(world.here.yaw_rad - begun.yaw_rad)) > 1.0
        assert abs(world.here.x_m - begun.x_m) < 0.1, "the hole turned with it, and holds it again"
        assert raised(world, "LIDAR_SECTOR.0")

    def test_a_hand_drives_slowly_into_a_silent_sector(self) -> None:
        world = far_seeing().armed()
        world.hidden_rad = (0.0, radians(46))
        world.teleop(held=False)
        for _ in range(60):
            world.teleop(0.4, held=True)
            world.tick()
        assert raised(world, "LIDAR_SECTOR.1"), "LIDAR_SECTOR"
        assert world.is_in(Mode.TELEOP)
        assert 0.05 < world.sent.v_mps <= 0.1


class TestPower:
    """Hold BATTERY and OVERCURRENT to their windows."""

    def test_a_low_battery_slows_and_an_empty_one_disarms(self) -> None:
        world = World().driving((5.0, 0.0))
        world.drive.battery = 0.19
        world.run(2.05)
        assert raised(world, "BATTERY.0")
        assert world.state.motion.cap == pytest.approx(0.3 / 0.5)
        world.drive.battery = 0.24
        world.run(7.0)
        assert raised(world, "BATTERY.0"), "until it is 5 % up"
        world.drive.battery = 0.26
        world.run(5.2)
        assert not raised(world, "BATTERY.0")
        world.drive.battery = 0.09
        world.run(2.6)
        assert raised(world, "BATTERY.1")
        world.until(Mode.DISARMED, 2.0)

    @pytest.mark.parametrize(("current_a", "after_s"), [(31.0, 0.1), (20.0, 7.7)])
    def test_too_much_current_stops_by_peak_or_by_heat(
        self, current_a: float, after_s: float
    ) -> None:
        world = World().driving((5.0, 0.0))
        world.drive.current_a = current_a
        world.run(after_s - 0.05)
        assert not raised(world, "OVERCURRENT.0")
        world.run(0.15)
        assert raised(world, "OVERCURRENT.0")
        world.until(Mode.FAULT, 2.0)


def test_a_zone_caps_at_its_speed_from_the_outline_on_while_the_robot_is_in_it() -> None:
    zone = Zone(((1.5, -1.0), (2.5, -1.0), (2.5, 1.0), (1.5, 1.0)), 0.2)
    square = ((-5.5, -5.5), (5.5, -5.5), (5.5, 5.5), (-5.5, 5.5))
    core = replace(config(), fence=build_fence(MAP_ID, (square,), zones=(zone,)))
    world = World(core=core).driving((5.0, 0.0))
    inside: list[float] = []
    while world.here.x_m < 3.0:
        world.tick()
        if 1.5 <= world.here.x_m <= 2.5:
            assert raised(world, "SPEED_ZONE.0")
            inside.append(world.sent.v_mps)
        elif not 1.0 < world.here.x_m < 3.0:
            assert not raised(world, "SPEED_ZONE.0")
    assert max(inside) <= 0.2 + 1e-9
    assert min(inside) > 0.15, "slow, not standing"


class TestFlood:
    """Hold CMD_FLOOD to its limit and its windows."""

    def flood(self, world: World, seconds: float, key: str, each: int) -> None:
        for _ in range(round(seconds / 0.01)):
            world.extra = replace(world.extra, arrived=(ArrivedAt(key, each),))
            world.tick()

    @pytest.mark.parametrize("key", ["cmd/waypoints", "cmd/heartbeat", "cmd/hello", "cmd/grant"])
    def test_four_windows_of_too_much_hold(self, key: str) -> None:
        world = World().driving((5.0, 0.0))
        self.flood(world, 0.9, key, 4)
        assert not raised(world, "CMD_FLOOD.0")
        self.flood(world, 0.3, key, 4)
        assert raised(world, "CMD_FLOOD.0")
        assert not world.is_in(Mode.ACTIVE)

    def test_a_stop_is_heard_in_any_flood(self) -> None:
        world = World().driving((5.0, 0.0))
        self.flood(world, 0.5, "cmd/waypoints", 200)
        stop_id = world.stop()
        world.extra = replace(world.extra, arrived=(ArrivedAt("cmd/waypoints", 200),))
        world.tick()
        assert world.verdict(stop_id) == "ok"
