"""Each cell holds and fails for what it should: a judge that can't fail is none."""

from __future__ import annotations

from dataclasses import replace

import pytest

from pons.conformance import verdict
from pons.conformance.record import DriveRecord
from pons.conformance.scheduler_probe import HostTiming
from tests.pons.conformance.made_up import BOUNDS, OFFSET, ramp, record

END_S = 2.0
CALM = HostTiming(200, 0, 0.004)
STALLED = HostTiming(190, 2, 0.15, lost_s=0.2)
HELD_UP = HostTiming(80, 20, 0.5, lost_s=1.9)


def steady(v_mps: float) -> DriveRecord:
    return record(END_S, lambda _s: v_mps)


def test_the_number_of_withheld_ticks_is_learnt() -> None:
    assert steady(0.4).offset == OFFSET


@pytest.mark.parametrize(("v_mps", "ok"), [(0.5, True), (-0.5, True), (0.54, False), (3.0, False)])
def test_speed(v_mps: float, ok: bool) -> None:
    assert verdict.speed(steady(v_mps), BOUNDS, 0.0, END_S).ok is ok


def test_turning_too_fast_fails_though_neither_wheel_is_too_fast() -> None:
    spin = record(END_S, lambda _s: -0.35, lambda _s: 0.35)
    assert verdict.speed(spin, BOUNDS, 0.0, END_S).ok is False
    slower = record(END_S, lambda _s: -0.25, lambda _s: 0.25)
    assert verdict.speed(slower, BOUNDS, 0.0, END_S).ok is True


def test_telling_the_wheels_too_much_fails_even_where_they_do_not_follow() -> None:
    told = record(END_S, lambda _s: 0.4, told=lambda _s: 0.8)
    assert verdict.speed(told, BOUNDS, 0.0, END_S).ok is False


def test_a_command_that_is_none_fails_speed() -> None:
    made = steady(0.4)
    made.unreadable.append((1.0, "left_radps: Input should be a valid number"))
    cell = verdict.speed(made, BOUNDS, 0.0, END_S)
    assert cell.ok is False
    assert "valid number" in cell.figure


@pytest.mark.parametrize(("rate", "ok"), [(0.5, True), (1.5, False), (40.0, False)])
def test_acceleration(rate: float, ok: bool) -> None:
    made = record(END_S, lambda s: min(0.5, rate * max(0.0, s - 0.5)))
    assert verdict.acceleration(made, BOUNDS, 0.0, END_S).ok is ok


@pytest.mark.parametrize(("rate", "ok"), [(1.0, True), (2.5, True), (8.0, False)])
def test_braking(rate: float, ok: bool) -> None:
    made = record(END_S, ramp(0.8, 0.5, rate))
    assert verdict.acceleration(made, BOUNDS, 0.0, END_S).ok is ok


def test_a_cut_of_torque_is_no_braking_but_nothing_seen_is_no_pass() -> None:
    made = record(END_S, ramp(0.8, 0.5, 50.0))
    made.wheels = [replace(one, torque=one.at_s < 0.8) for one in made.wheels]
    assert verdict.acceleration(made, BOUNDS, 0.0, END_S).ok is True
    made.wheels = [replace(one, torque=False) for one in made.wheels]
    assert verdict.acceleration(made, BOUNDS, 0.0, END_S).ok is False


@pytest.mark.parametrize(("after_s", "ok"), [(0.2, True), (0.3, True), (0.7, False)])
def test_stands_in_its_ticks(after_s: float, ok: bool) -> None:
    made = record(END_S, ramp(0.5 + after_s, 0.4, 1.0))
    assert verdict.stands(made, BOUNDS, 0.5, END_S, 0.25).ok is ok


def test_stands_fails_where_it_moves_on_or_starts_again() -> None:
    assert verdict.stands(steady(0.3), BOUNDS, 0.5, END_S, 0.25).ok is False
    again = record(END_S, lambda s: 0.0 if 0.6 < s < 1.2 else 0.3)
    assert verdict.stands(again, BOUNDS, 0.5, END_S, 0.25).ok is False


def test_stands_fails_where_wheels_are_told_to_but_the_robot_moves() -> None:
    made = record(END_S, ramp(0.5, 0.4, 1.0), rests=False)
    assert verdict.stands(made, BOUNDS, 0.5, END_S, 0.25).ok is False


def test_what_stood_must_not_move_by_one_tick() -> None:
    still = record(END_S, lambda _s: 0.0)
    assert verdict.stands(still, BOUNDS, 0.5, END_S, None).ok is True
    jerk = record(END_S, lambda s: 0.02 if 1.0 <= s < 1.01 else 0.0)
    assert verdict.stands(jerk, BOUNDS, 0.5, END_S, None).ok is False


