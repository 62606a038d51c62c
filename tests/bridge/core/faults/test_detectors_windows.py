"""Bring rows about brains, lidar, pose, drive and loop up by real inputs, and clear them."""

from __future__ import annotations

from dataclasses import replace
from math import nan

import pytest

from bridge.core import Inbox
from tests.bridge.core.scripted import World, config
from tests.bridge.core.windows import bad_bytes, raised, silent_for, until_age
from wire import Action, EstopLink, Mode, RobotDescription


def test_brain_late_caps_at_half_after_150_ms_and_lost_holds_after_300() -> None:
    world = World().driving()
    world.brain.silent = True
    echo_s = world.state.ownership.echo_s
    until_age(world, echo_s, 16)
    assert raised(world, "BRAIN_LATE.0")
    assert world.state.motion.cap == 0.5
    assert world.is_in(Mode.ACTIVE)
    until_age(world, echo_s, 31)
    assert raised(world, "BRAIN_LOST.0")
    assert world.is_in(Mode.STOPPING)
    assert world.state.ownership.owner is None
    assert world.state.grants.mission is None


def test_a_lost_brain_that_returns_while_the_robot_stops_is_not_called_lost() -> None:
    world = World().driving()
    world.brain.silent = True
    while world.is_in(Mode.ACTIVE):
        world.tick()
    world.brain.silent, world.brain.mission = False, None  # it is back and wants nothing
    for _ in range(200):
        if world.state.ownership.owner is None:
            world.tick()
    assert world.state.ownership.owner is not None
    assert world.is_in(Mode.STOPPING), "it stands, and the stop's 200 ms are not over"
    assert raised(world, "BRAIN_LOST.0"), "a stop is finished before it is forgotten"
    world.until(Mode.HOLD, 2.0)
    world.run(0.1)
    assert not raised(world, "BRAIN_LOST.0")


def test_brain_gone_disarms_after_5_s() -> None:
    world = World().driving()
    world.brain.silent = True
    until_age(world, world.state.ownership.echo_s, 499)
    assert world.is_in(Mode.HOLD)
    silent_for(world, 2)
    assert world.is_in(Mode.DISARMED)
    assert raised(world, "BRAIN_GONE.0")
    world.op("arm")
    world.run(0.1)
    assert not raised(world, "BRAIN_GONE.0")
    assert world.is_in(Mode.HOLD)


def test_a_brain_that_thinks_on_stale_data_is_held_after_1_s() -> None:
    world = World().driving()
    world.run(0.1)
    world.brain.used = world.shown.seq
    world.run(0.1)
    used_s = world.state.ownership.used_s
    until_age(world, used_s, 101)
    assert raised(world, "BRAIN_STALE.0")
    assert world.is_in(Mode.STOPPING)
    world.brain.used = None
    world.run(0.3)
    assert raised(world, "BRAIN_STALE.0")
    world.run(0.5)
    assert not raised(world, "BRAIN_STALE.0")
    world.until(Mode.ACTIVE, 1.0)


def test_an_old_horizon_is_held_after_its_ttl() -> None:
    world = World().driving()
    world.brain.next_horizon_s = 1e9
    world.tick()
    until_age(world, world.state.leg.sent_s, 51)
    assert raised(world, "CMD_STALE.0")
    assert world.is_in(Mode.STOPPING)
    world.brain.next_horizon_s = 0.0
    world.until(Mode.ACTIVE, 2.0)
    assert not raised(world, "CMD_STALE.0")


def test_four_bad_messages_are_forgiven_and_five_are_not() -> None:
    world = World().driving()
    bad_bytes(world, 4)
    world.tick()
    assert not raised(world, "CMD_BAD.0")
    world.run(2.5)
    assert world.is_in(Mode.ACTIVE)
    bad_bytes(world, 6)
    world.tick()
    assert raised(world, "CMD_BAD.0")
    assert world.is_in(Mode.STOPPING)
    world.until(Mode.ACTIVE, 4.0)


