"""Measure drives of metal under faults of their line in mid-drive: what they do, what is told.

In lockstep, with each kind's model, a line that is spoilt both ways, and the shipped drive; every
second time a crate stands a metre ahead from the fault's first moment on. A fault that lets enough
frames through need not be told, unless the robot stood for it.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict, dataclass
from functools import lru_cache, partial
from math import cos, sin
from random import Random
from typing import TYPE_CHECKING, Any

from bridge.drive.serial_drive import SERIAL_PROTOCOLS
from tools.bench.measure.dead_men import robot_of
from tools.bench.report import ReportRow, row_of
from tools.lockstep import TICK_S, LockstepWorld
from tools.lockstep.serial_line import LineFault
from tools.lockstep.world_fork import fork_world
from wire import Mode
from wire.robot import LocalizationConfig

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "line_faults"
TITLE = "drives of metal: faults of the line in mid-drive"
LONG_ONLY = True
BEGIN_S = 6.0
"""The fault comes within so long of cruising."""
FAULT_S = 2.0
"""At least, and a second longer than the base's own dead-man: one that ended with it showed each
Arduino of a silent line driving on, which stood 60 ms later."""
AFTER_S = 3.0
AHEAD_M = 1.0
RESET = "reset"
FAULTS = (*(fault.value for fault in LineFault), RESET)
MUST_STAND = frozenset({"garbage", "silent", "hung_up", "wrong_baud"})
"""Of the others enough frames come through for a robot to drive on."""
LINE_ROWS = frozenset({"ENC_STALE", "DRIVER_NACK", "DRIVE_REBOOT"})
"""The rows that a person looks up for a line: what they say is mended at its plug and supply."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Measure each fault of each kind of drive that has a line."""
    rows = []
    for kind in sorted(SERIAL_PROTOCOLS):
        for fault in FAULTS:
            name, take = f"{kind} {fault}", partial(_trial_slice, kind, fault)
            found = [LineTrial(**one) for one in lab.slices(name, lab.count(2, 50), take)]
            rows.append(_row(kind, fault, found))
    return rows


@dataclass(frozen=True, slots=True)
class LineTrial:
    """Tell what became of one fault of the line."""

    rows: tuple[str, ...]
    """Of the bridge, that came up while the fault stood."""
    stood_s: float | None
    """From the fault until the robot stood; None where it drove on."""
    contacts: int
    moved_unasked: bool
    """It moved again before the fault was mended, or while nothing let it."""
    mode: str
    """After the fault was mended."""


def _trial_slice(kind: str, fault: str, index: int) -> dict[str, Any]:
    return asdict(drive(kind, fault, index))


def drive(kind: str, fault: str, seed: int) -> LineTrial:
    """Spoil the line at a moment of a drive, watch until its base must stand, mend it, watch on."""
    world = fork_world(_cruising(kind))
    world.run(Random(f"{kind} {fault} {seed}").uniform(0.0, BEGIN_S))
    if seed % 2 == 1:
        at = world.truth
        world.sim.place_obstacle(
            at.x_m + AHEAD_M * cos(at.yaw_rad), at.y_m + AHEAD_M * sin(at.yaw_rad)
        )
    before = {row.row for row in world.status.rows}
    _begin(world, fault)
    rows = dict[str, None]()
    stood_s, moved = None, False
    fault_s = max(FAULT_S, 1.0 + world.scene.robot.drive.dead_man_s)
    for tick in range(1, round(fault_s / TICK_S) + 1):
        world.tick()
        rows |= dict.fromkeys(row.row for row in world.status.rows if row.row not in before)
        if stood_s is None and world.standing:
            stood_s = tick * TICK_S
        moved |= stood_s is not None and fault in MUST_STAND and not world.standing
    _end(world)
    for _ in range(round(AFTER_S / TICK_S)):
        world.tick()
        moved |= not world.standing and world.status.mode in _AT_REST and stood_s is not None
    return LineTrial(tuple(rows), stood_s, world.contacts, moved, world.status.mode.value)


_AT_REST = frozenset({Mode.DISARMED, Mode.HOLD, Mode.ESTOPPED, Mode.FAULT})


def _begin(world: LockstepWorld, fault: str) -> None:
    base = world.base
    if base is None:
        raise ValueError("a drive of metal has a line in lockstep")
    if fault == RESET:
        base.twin.reset()
    else:
        base.line.break_down(LineFault(fault))


def _end(world: LockstepWorld) -> None:
    if world.base is not None:
        world.base.line.break_down(None)


@lru_cache(maxsize=8)
def _cruising(kind: str) -> LockstepWorld:
    """Drive off; each fault spoils the same drive at another moment."""
    told = {"localization": LocalizationConfig(kind="stand_in")}  # it is not about the pose
    world = LockstepWorld(site="home", seed=1, robot=robot_of(kind).model_copy(update=told))
    world.say("go to the kitchen")
    world.run_until(lambda w: w.twist.v_mps > 0.08, 60.0)
    world.run(1.0)
    world.run_until(lambda w: not w.waits, 10.0)
    return world


def is_told(fault: str, trial: LineTrial) -> bool:
    """Return whether a row of the line came up, where the fault lets nobody drive on."""
    return fault not in {*MUST_STAND, RESET} or bool(LINE_ROWS & set(trial.rows))


def _row(kind: str, fault: str, trials: list[LineTrial]) -> ReportRow:
    seen = Counter(row for one in trials for row in one.rows)
    note = (
        f"contacts {sum(one.contacts for one in trials)} of {len(trials)}; "
        f"moved unasked {sum(one.moved_unasked for one in trials)}; "
        f"told by a row of the line {sum(is_told(fault, one) for one in trials)}; "
        f"drove on {sum(one.stood_s is None for one in trials)}; rows {dict(seen)}; "
        f"then {dict(Counter(one.mode for one in trials))}"
    )
    stood = [one.stood_s for one in trials if one.stood_s is not None]
    return row_of(f"{kind}, {fault}: stands after", "s", "contacts 0", stood, note)
