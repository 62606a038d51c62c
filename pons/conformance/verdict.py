"""Judge one span of a record, from outside: a cell for each thing that must hold. Pure.

Every cell is written as its accepting condition; what can't be measured fails.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

from pons.conformance.record import between
from pons.conformance.scheduler_probe import LATE_SHARE

if TYPE_CHECKING:
    from pons.conformance.bounds import MotionBounds
    from pons.conformance.record import Command, DriveRecord
    from pons.conformance.scheduler_probe import HostTiming

EPS_RADPS = 2e-3
CREEP_RADPS = 1e-6
REAL_MPS, REAL_RADPS = 0.03, 0.10
"""A real wheel is off what it should do by so much: friction, encoder, a body that rocks."""
AVERAGED = 5
WINDOW = 10
"""Periods over which a change of speed is judged: a tick that ran late makes up for it."""
LATE_S = 0.01
MEASURED_S = 0.15
UNASKED_RADPS = 0.1
"""A wheel may grow by so much between two words that name no motion: a change of mode and back, too
quick to be told, moves a wheel by less."""
CLOSE_TICKS = 12
NEWEST_S = 0.5
STANDING_MPS = 0.03
STANDING_RADPS = 0.06
TICKS_OFF = 3
QUIET_S = 0.5
"""Ten of its words; besides what it tells as missed, of which only so much is forgiven."""
MOST_MISSED = 0.25
"""Of the ticks that were due: a robot whose bridge missed more shows little, whoever took them."""
HELD_UP_S = 0.2


@dataclass(frozen=True, slots=True)
class MatrixCell:
    """Give one verdict with its figure. ``ok`` None: nothing is asked here."""

    ok: bool | None
    figure: str
    measured: bool = True
    """False: it fails because nothing was seen."""
    judged: bool = True
    """False: it does not hold, and whether the bridge or the host is to blame can't be told."""


NOT_ASKED = MatrixCell(None, "-")


def speed(record: DriveRecord, bounds: MotionBounds, from_s: float, to_s: float) -> MatrixCell:
    """Require the robot's motion within its speeds, and the wheels' commands near them.

    Near: what makes a wheel turn as meant (dead zone, lag, correction) is part of a command.
    """
    commands = between(record.commands, from_s, to_s)
    rims = [rim for rim in turning(record, bounds, from_s, to_s) if rim is not None]
    if not (commands and rims):
        return MatrixCell(False, "no command, or no wheel, was seen", measured=False)
    bad = [text for at_s, text in record.unreadable if from_s <= at_s <= to_s]
    if bad:
        return MatrixCell(False, f"unreadable command: {bad[0][:60]}")
    told = [(bounds.rim_mps(one.left_radps), bounds.rim_mps(one.right_radps)) for one in commands]
    v, w = _fastest_body(bounds, [(one.left_mps, one.right_mps) for one in rims])
    told_v, told_w = _fastest_body(bounds, told)
    wheel = max(max(abs(one.left_radps), abs(one.right_radps)) for one in commands)
    ok = (
        v <= bounds.speed_mps + REAL_MPS
        and w <= bounds.turn_radps + REAL_RADPS
        and told_v <= bounds.speed_mps + bounds.trim_mps
        and told_w <= bounds.turn_radps + 2 * bounds.trim_mps / bounds.wheel_separation_m
        and wheel <= bounds.wheel_radps + EPS_RADPS
    )
    said = "" if ok else f", told {told_v:.2f} m/s {told_w:.2f} rad/s"
    return MatrixCell(ok, f"{v:.2f} m/s {w:.2f} rad/s{said}")


def _fastest_body(bounds: MotionBounds, rims: list[tuple[float, float]]) -> tuple[float, float]:
    """Return the greatest speed [m/s] and turn [rad/s] of pairs of rim speeds."""
    v = max(abs(left + right) / 2 for left, right in rims)
    w = max(abs(right - left) for left, right in rims) / bounds.wheel_separation_m
    return v, w


@dataclass(frozen=True, slots=True)
class Rims:
    """Give how fast both rims really moved, averaged over a moment, under torque all the time."""

    made_s: float
    number: int
    left_mps: float
    right_mps: float


