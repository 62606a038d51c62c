"""Try the wheels of a base of metal, off the ground: which is which, which way, and who stops them.

First by hand, without torque: encoders that count backwards make a regulator run to full speed, so
they are found before a motor turns. Then each motor, slowly, under watch. Then silence, three
times: how long the base drives on by itself. Told the time by a pace, and a person by words; knows
neither file nor terminal.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isclose, tau
from typing import TYPE_CHECKING

from pons.robot.trial_parties import Side, TrialRefusal, opposite_side
from wire import DriveCommand, DriveState

if TYPE_CHECKING:
    from pons.robot.trial_parties import TrialBase, TrialPace, TrialPerson
    from wire import RobotDescription

SPEED_RADPS = 2.0
START_S = 15.0
"""A base that opening its port has reset needs up to eight."""
LISTEN_S = 1.0
SILENT_S = 2.0
LEAST_BATTERY = 0.05
"""A supply that dips resets the controller, and what then looks wrong are not the wires."""
POWER_S = 1.5
SPIN_UP_S = 1.5
SILENCES = 3
GIVE_UP_S = 1.5
"""Of silence beyond what it claims: a base that drives on for so long is told to stop."""
HAND_TURNS = 3
HAND_SHARE = 0.12
"""A person turns a wheel three times to within a twelfth of a turn or so."""
STILL_RAD = 0.05
WRONG_WAY_RAD = 0.3
OTHER_RAD = 0.5
SLOWED, STOOD = 0.8, 0.1
"""Shares of the speed asked for."""
COASTS_S = 0.6
RUNAWAY_TIMES, RUNAWAY_RADPS = 3.0, 1.0
UNSEEN_S = 0.1
"""What a dead-man may take beyond its time-out: a state's way to us, and the motor's lag."""
SPEED_SHARE = 0.35
ALIKE_SHARE = 0.4


@dataclass(frozen=True, slots=True)
class WheelFindings:
    """Hold what the wheels did."""

    dead_man_s: float
    """From the last command until the wheels stood, the longest of all silences."""
    brake_s: float
    """Of that, from the first loss of speed until they stood."""
    report_hz: float
    hand_ratio: dict[Side, float]
    """Turn as the encoder counted it, over what a person turned."""


class WheelTrial:
    """Hold one trial."""

    def __init__(
        self,
        base: TrialBase,
        robot: RobotDescription,
        pace: TrialPace,
        person: TrialPerson,
        boot: str,
    ) -> None:
        self._base, self._robot, self._pace, self._person = base, robot, pace, person
        self._boot = boot
        self._seq = 0
        self._newest: DriveState | None = None
        self._speed_radps = min(SPEED_RADPS, robot.limits.max_wheel_radps / 2)

    def run(self) -> WheelFindings:
        """Try everything; the base is halted however this ends.

        Raises:
            TrialRefusal: something must be mended first.
        """
        tell = self._person.tell
        try:
            tell("listen")
            report_hz = self._listen()
            tell("hand_left", f"{report_hz:.0f} Hz")
            ratio: dict[Side, float] = {"left": self._turn_by_hand("left")}
            tell("hand_right", f"{HAND_TURNS * ratio['left']:+.2f} × 360°")
            ratio["right"] = self._turn_by_hand("right")
            tell("power_left", f"{HAND_TURNS * ratio['right']:+.2f} × 360°")
            # Each forward before any goes back: a reversed motor, held at zero by its regulator,
            # creeps off in time, and would then be taken for two motors on one wire.
            tell("power_right", self._turn_by_motor(1, 0))
            tell("power_back", self._turn_by_motor(0, 1))
            tell("silence", f"{self._turn_by_motor(-1, 0)}, {self._turn_by_motor(0, -1)}")
            silences = [self._fall_silent() for _ in range(SILENCES)]
        finally:
            self._base.halt()
        dead_man_s, brake_s = (max(each) for each in zip(*silences, strict=True))
        return WheelFindings(dead_man_s, brake_s, report_hz, ratio)

    # What it hears ------------------------------------------------------------------------------

    def _tick(
        self, left_radps: float | None = None, right_radps: float = 0.0, *, enable: bool = True
    ) -> list[DriveState]:
        """Send a command, or none; return the states that came.

        Raises:
            TrialRefusal: ``trial_rebooted`` or ``trial_stop_pressed``; or as the person ends it.
        """
        self._person.require_watch()
        self._seq += 1
        if left_radps is None:
            self._base.ask()
        else:
            self._base.write(
                DriveCommand(
                    boot=self._boot,
                    seq=self._seq,
                    left_radps=left_radps,
                    right_radps=right_radps,
                    enable=enable,
                )
            )
        self._pace.wait()
        states = [state for state in self._base.read() if isinstance(state, DriveState)]
        for state in states:
            if self._newest is not None and state.boot_id != self._newest.boot_id:
                raise TrialRefusal(
                    "trial_rebooted", f"{self._newest.boot_id} became {state.boot_id}"
                )
            if state.estop_pressed is not False:
                raise TrialRefusal("trial_stop_pressed", f"it reads {state.estop_pressed}")
            self._newest = state
        return states

    def _hear(self, seconds: float) -> list[DriveState]:
        """Say nothing for a while; return what came.

        Raises:
            TrialRefusal: ``trial_silent``, or as ``_tick``.
        """
        until_s = self._pace.now_s() + seconds
        states = []
        while self._pace.now_s() < until_s:
            states += self._tick()
        if not states:
            raise TrialRefusal("trial_silent", f"no state within {seconds:g} s")
        return states

    def _listen(self) -> float:
        """See that it stands without a command; return how often it reports [Hz].

        Raises:
            TrialRefusal: ``trial_rolls``, ``trial_battery`` or ``trial_no_time_out``.
        """
        until_s = self._pace.now_s() + START_S
        while self._newest is None and self._pace.now_s() < until_s:
            self._tick(0.0, 0.0, enable=False)
        self._hear(LISTEN_S / 2)  # what lay in the port is of another time
        states = self._hear(LISTEN_S)
        for side in ("left", "right"):
            rolled_rad = max(abs(_angle(one, side) - _angle(states[0], side)) for one in states)
            if rolled_rad > STILL_RAD:
                raise TrialRefusal("trial_rolls", f"{side} {rolled_rad:.2f} rad")
        battery = states[-1].battery
        if battery is not None and not battery >= LEAST_BATTERY:
            raise TrialRefusal("trial_battery", f"{battery:.0%}, at least {LEAST_BATTERY:.0%}")
        if states[-1].timed_out is False:
            raise TrialRefusal("trial_no_time_out", "after 1.5 s without a command")
        return len(states) / LISTEN_S

    # By hand ------------------------------------------------------------------------------------

    def _turn_by_hand(self, side: Side) -> float:
        """Have a person turn a wheel forward; return the encoder's share of that.

        Raises:
            TrialRefusal: ``hand_none``, ``hand_swapped``, ``hand_backwards``, ``hand_ticks``, or
                ``trial_silent`` while the person turns: nobody turns a wheel that nobody counts.
        """
        before = self._hear(0.2)[-1]
        self._person.ask(f"hand_{side}")
        heard_s = self._pace.now_s()
        while not self._person.has_answered():
            if self._tick():
                heard_s = self._pace.now_s()
            elif self._pace.now_s() - heard_s > SILENT_S:
                raise TrialRefusal("trial_silent", f"no state within {SILENT_S:g} s")
        after = self._hear(0.2)[-1]
        turned = (_angle(after, side) - _angle(before, side)) / tau
        other_side = opposite_side(side)
        other = (_angle(after, other_side) - _angle(before, other_side)) / tau
        counted = f"{side} {turned:+.2f} turns, {other_side} {other:+.2f}"
        if abs(turned) < 0.2 and abs(other) < 0.2:
            raise TrialRefusal("hand_none", counted)
        if abs(other) > abs(turned):
            raise TrialRefusal("hand_swapped", counted)
        if turned < 0:
            raise TrialRefusal("hand_backwards", counted)
        ratio = turned / HAND_TURNS
        if not isclose(ratio, 1.0, abs_tol=HAND_SHARE):
            ticks = self._robot.drive.ticks_per_turn
            likely = "" if ticks is None else f"; ticks_per_turn may be {round(ticks * ratio)}"
            raise TrialRefusal("hand_ticks", f"{counted}, {HAND_TURNS} were asked for{likely}")
        return ratio

    # By motor -----------------------------------------------------------------------------------

    def _turn_by_motor(self, left: int, right: int) -> str:
        """Turn one wheel slowly, and let the base stand again; return how far it went.

        Raises:
            TrialRefusal: ``power_none``, ``power_swapped``, ``power_backwards``, ``power_both``,
                ``power_runaway`` or ``power_speed``.
        """
        side: Side = "left" if left else "right"
        sign = left or right
        start = self._hear(0.1)[-1]
        orders = left * self._speed_radps, right * self._speed_radps
        until_s = self._pace.now_s() + POWER_S
        while self._pace.now_s() < until_s:
            for state in self._tick(*orders):
                self._watch_motor(start, state, side, sign)
        if self._newest is None:
            raise TrialRefusal("trial_silent", "while a motor turned")
        moved_rad = sign * (_angle(self._newest, side) - _angle(start, side))
        expected_rad = self._speed_radps * POWER_S
        said = f"{side} {sign * moved_rad:+.2f} rad, {sign * expected_rad:+.2f} were asked for"
        if moved_rad < 0.2 * expected_rad:
            raise TrialRefusal("power_none", said)
        if not isclose(moved_rad, expected_rad, rel_tol=SPEED_SHARE):
            raise TrialRefusal("power_speed", said)
        self._stand()
        return f"{sign * moved_rad:+.1f} rad"

    def _watch_motor(self, start: DriveState, now: DriveState, side: Side, sign: int) -> None:
        moved_rad = sign * (_angle(now, side) - _angle(start, side))
        other = opposite_side(side)
        other_rad = _angle(now, other) - _angle(start, other)
        said = f"{side} {sign * moved_rad:+.2f} rad, {other} {other_rad:+.2f}"
        if abs(other_rad) > OTHER_RAD:
            if moved_rad < WRONG_WAY_RAD:
                raise TrialRefusal("power_swapped", said)
            # Two motors on one wire turn alike. One that creeps off while it is told to stand is
            # held by a regulator whose motor is reversed.
            alike = isclose(other_rad, sign * moved_rad, rel_tol=ALIKE_SHARE)
            if alike:
                raise TrialRefusal("power_both", said)
            raise TrialRefusal("power_backwards", f"{said}: the {other} one was told to stand")
        if moved_rad < -WRONG_WAY_RAD:
            raise TrialRefusal("power_backwards", said)
        fastest_radps = max(abs(now.left_radps), abs(now.right_radps))
        if fastest_radps > RUNAWAY_TIMES * self._speed_radps + RUNAWAY_RADPS:
            raise TrialRefusal("power_runaway", f"{fastest_radps:.1f} rad/s; {said}")

    def _stand(self) -> None:
        until_s = self._pace.now_s() + 0.5
        while self._pace.now_s() < until_s:
            self._tick(0.0, 0.0)

    # In silence ---------------------------------------------------------------------------------

    def _fall_silent(self) -> tuple[float, float]:
        """Drive both wheels, say nothing more; return dead-man and braking [s].

        Raises:
            TrialRefusal: ``dead_man_none``, ``dead_man_late``, ``dead_man_untold``, ``coasts`` or
                ``power_speed``.
        """
        speed_radps, claimed_s = self._speed_radps, self._robot.drive.dead_man_s
        until_s = self._pace.now_s() + SPIN_UP_S
        while self._pace.now_s() < until_s:
            self._tick(speed_radps, speed_radps)
        if self._newest is None or _slower(self._newest) < SLOWED * speed_radps:
            seen = "nothing" if self._newest is None else f"{_slower(self._newest):.2f} rad/s"
            raise TrialRefusal("power_speed", f"{seen}, {speed_radps:g} were asked for")
        last_s = self._pace.now_s()  # of the last command's tick, so that it counts as older
        slowed_s = stood_s = None
        while stood_s is None:
            passed_s = self._pace.now_s() - last_s
            if passed_s > claimed_s + GIVE_UP_S:
                self._base.halt()
                code = "dead_man_none" if slowed_s is None else "coasts"
                raise TrialRefusal(code, f"it turns {passed_s:.1f} s after the last command")
            for state in self._tick():
                passed_s = self._pace.now_s() - last_s
                if slowed_s is None and _faster(state) < SLOWED * speed_radps:
                    slowed_s = passed_s
                if _faster(state) < STOOD * speed_radps:
                    stood_s = passed_s
                    break
        slowed_s = stood_s if slowed_s is None else slowed_s
        if stood_s - slowed_s > COASTS_S:
            raise TrialRefusal("coasts", f"{stood_s - slowed_s:.2f} s, at most {COASTS_S:g}")
        allowed_s = claimed_s + self._robot.drive.lag_s + UNSEEN_S
        if slowed_s > allowed_s:
            raise TrialRefusal(
                "dead_man_late", f"after {slowed_s:.2f} s; {claimed_s:g} s are claimed"
            )
        self._hear(0.2)
        if self._newest.timed_out is False:
            raise TrialRefusal("dead_man_untold", "it stands and says that it did not time out")
        return stood_s, stood_s - slowed_s


def _angle(state: DriveState, side: Side) -> float:
    return state.left_rad if side == "left" else state.right_rad


def _slower(state: DriveState) -> float:
    return min(abs(state.left_radps), abs(state.right_radps))


def _faster(state: DriveState) -> float:
    return max(abs(state.left_radps), abs(state.right_radps))
