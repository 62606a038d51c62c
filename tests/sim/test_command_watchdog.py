"""The drive's dead-man: an old command never keeps wheels turning."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.command_watchdog import DeadMan, towards_zero
from wire import DriveCommand

TICK_S = 0.01


def command(
    seq: int, left: float = 5.0, right: float = 5.0, *, boot: str = "b1", enable: bool = True
) -> DriveCommand:
    return DriveCommand(boot=boot, seq=seq, left_radps=left, right_radps=right, enable=enable)


def dead_man() -> DeadMan:
    return DeadMan(timeout_s=0.2, ramp_radps2=25.0)


def test_nothing_turns_before_the_first_command() -> None:
    wheels = dead_man().wheels(100.0)
    assert (wheels.left_radps, wheels.torque, wheels.timed_out) == (0.0, False, True)


def test_a_command_holds_for_the_time_out_and_no_longer() -> None:
    drive = dead_man()
    drive.receive(command(1), 10.0)
    assert drive.wheels(10.0).left_radps == 5.0
    at_the_edge = drive.wheels(10.2)
    assert (at_the_edge.left_radps, at_the_edge.timed_out) == (5.0, False)
    past = drive.wheels(10.21)
    assert past.timed_out
    assert past.left_radps == pytest.approx(5.0 - 25.0 * 0.01)


def test_after_the_ramp_the_torque_goes_off() -> None:
    drive = dead_man()
    drive.receive(command(1, left=5.0, right=-2.5), 0.0)
    seen = [drive.wheels(tick * TICK_S) for tick in range(60)]
    speeds = [wheels.left_radps for wheels in seen]
    assert speeds == sorted(speeds, reverse=True)
    last = seen[-1]
    assert (last.left_radps, last.right_radps, last.torque, last.timed_out) == (0, 0, False, True)
    moving = [wheels for wheels in seen if wheels.left_radps or wheels.right_radps]
    assert all(wheels.torque for wheels in moving)
    assert len(moving) == pytest.approx(41, abs=1)  # 0.2 s of command and 0.2 s of ramp


def test_a_freeze_counts_as_time_that_passed() -> None:
    drive = dead_man()
    drive.receive(command(1), 0.0)
    drive.wheels(0.0)
    after = drive.wheels(7.0)
    assert (after.left_radps, after.torque, after.timed_out) == (0.0, False, True)


def test_repeats_and_the_past_are_no_sign_of_life() -> None:
    drive = dead_man()
    assert drive.receive(command(5), 0.0)
    assert not drive.receive(command(5), 0.15)
    assert not drive.receive(command(4, left=9.0), 0.15)
    assert drive.wheels(0.25).timed_out
    assert drive.echo == ("b1", 5)


def test_another_bridge_starts_its_own_count() -> None:
    drive = dead_man()
    drive.receive(command(500), 0.0)
    assert drive.receive(command(1, left=1.0, boot="b2"), 0.1)
    assert drive.wheels(0.1).left_radps == 1.0
    assert drive.echo == ("b2", 1)


def test_a_fresh_command_ends_the_time_out() -> None:
    drive = dead_man()
    drive.receive(command(1), 0.0)
    assert drive.wheels(5.0).timed_out
    drive.receive(command(2, left=1.0), 5.0)
    wheels = drive.wheels(5.0)
    assert (wheels.left_radps, wheels.torque, wheels.timed_out) == (1.0, True, False)


def test_disabled_means_no_torque_at_once() -> None:
    drive = dead_man()
    drive.receive(command(1), 0.0)
    drive.wheels(0.0)
    drive.receive(command(2, enable=False), 0.01)
    wheels = drive.wheels(0.01)
    assert (wheels.left_radps, wheels.torque, wheels.timed_out) == (0.0, False, False)


def test_a_disabled_drive_stays_without_torque_when_its_time_runs_out() -> None:
    drive = dead_man()
    drive.receive(command(1, enable=False), 0.0)
    drive.wheels(0.0)
    assert not drive.wheels(0.3).torque


@given(st.floats(-1e3, 1e3), st.floats(0.0, 1e3))
def test_towards_zero_never_passes_it(value: float, step: float) -> None:
    moved = towards_zero(value, step)
    assert abs(moved) <= abs(value)
    assert moved * value >= 0.0


@given(st.lists(st.tuples(st.floats(0.0, 0.5), st.booleans()), max_size=40))
def test_without_commands_for_long_enough_there_is_never_torque(
    script: list[tuple[float, bool]],
) -> None:
    drive, now_s, received_s = dead_man(), 0.0, -1.0
    for seq, (pause_s, sends) in enumerate(script):
        now_s += pause_s
        if sends:
            drive.receive(command(seq), now_s)
            received_s = now_s
        wheels = drive.wheels(now_s)
        assert wheels.timed_out == (now_s - received_s > 0.2 or received_s < 0.0)
        if now_s - received_s > 0.2 + 0.2 + 0.5:  # time-out, ramp from 5 rad/s, longest pause
            assert not wheels.torque