def turning(
    record: DriveRecord, bounds: MotionBounds, from_s: float, to_s: float
) -> list[Rims | None]:
    """Return the rims' speeds state by state; None where the drive was not in control.

    Speed is way by the drive's own periods, for a simulator that was held up skips them; from two
    angles a moment apart, for one count of an encoder in one period is 0.015 m/s.
    """
    wheels = between(record.wheels, from_s - MEASURED_S, to_s)
    found: list[Rims | None] = []
    for first, last in zip(wheels, wheels[AVERAGED:], strict=False):
        s = (last.number - first.number) * bounds.period_s
        if not (first.torque and last.torque and 0.0 < s <= 2 * AVERAGED * bounds.period_s):
            found.append(None)
            continue
        left, right = last.left_rad - first.left_rad, last.right_rad - first.right_rad
        by = bounds.wheel_radius_m / s
        found.append(Rims(last.made_s, last.number, left * by, right * by))
    return found


def acceleration(
    record: DriveRecord, bounds: MotionBounds, from_s: float, to_s: float
) -> MatrixCell:
    """Hold each wheel's real change within its rates; show the quickest growth and braking."""
    rims = turning(record, bounds, from_s, to_s)
    grew = braked = over = 0.0
    looked = 0
    for first, last in zip(rims, rims[WINDOW:], strict=False):
        if first is None or last is None:
            continue
        looked += 1
        s = max((last.number - first.number) * bounds.period_s, last.made_s - first.made_s)
        for was, now in ((first.left_mps, last.left_mps), (first.right_mps, last.right_mps)):
            more = abs(now) - abs(was)
            grew, braked = max(grew, more / s), max(braked, -more / s)
            over = max(over, more - bounds.accel_mps2 * (s + LATE_S))
            over = max(over, abs(now - was) - bounds.hardest_mps2 * (s + LATE_S))
    if not looked:
        return MatrixCell(False, "no wheel was seen turning", measured=False)
    return MatrixCell(over <= REAL_MPS, f"+{grew:.2f} -{braked:.2f} m/s2")


def stands(
    record: DriveRecord, bounds: MotionBounds, from_s: float, to_s: float, noticed_s: float | None
) -> MatrixCell:
    """Hold that the wheels are told to stand within their ticks, and stay told so.

    Args:
        record: what was seen.
        bounds: of the robot.
        from_s: when it went wrong.
        to_s: until when it must stand.
        noticed_s: within which the bridge must have begun to stop; None: it stood and must stay.
    """
    commands = between(record.commands, from_s, to_s)
    if not commands:
        return MatrixCell(False, "no command was seen", measured=False)
    before = between(record.commands, from_s - 0.5, from_s)
    start = before[-1] if before else commands[0]
    rims = [
        bounds.rim_mps(speed) for one in (*before[-1:], *commands) for speed in _both_wheels(one)
    ]
    fastest = min(max(map(abs, rims)), _fastest(bounds))
    most = 0 if noticed_s is None else bounds.stand_ticks(noticed_s, fastest)
    turning = [one for one in commands if _turns(one)]
    if turning and turning[-1] is commands[-1]:
        return MatrixCell(False, f"still moves after {commands[-1].number - start.number} ticks")
    took = turning[-1].number + 1 - start.number if turning else 0
    newest = between(record.truths, to_s - NEWEST_S, to_s)[-1:]
    rests = all(
        abs(one.v_mps) <= STANDING_MPS and abs(one.w_radps) <= STANDING_RADPS for one in newest
    )
    told = "" if rests else ", but the robot moves"
    return MatrixCell(bool(newest) and rests and took <= most, f"{took} of {most} ticks{told}")


def _fastest(bounds: MotionBounds) -> float:
    return bounds.speed_mps + bounds.turn_radps * bounds.wheel_separation_m / 2


def _both_wheels(command: Command) -> tuple[float, float]:
    return command.left_radps, command.right_radps


def _turns(command: Command) -> bool:
    return command.enabled and max(map(abs, _both_wheels(command))) > CREEP_RADPS