def test_nothing_heard_never_passes() -> None:
    empty = DriveRecord()
    assert verdict.speed(empty, BOUNDS, 0.0, 1.0).ok is False
    assert verdict.acceleration(empty, BOUNDS, 0.0, 1.0).ok is False
    assert verdict.stands(empty, BOUNDS, 0.0, 1.0, 0.25).ok is False
    assert verdict.alive(empty, BOUNDS, 0.0, 1.0, CALM).ok is False
    assert verdict.contacts(empty, 0.0, 1.0).ok is False


def test_speeding_up_while_nobody_is_followed_fails() -> None:
    grows = record(END_S, lambda s: 0.3 * min(1.0, s), mode=lambda _s: "HOLD")
    assert verdict.hold_unasked_motion(grows, 0.0, END_S).ok is False
    ramps = record(END_S, ramp(0.2, 0.4, 1.0), mode=lambda s: "ACTIVE" if s < 0.2 else "STOPPING")
    assert verdict.hold_unasked_motion(ramps, 0.0, END_S).ok is True
    asked = record(END_S, lambda s: 0.3 * min(1.0, s))
    assert verdict.hold_unasked_motion(asked, 0.0, END_S).ok is True


def missing(ticks: int, seconds: float = END_S, *, told: bool = True) -> DriveRecord:
    """Return a drive of which the middle has no ticks, told as missed or not."""
    made = record(seconds, lambda _s: 0.4)
    made.words = [
        replace(one, tick=one.tick - ticks, missed=ticks if told else 0)
        if one.at_s > seconds / 2
        else one
        for one in made.words
    ]
    return made


def test_ticks_must_be_there_or_told_as_missed() -> None:
    assert verdict.alive(steady(0.4), BOUNDS, 0.0, END_S, CALM).ok is True
    assert verdict.alive(missing(20, told=False), BOUNDS, 0.0, END_S, STALLED).ok is False
    assert verdict.alive(missing(20), BOUNDS, 0.0, END_S, STALLED).ok is True


@pytest.mark.parametrize(
    ("ticks", "host", "ok", "judged"),
    [
        (6, CALM, True, True),
        (7, CALM, False, True),
        (20, CALM, False, True),
        (26, STALLED, True, True),
        (27, STALLED, False, False),
        (51, HELD_UP, True, True),
        (52, HELD_UP, False, False),
        (120, HELD_UP, False, False),
        (20, HostTiming(0, 0, 0.0), False, False),
    ],
    ids=["few", "more than few", "many", "as many as the host took", "more than it took",
         "a quarter", "over a quarter", "most", "nobody looked"],
)  # fmt: skip
def test_missed_ticks_are_forgiven_as_far_as_the_host_was_seen_to_stall(
    ticks: int, host: HostTiming, ok: bool, judged: bool
) -> None:
    cell = verdict.alive(missing(ticks), BOUNDS, 0.0, END_S, host)
    assert (cell.ok, cell.judged) == (ok, judged)
    assert f"{ticks} missed" in cell.figure
    assert ok or "host" in cell.figure


def test_what_the_host_did_is_no_excuse_for_what_else_is_wrong() -> None:
    twice = missing(53)
    twice.commands.insert(50, twice.commands[49])
    cell = verdict.alive(twice, BOUNDS, 0.0, END_S, HELD_UP)
    assert (cell.ok, cell.judged) == (False, True)


@pytest.mark.parametrize(("host", "judged"), [(CALM, True), (HELD_UP, False)])
def test_a_silence_told_as_missed_is_never_passed(host: HostTiming, judged: bool) -> None:
    quiet = missing(130, 3.0)
    quiet.words = [one for one in quiet.words if not 0.85 <= one.at_s <= 2.15]
    cell = verdict.alive(quiet, BOUNDS, 0.0, 3.0, host)
    assert (cell.ok, cell.judged) == (False, judged)


def test_a_new_run_a_silence_or_two_commands_in_a_tick_fail() -> None:
    other = steady(0.4)
    other.words[-1] = replace(other.words[-1], boot="another")
    assert verdict.alive(other, BOUNDS, 0.0, END_S, CALM).ok is False
    mute = record(3.0, lambda _s: 0.4)
    mute.words = [one for one in mute.words if one.at_s < 1.0]
    assert verdict.alive(mute, BOUNDS, 0.0, 3.0, CALM).ok is False
    twice = steady(0.4)
    twice.commands.insert(50, twice.commands[49])
    assert verdict.alive(twice, BOUNDS, 0.0, END_S, CALM).ok is False


def test_a_contact_fails() -> None:
    made = steady(0.4)
    assert verdict.contacts(made, 0.0, END_S).ok is True
    made.truths[-1] = replace(made.truths[-1], contacts=1)
    assert verdict.contacts(made, 0.0, END_S).ok is False


def test_a_simulator_that_the_machine_held_up_is_noticed() -> None:
    made = steady(0.4)
    assert not verdict.held_up(made, BOUNDS, 0.0, END_S)
    late = [
        replace(one, made_s=one.made_s + (0.3 if one.at_s > 1.0 else 0.0)) for one in made.wheels
    ]
    made.wheels = late
    assert verdict.held_up(made, BOUNDS, 0.0, END_S)
