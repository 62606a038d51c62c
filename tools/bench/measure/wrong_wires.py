"""Measure what a robot with wrong wires does under the bridge: how far it goes before it stands.

In lockstep, with the model of the pons_mcu firmware on a line whose wheels or lidar are wired
wrongly, in a drive that nobody tried before (`pons robot try` would have refused each). The goal is
a place straight ahead; what counts is the way of the robot's middle until the bridge stands for
good, and which rows it names.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict, dataclass
from functools import partial
from math import hypot
from random import Random
from typing import TYPE_CHECKING, Any

from sim.twin.pons_mcu import PonsMcuFirmware
from tools.bench.report import ReportRow, row_of
from tools.lockstep import TICK_S, LockstepWorld
from wire import Mode, RobotDescription
from wire.drive_config import DriveConfig

if TYPE_CHECKING:
    from tools.bench.context import BenchLab
    from wire import DriveState

NAME = "wrong_wires"
TITLE = "wrong wires: way until the robot stands, and what it says"
LONG_ONLY = True
CONFIG = DriveConfig(kind="pons_mcu", port="/dev/line", ticks_per_turn=4096)
FREE_RADPS = 20.0
TRIP_S = 0.5
"""Our firmware takes the torque away from a wheel that disobeys for so long."""
WATCH_S = 20.0
STANDS_S = 2.0
GOAL_M = 0.3
WIRINGS = (
    "none",
    "motors swapped",
    "encoders swapped",
    "left motor reversed",
    "right motor reversed",
    "left encoder reversed",
    "right encoder reversed",
    "both motors reversed",
    "left encoder dead",
    "ticks x 0.5",
    "ticks x 2",
)


def measure(lab: BenchLab) -> list[ReportRow]:
    """Measure each wiring from several poses' noise."""
    rows = []
    for wiring in WIRINGS:
        take = partial(_trial_slice, wiring)
        found = [WireTrial(**one) for one in lab.slices(wiring, lab.count(2, 20), take)]
        rows.append(_row(wiring, found))
    return rows


@dataclass(frozen=True, slots=True)
class WireTrial:
    """Tell how one drive with wrong wires ended."""

    way_m: float
    stood: bool
    rows: tuple[str, ...]
    contacts: int


class WronglyWiredFirmware(PonsMcuFirmware):
    """Regulate each wheel by the encoder that the controller sees, through wrong wires."""

    def __init__(self, config: DriveConfig, wiring: str) -> None:
        super().__init__(config)
        self._wiring = wiring
        self._seen: tuple[float, float] = (0.0, 0.0)
        self._integral = [0.0, 0.0]
        self._disobeyed_s = 0.0
        self._tripped = False

    def motors(self, now_s: float) -> tuple[float, float, bool]:
        """Return what the wheels truly do: the regulation's duty, through the wires."""
        left, right, torque = super().motors(now_s)
        if not torque:
            self._integral, self._disobeyed_s, self._tripped = [0.0, 0.0], 0.0, False
            return 0.0, 0.0, False
        duties = [self._regulate(side, asked) for side, asked in enumerate((left, right))]
        if self._tripped:
            return 0.0, 0.0, False
        if self._wiring == "motors swapped":
            duties.reverse()
        if self._wiring in ("left motor reversed", "both motors reversed"):
            duties[0] = -duties[0]
        if self._wiring in ("right motor reversed", "both motors reversed"):
            duties[1] = -duties[1]
        return duties[0], duties[1], True

    def say(self, body: DriveState, now_s: float) -> bytes:
        """Report what the encoders, wrongly wired, have counted."""
        seen = self._through_wires(body)
        self._seen = seen.left_radps, seen.right_radps
        return super().say(seen, now_s)

    def _regulate(self, side: int, asked: float) -> float:
        error = asked - self._seen[side]
        grown = self._integral[side] + 5.0 * error * TICK_S
        self._integral[side] = min(max(grown, -FREE_RADPS), FREE_RADPS)
        duty = min(max(asked + 0.3 * error + self._integral[side], -FREE_RADPS), FREE_RADPS)
        along = self._seen[side] if duty > 0.0 else -self._seen[side]
        disobeys = abs(duty) > 0.4 * FREE_RADPS and along < 0.3
        self._disobeyed_s = self._disobeyed_s + TICK_S if disobeys else self._disobeyed_s
        self._tripped |= self._disobeyed_s > TRIP_S
        return duty

    def _through_wires(self, body: DriveState) -> DriveState:
        left, right = (body.left_rad, body.left_radps), (body.right_rad, body.right_radps)
        if self._wiring == "encoders swapped":
            left, right = right, left
        if self._wiring == "left encoder reversed":
            left = -left[0], -left[1]
        if self._wiring == "right encoder reversed":
            right = -right[0], -right[1]
        if self._wiring == "left encoder dead":
            left = 0.0, 0.0
        times = {"ticks x 0.5": 0.5, "ticks x 2": 2.0}.get(self._wiring, 1.0)
        return body.model_copy(
            update={
                "left_rad": left[0] * times,
                "left_radps": left[1] * times,
                "right_rad": right[0] * times,
                "right_radps": right[1] * times,
            }
        )


def _trial_slice(wiring: str, index: int) -> dict[str, Any]:
    return asdict(drive(wiring, index))


def drive(wiring: str, seed: int) -> WireTrial:
    """Give a goal to a robot with wrong wires; return its way until it stood for good."""
    world = LockstepWorld(
        site="home",
        seed=seed,
        robot=RobotDescription(drive=CONFIG),
        firmware=lambda robot: WronglyWiredFirmware(robot.drive, wiring),
    )
    world.run(Random(f"{wiring} {seed}").uniform(2.0, 4.0))
    world.say("go to the kitchen")
    rows = dict[str, None]()
    way_m, stood_s, last = 0.0, 0.0, world.truth
    for _ in range(round(WATCH_S / TICK_S)):
        world.tick()
        now = world.truth
        way_m += hypot(now.x_m - last.x_m, now.y_m - last.y_m)
        last = now
        rows |= dict.fromkeys(row.row for row in world.status.rows)
        stood_s = stood_s + TICK_S if world.standing else 0.0
        has_begun = way_m > 0.01 or world.status.mode is not Mode.ACTIVE
        if has_begun and rows and stood_s > STANDS_S:
            return WireTrial(way_m, True, tuple(rows), world.contacts)
    return WireTrial(way_m, world.standing, tuple(rows), world.contacts)


def _row(wiring: str, trials: list[WireTrial]) -> ReportRow:
    seen = Counter(row for one in trials for row in one.rows)
    note = (
        f"stood {sum(one.stood for one in trials)} of {len(trials)}; "
        f"contacts {sum(one.contacts for one in trials)}; rows {dict(seen)}"
    )
    goal = "" if wiring == "none" else f"<= {GOAL_M}"
    return row_of(f"{wiring}: way", "m", goal, [one.way_m for one in trials], note)