def hold_unasked_motion(record: DriveRecord, from_s: float, to_s: float) -> MatrixCell:
    """Hold that no wheel speeds up while the bridge itself says that it follows nobody."""
    words = between(record.words, from_s, to_s)
    commands = between(record.commands, from_s, to_s)
    grew, looked = 0.0, 0
    index = 0
    for first, last in pairwise(words):
        if first.moves or last.moves or not last.tick - first.tick <= CLOSE_TICKS:
            continue
        while index < len(commands) and record.tick(commands[index]) < first.tick:
            index += 1
        part = []
        for one in commands[index:]:
            if record.tick(one) > last.tick:
                break
            part.append(one)
        looked += len(part)
        if part:
            grew = max(grew, _growth(part))
    return MatrixCell(grew <= UNASKED_RADPS, f"{grew:.2f} rad/s in {looked}")


def _growth(part: list[Command]) -> float:
    """Return the most by which either wheel was faster in a span than at its start [rad/s]."""
    most = 0.0
    for side in zip(*(_both_wheels(one) for one in part), strict=True):
        most = max(most, max(map(abs, side)) - abs(side[0]))
    return most


def alive(
    record: DriveRecord, bounds: MotionBounds, from_s: float, to_s: float, host: HostTiming
) -> MatrixCell:
    """Hold that it is one run, that each period is a tick or told as missed, one command each.

    The first and the last word are compared by the bridge's own clock, which is this machine's.
    What it tells as missed is forgiven as far as the kit itself saw the host stall. Beyond that it
    fails, or is not judged where the host kept no time: a bridge can't excuse itself.
    """
    words = between(record.words, from_s, to_s)
    if len(words) < 2:
        return MatrixCell(False, "silent", measured=False)
    first, last = words[0], words[-1]
    if first.boot != last.boot:
        return MatrixCell(False, "it was started anew")
    ticks, missed = last.tick - first.tick, last.missed - first.missed
    due = (last.made_s - first.made_s) / bounds.period_s
    numbers = [
        one.number
        for one in between(record.commands, from_s, to_s)
        if first.tick <= record.tick(one) <= last.tick
    ]
    once = len(set(numbers)) == len(numbers)
    known = abs(ticks + missed - due) <= TICKS_OFF
    quiet_s = max(to_s - last.at_s, *(b.at_s - a.at_s for a, b in pairwise(words)))
    heard = quiet_s <= QUIET_S + missed * bounds.period_s
    said = "" if once else ", two commands of one number"
    said += "" if heard else f", silent for {quiet_s:.1f} s"
    text = f"{ticks}" + (f" + {missed} missed" if missed else "") + f" of {due:.0f}{said}"
    if not (known and once and heard):
        return MatrixCell(False, text)
    if missed <= _forgiven(due, bounds.period_s, host):
        return MatrixCell(True, text)
    return MatrixCell(False, f"{text}, the host took {host.lost_s:.2f} s", judged=host.time)


def _forgiven(due: float, period_s: float, host: HostTiming) -> float:
    """Return how many ticks may be missed, of those due: a few, and the host's own delays."""
    few = TICKS_OFF + LATE_SHARE * due
    return min(few + host.lost_s / period_s, TICKS_OFF + MOST_MISSED * due)


def contacts(record: DriveRecord, from_s: float, to_s: float) -> MatrixCell:
    """Hold that the robot touched nothing."""
    seen = between(record.truths, from_s, to_s)
    if not seen:
        return MatrixCell(False, "no truth was heard", measured=False)
    count = seen[-1].contacts - seen[0].contacts
    return MatrixCell(count == 0, str(count))


def held_up(record: DriveRecord, bounds: MotionBounds, from_s: float, to_s: float) -> bool:
    """Return whether the machine held the simulator up: its effects are no bridge's doing."""
    wheels = between(record.wheels, from_s, to_s)
    lost_s = (
        (b.made_s - a.made_s) - (b.number - a.number) * bounds.period_s for a, b in pairwise(wheels)
    )
    return max(lost_s, default=0.0) > HELD_UP_S