def test_a_spent_grant_holds_at_once_and_a_new_mission_goes_on() -> None:
    world = World()
    world.brain.metres = 1.0
    world.driving((4.0, 0.0))
    world.until(Mode.STOPPING, 5.0)
    assert raised(world, "BUDGET.0")
    assert world.state.grants.metres == 0.0
    world.run(2.0)
    assert world.is_in(Mode.HOLD)
    world.brain.mission = "m2"
    world.until(Mode.ACTIVE, 1.0)
    assert not raised(world, "BUDGET.0")
    world.stop()
    world.run(2.0)
    world.op("resume")
    world.brain.mission = "m1"
    world.run(1.0)
    assert world.is_in(Mode.HOLD), "what m1 had is spent for good"


def test_the_operator_cap_is_spent_and_refilled_by_a_person() -> None:
    world = World().driving()
    grants = world.state.grants
    world.state.grants = replace(grants, operator_metres=0.001)
    world.until(Mode.STOPPING, 0.5)
    assert raised(world, "BUDGET.0")
    world.run(2.0)
    assert world.is_in(Mode.HOLD)
    world.op("resume")
    world.until(Mode.ACTIVE, 1.0)


def test_a_silent_lidar_holds_after_250_ms_and_disarms_after_5_s_more() -> None:
    world = World().driving((5.0, 0.0))
    world.lidar_silent = True
    until_age(world, world.state.lidar.received_s, 26)
    assert raised(world, "LIDAR_STALE.0")
    assert world.is_in(Mode.STOPPING)
    world.run(4.9)
    assert world.is_in(Mode.HOLD)
    world.run(0.3)
    assert world.is_in(Mode.DISARMED)
    assert world.asked("arm") == "lidar_stale"
    world.lidar_silent = False
    world.run(0.3)
    world.op("arm")
    world.tick()
    assert world.is_in(Mode.HOLD)
    assert not raised(world, "LIDAR_STALE.1")


def test_equal_scans_while_moving_are_a_frozen_lidar() -> None:
    world = World().driving((5.0, 0.0))
    world.lidar_frozen = True
    world.run(0.7)
    assert raised(world, "LIDAR_STALE.0")
    assert world.is_in(Mode.STOPPING)


@pytest.mark.parametrize("way", ["silent", "poor"])
def test_a_lost_pose_holds(way: str) -> None:
    world = World().driving((5.0, 0.0))
    if way == "poor":
        world.quality = 0.3
        world.run(0.11)
    else:
        world.localization_silent = True
        until_age(world, world.state.pose.received_s, 31)
    assert raised(world, "POSE_LOST.0")
    assert world.is_in(Mode.STOPPING)
    world.quality, world.localization_silent = 1.0, False
    world.until(Mode.ACTIVE, 2.0)


def test_a_silent_drive_holds_after_80_ms() -> None:
    world = World().driving()
    world.drive_silent = True
    until_age(world, world.state.drive.received_s, 9)
    assert raised(world, "ENC_STALE.0")
    assert world.is_in(Mode.STOPPING)
    world.drive_silent = False
    world.until(Mode.ACTIVE, 2.0)


def test_a_drive_silent_for_250_ms_is_stopped_hardest_and_needs_arming() -> None:
    world = World().driving()
    world.drive_silent = True
    until_age(world, world.state.drive.received_s, 26)
    assert raised(world, "ENC_STALE.1")
    assert world.state.stopping is not None
    assert world.state.stopping.action is Action.FAST1
    world.drive_silent = False
    world.until(Mode.DISARMED, 2.0)
    world.run(1.0)
    world.op("arm")
    world.run(0.05)
    assert not raised(world, "ENC_STALE.1")


def test_a_deaf_drive_holds_after_10_commands_and_faults_after_50() -> None:
    world = World().driving()
    world.drive.deaf = True
    silent_for(world, 13)
    assert raised(world, "DRIVER_NACK.0")
    assert world.is_in(Mode.STOPPING)
    silent_for(world, 60)
    assert raised(world, "DRIVER_NACK.1")
    world.until(Mode.FAULT, 2.0)
    world.drive.deaf = False
    world.run(1.0)
    assert world.asked("reset") == "driver_nack", "clean for less than 2 s"
    world.run(1.5)
    world.op("reset")
    world.tick()
    assert world.is_in(Mode.DISARMED)


