"""Measure drives of metal: our firmware's silence, faults of the line in mid-drive, spoilt frames.

The firmware's own bytes run on a simulated board and are judged by its processor's time. Faults of
the line spoil both ways, in lockstep, with model, line and shipped drive; every second time a crate
stands a metre ahead from the fault's first moment on. Spoilt frames: what the reader believes
though it was changed; the checksum lets 1 of 65 536 by.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict, dataclass
from functools import lru_cache, partial
from math import cos, sin, tau
from random import Random
from typing import TYPE_CHECKING, Any

from devices import pons_mcu
from devices.pons_mcu import McuCommand, McuReader, McuState, encode_command, encode_state
from sim.twin.avr_board import BUILD, FAULT_CLOCK, FREE_RADPS, AvrBoard
from tools.bench.figures import none_in
from tools.bench.report import ReportRow, row_of
from tools.lockstep import TICK_S, LockstepWorld
from tools.lockstep.serial_line import LineFault
from tools.lockstep.world_fork import fork_world
from wire import Mode, RobotDescription
from wire.drive_config import DriveConfig

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "drives"
TITLE = "drives of metal: the firmware's silence, faults of the line in mid-drive, spoilt frames"
LONG_ONLY = True
CONFIG = DriveConfig(kind="pons_mcu", port="/dev/line", ticks_per_turn=4096)
STEP_S = 0.001
FRAMES = 1_000_000
SLICES = 10
FAULT_S = 2.0
AFTER_S = 60.0
AHEAD_M = 1.0
RESET = "reset"
FAULTS = (*(fault.value for fault in LineFault), RESET)
MUST_STAND = frozenset({"garbage", "silent", "hung_up", "wrong_baud"})
"""Of the others enough frames come through for a robot to drive on."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Measure all three."""
    rows = []
    if (BUILD / "board").is_file():
        silences = lab.slices("firmware silence", lab.count(10, 100), firmware_silence)
        rows.append(_row("firmware: PWM zero after the time to live", 10.0, list(silences)))
        hangs = lab.slices("firmware hang", lab.count(5, 50), firmware_hang)
        rows.append(_row("firmware: PWM zero after its loop hangs", 75.0, list(hangs)))
    for fault in FAULTS:
        take = partial(_trial_slice, fault)
        found = [LineTrial(**one) for one in lab.slices(f"drive {fault}", lab.count(4, 50), take)]
        rows.append(_drive_row(fault, found))
    each = lab.count(FRAMES // 100, FRAMES) // SLICES
    runs = list(lab.slices("fuzz", SLICES, partial(fuzz, each)))
    return [*rows, *_fuzz_rows(runs)]


def _row(what: str, goal_ms: float, found: list[float]) -> ReportRow:
    worst = max(found, default=float("nan"))
    return row_of(what, "ms", f"<= {goal_ms:.0f}", found, f"max {worst:.0f}, n {len(found)}")


# Our firmware -------------------------------------------------------------------------------------


class _Rig:
    """Drive a board with two motors that follow their duty, one millisecond at a time."""

    def __init__(self, board: AvrBoard, random: Random) -> None:
        self._board = board
        self.ttl_ms = random.randint(*pons_mcu.TTL_MS)
        self._left_mradps = random.randint(-15_000, 15_000)
        self._right_mradps = random.randint(-15_000, 15_000)
        self._radps = [0.0, 0.0]
        self._steps = 0

    def step(self, *, sends: bool, faults: int = 0) -> bool:
        """Run one step; return whether the motors are shorted or without duty."""
        heard = b""
        if sends and self._steps % 10 == 0:
            left_mradps, right_mradps = self._left_mradps, self._right_mradps
            heard = encode_command(
                McuCommand(
                    self._steps, 1, left_mradps, right_mradps, 4096, self.ttl_ms, pons_mcu.ENABLE
                )
            )
        self._steps += 1
        left, right = (radps / tau * 4096 for radps in self._radps)
        pins, _ = self._board.run(
            STEP_S, heard, left_edges_ps=left, right_edges_ps=right, faults=faults
        )
        for side, duty in enumerate((pins.left_duty, pins.right_duty)):
            target = duty / 1000 * FREE_RADPS
            self._radps[side] += (target - self._radps[side]) * STEP_S / 0.05
        return pins.are_still


def firmware_silence(index: int) -> float:
    """Return how long after the time to live of the last command the PWM was zero [ms]."""
    random = Random(f"silence {index}")
    with AvrBoard() as board:
        rig = _Rig(board, random)
        steps = random.randint(30, 100) * 10
        for _ in range(steps + 1):  # the last step sends, and its frame takes 2.5 ms to arrive
            rig.step(sends=True)
        return float(_first_still(rig, rig.ttl_ms + 100, 0) + 1 - rig.ttl_ms)


def firmware_hang(index: int) -> float:
    """Return how long after its loop hung the PWM was zero, while the host goes on [ms]."""
    random = Random(f"hang {index}")
    with AvrBoard() as board:
        rig = _Rig(board, random)
        for _ in range(random.randint(300, 1000)):
            rig.step(sends=True)
        return float(_first_still(rig, 200, FAULT_CLOCK))


def _first_still(rig: _Rig, most: int, faults: int) -> int:
    for passed in range(most):
        if rig.step(sends=bool(faults), faults=faults):
            return passed
    return most


# Faults of the line -------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class LineTrial:
    """Tell what became of one fault of the line."""

    rows: tuple[str, ...]
    """Of the bridge, that stood while the fault did."""
    stood_s: float | None
    """From the fault until the robot stood; None where it drove on."""
    contacts: int
    moved_unasked: bool
    """It moved again before the fault was mended."""
    arrived: bool


def _trial_slice(fault: str, index: int) -> dict[str, Any]:
    return asdict(drive(fault, index))


def drive(fault: str, seed: int) -> LineTrial:
    """Spoil the line at a moment of a drive, watch for FAULT_S, mend it, and see it arrive."""
    world = fork_world(_cruising())
    random = Random(f"{fault} {seed}")
    world.run(random.uniform(0.0, 6.0))
    crate = seed % 2 == 1
    if crate:
        at = world.truth
        world.sim.place_obstacle(
            at.x_m + AHEAD_M * cos(at.yaw_rad), at.y_m + AHEAD_M * sin(at.yaw_rad)
        )
    base = world.base
    if base is None:
        raise ValueError("a drive of metal has a line in lockstep")
    if fault == RESET:
        base.twin.reset()
    else:
        base.line.break_down(LineFault(fault))
    rows = dict[str, None]()
    stood_s, moved = None, False
    for tick in range(1, round(FAULT_S / TICK_S) + 1):
        world.tick()
        rows |= dict.fromkeys(row.row for row in world.status.rows)
        if stood_s is None and world.standing:
            stood_s = tick * TICK_S
        moved |= stood_s is not None and fault in MUST_STAND and not world.standing
    base.line.break_down(None)
    if crate:
        world.sim.remove_obstacle()
    waited_s = 0.0
    while not _has_arrived(world) and waited_s < AFTER_S:
        world.run(1.0)
        waited_s += 1.0
    return LineTrial(tuple(rows), stood_s, world.contacts, moved, waited_s < AFTER_S)


def _has_arrived(world: LockstepWorld) -> bool:
    return world.status.leg is not None and world.status.leg.reached


@lru_cache(maxsize=1)
def _cruising() -> LockstepWorld:
    """Drive off; each fault spoils the same drive at another moment."""
    world = LockstepWorld(site="home", seed=1, robot=RobotDescription(drive=CONFIG))
    world.say("go to the kitchen")
    world.run_until(lambda w: w.status.mode is Mode.ACTIVE and w.twist.v_mps > 0.4, 30.0)
    return world


def _drive_row(fault: str, trials: list[LineTrial]) -> ReportRow:
    seen = Counter(row for one in trials for row in one.rows)
    note = (
        f"contacts {sum(one.contacts for one in trials)} of {len(trials)}; "
        f"moved again by itself {sum(one.moved_unasked for one in trials)}; "
        f"told by a row {sum(bool(one.rows) for one in trials)}; "
        f"arrived after {sum(one.arrived for one in trials)}; "
        f"drove on {sum(one.stood_s is None for one in trials)}; rows {dict(seen)}"
    )
    stood = [one.stood_s for one in trials if one.stood_s is not None]
    return row_of(f"pons_mcu, {fault}: stands after", "s", "contacts 0", stood, note)


# Spoilt frames ------------------------------------------------------------------------------------


def fuzz(count: int, index: int) -> dict[str, int]:
    """Spoil so many frames; count crashes of the reader and the frames that it believed."""
    random = Random(f"fuzz {index}")
    crashes = believed = 0
    for _ in range(count):
        good = _frame(random)
        spoilt = _spoil(good, random)
        reader = McuReader()
        try:
            frames = reader.read(spoilt[: len(spoilt) // 2]) + reader.read(
                spoilt[len(spoilt) // 2 :]
            )
        except Exception:  # noqa: BLE001  # any is what is counted
            crashes += 1
            continue
        believed += spoilt != good and bool(frames) and good not in spoilt
    return {"frames": count, "crashes": crashes, "believed": believed}


def _frame(random: Random) -> bytes:
    def draw_word() -> int:
        return random.getrandbits(32)

    def draw_signed() -> int:
        return draw_word() - 2**31

    return encode_state(
        McuState(
            draw_word(),
            draw_word(),
            draw_word(),
            draw_word(),
            draw_word(),
            draw_signed(),
            draw_signed(),
            draw_signed(),
            draw_signed(),
            random.getrandbits(16),
            random.getrandbits(16),
            random.getrandbits(8),
        )
    )


def _spoil(frame: bytes, random: Random) -> bytes:
    way = random.randrange(4)
    at = random.randrange(len(frame))
    if way == 0:
        return frame[:at] + random.randbytes(random.randint(0, 8)) + frame[at:]
    if way == 1:
        return frame[:at] + frame[at + random.randint(1, 8) :]
    changed = bytearray(frame)
    for _ in range(random.randint(1, 8)):
        changed[random.randrange(len(changed))] = random.randrange(256)
    return bytes(changed)


def _fuzz_rows(runs: list[dict[str, int]]) -> list[ReportRow]:
    frames, crashes, believed = (
        sum(run[what] for run in runs) for what in ("frames", "crashes", "believed")
    )
    share = believed / max(1, frames)
    return [
        ReportRow("spoilt frames: crashes", "", "0", value=str(crashes), note=none_in(frames)),
        ReportRow(
            "spoilt frames: believed",
            "",
            f"<= {frames / 65_536:.0f} by the checksum's odds",
            value=str(believed),
            note=f"{share:.5%} of {frames}; the checksum lets {1 / 65_536:.5%} by",
        ),
    ]
