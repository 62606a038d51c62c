"""Measure drives of metal: our firmware's silence, and spoilt frames of its reader.

The firmware's own bytes run on a simulated board and are judged by its processor's time. Spoilt
frames: what the reader believes though it was changed; the checksum lets 1 of 65 536 by. Faults of
the line in mid-drive: line_faults.py.
"""

from __future__ import annotations

from functools import partial
from math import tau
from random import Random
from typing import TYPE_CHECKING

from devices import pons_mcu
from devices.pons_mcu import McuCommand, McuReader, McuState, encode_command, encode_state
from sim.twin.avr_board import BUILD, FAULT_CLOCK, FREE_RADPS, AvrBoard
from tools.bench.figures import none_in
from tools.bench.report import ReportRow, row_of

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "drives"
TITLE = "drives of metal: the firmware's silence, spoilt frames"
LONG_ONLY = True
STEP_S = 0.001
FRAMES = 1_000_000
SLICES = 10


def measure(lab: BenchLab) -> list[ReportRow]:
    """Measure both."""
    rows = []
    if (BUILD / "board").is_file():
        silences = lab.slices("firmware silence", lab.count(10, 100), firmware_silence)
        rows.append(_row("firmware: PWM zero after the time to live", 10.0, list(silences)))
        hangs = lab.slices("firmware hang", lab.count(5, 50), firmware_hang)
        rows.append(_row("firmware: PWM zero after its loop hangs", 75.0, list(hangs)))
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