def test_a_drive_that_restarted_disarms() -> None:
    world = World().driving()
    world.drive.boot_id = "d1"
    world.drive.angles = (0.0, 0.0)
    before = world.here
    world.tick()
    assert raised(world, "DRIVE_REBOOT.0")
    assert abs(world.here.x_m - before.x_m) < 0.05, "the new encoder's zero is no motion"
    world.until(Mode.DISARMED, 3.0)


def test_lateness_caps_gaps_hold_and_three_gaps_disarm() -> None:
    world = World().driving((5.0, 0.0))
    for _ in range(4):
        world.late(0.006)
        world.tick()
    assert not raised(world, "LOOP_LATE.0")
    world.late(0.006)
    world.tick()
    assert raised(world, "LOOP_LATE.0")
    assert world.state.motion.cap == 0.5
    world.run(1.9)
    assert raised(world, "LOOP_LATE.0")
    world.run(0.2)
    assert not raised(world, "LOOP_LATE.0")
    world.tick(0.11)
    assert raised(world, "LOOP_LATE.1")
    assert world.is_in(Mode.STOPPING)
    world.until(Mode.ACTIVE, 2.0)
    world.tick(0.11)
    world.run(0.6)
    world.tick(0.11)
    assert raised(world, "LOOP_LATE.2")
    world.until(Mode.DISARMED, 3.0)


def test_not_real_time_is_only_shown_on_a_virtual_drive() -> None:
    world = World(real_time=False).driving()
    assert not raised(world, "NOT_RT.0")
    assert not world.shown.drive.real_time


def test_a_base_that_does_not_report_its_dead_man_is_slow_until_it_was_tried() -> None:
    robot = RobotDescription.model_validate({"drive": {"kind": "waveshare", "port": "/dev/x"}})
    for seen_s, up in ((None, {0}), (0.3, set()), (0.7, set()), (0.71, {1}), (nan, {1})):
        world = World(core=replace(config(robot), dead_man_s=seen_s), real_time=True)
        world.tick()
        assert {n for n in (0, 1) if raised(world, f"DEAD_MAN.{n}")} == up
    often = World(real_time=True)
    often.tick()
    assert not raised(often, "DEAD_MAN.0")


def test_the_drives_stop_input_latches_until_reset() -> None:
    world = World().driving()
    world.drive.estop_pressed = True
    world.tick()
    assert world.is_in(Mode.ESTOPPED)
    assert raised(world, "ESTOP.0")
    assert world.told.enable, "torque brakes until the robot stands"
    world.run(2.0)
    assert not world.told.enable
    assert world.asked("reset") == "estop_pressed"
    world.drive.estop_pressed = False
    world.run(1.9)
    assert world.asked("reset") == "estop_just_released"
    world.run(0.2)
    world.op("reset")
    world.tick()
    assert world.is_in(Mode.DISARMED)
    world.run(3.0)
    assert world.is_in(Mode.DISARMED)


def test_an_estop_message_needs_no_proof() -> None:
    world = World().driving()
    assert world.asked("estop", authentic=False) == "ok"
    assert world.is_in(Mode.ESTOPPED)
    assert raised(world, "ESTOP.0")


def test_a_stop_that_does_not_slow_the_robot_cuts_the_torque() -> None:
    world = World().driving((5.0, 0.0))
    world.drive.runs_on = True
    world.stop()
    world.until(Mode.FAULT, 1.5)
    assert not world.told.enable
    assert world.state.fault in {"stop_too_slow", "stop_too_long"}


def test_a_stop_link_that_falls_silent_counts_as_pressed() -> None:
    robot = RobotDescription.model_validate({"inputs": {"estop_link": True}})
    world = World(core=config(robot))
    world.run(3.0)
    assert world.is_in(Mode.SELFTEST)
    assert world.shown.waiting_for == ("estop_link",)
    world.extra = Inbox(estop_link=EstopLink(seq=1, pressed=False))
    world.tick()
    received_s = world.state.buttons.link_received_s
    until_age(world, received_s, 49)
    assert world.is_in(Mode.DISARMED)
    silent_for(world, 2)
    assert world.is_in(Mode.ESTOPPED)
    assert raised(world, "ESTOP.0")
