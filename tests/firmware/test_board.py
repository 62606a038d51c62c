"""The firmware's own bytes on a simulated board: what its pins do, by its own processor's time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import tau
from pathlib import Path

import pytest

from devices import pons_mcu
from devices.pons_mcu import McuCommand, McuReader, McuState, encode_command
from sim.twin.avr_board import (
    FAULT_CLOCK,
    FAULT_RESET,
    FREE_RADPS,
    STOP_PRESSED,
    AvrBoard,
    MotorPins,
)

TICKS = 2048
STEP_S = 0.001
SEND_STEPS = 10


@dataclass
class Bench:
    """Hold a board, a host that sends every 10 ms, and two motors whose speed follows the duty."""

    board: AvrBoard
    ttl_ms: int = 200
    reader: McuReader = field(default_factory=McuReader)
    steps: int = 0
    seq: int = 0
    radps: list[float] = field(default_factory=lambda: [0.0, 0.0])
    states: list[McuState] = field(default_factory=list)

    def run(
        self, steps: int, order: tuple[float, float] | None = None, inputs: int = 0, faults: int = 0
    ) -> list[MotorPins]:
        """Run for milliseconds; send ``order`` [rad/s], or nothing."""
        seen = []
        for _ in range(steps):
            heard = b""
            if order is not None and self.steps % SEND_STEPS == 0:
                self.seq += 1
                left, right = (round(1000 * radps) for radps in order)
                heard = encode_command(
                    McuCommand(self.seq, 9, left, right, TICKS, self.ttl_ms, pons_mcu.ENABLE)
                )
            pins, said = self.board.run(
                STEP_S,
                heard,
                left_edges_ps=self.radps[0] / tau * TICKS,
                right_edges_ps=self.radps[1] / tau * TICKS,
                inputs=inputs,
                faults=faults,
            )
            for side, duty in enumerate((pins.left_duty, pins.right_duty)):
                self.radps[side] += (duty / 1000 * FREE_RADPS - self.radps[side]) * STEP_S / 0.05
            self.states += [x for x in self.reader.read(said) if isinstance(x, McuState)]
            self.steps += 1
            faults = 0
            seen.append(pins)
        return seen


@pytest.fixture
def bench(board_build: Path) -> Iterator[Bench]:
    with AvrBoard(board_build) as board:
        yield Bench(board)


def test_without_a_host_it_brakes_and_reports_a_hundred_times_a_second(bench: Bench) -> None:
    pins = bench.run(1000)
    assert all(each.are_still for each in pins)
    assert {each.left_bridge for each in pins} == {"brakes"}
    assert 98 <= len(bench.states) <= 101
    assert all(state.bits == pons_mcu.TIMED_OUT for state in bench.states)
    gaps = {b.seq - a.seq for a, b in zip(bench.states, bench.states[1:], strict=False)}
    assert gaps == {1}


def test_it_drives_each_wheel_at_its_speed(bench: Bench) -> None:
    bench.run(2000, (6.0, -3.0))
    left, right = bench.radps
    assert left == pytest.approx(6.0, rel=0.03)
    assert right == pytest.approx(-3.0, rel=0.05)
    state = bench.states[-1]
    assert state.bits == pons_mcu.ENABLED
    assert state.left_mradps == pytest.approx(1000 * left, rel=0.03)
    assert state.right_mradps == pytest.approx(1000 * right, rel=0.05)
    assert (state.echo_boot, bench.seq - state.echo_seq <= 2) == (9, True)


def test_no_edge_is_lost_at_full_speed(bench: Bench) -> None:
    """Two wheels at 20 rad/s with 4096 edges a turn are 26 000 edges a second."""
    rate_ps = 20.0 / tau * 4096
    for _ in range(100):
        _, said = bench.board.run(0.01, left_edges_ps=rate_ps, right_edges_ps=-rate_ps)
        bench.states += [x for x in bench.reader.read(said) if isinstance(x, McuState)]
    first, last = bench.states[10], bench.states[-1]
    seconds = (last.time_us - first.time_us) / 1e6
    assert last.left_ticks - first.left_ticks == pytest.approx(rate_ps * seconds, abs=3)
    assert last.right_ticks - first.right_ticks == pytest.approx(-rate_ps * seconds, abs=3)


@pytest.mark.parametrize("ttl_ms", [50, 200, 500])
def test_silence_brakes_within_the_time_to_live_and_ten_milliseconds(
    bench: Bench, ttl_ms: int
) -> None:
    bench.ttl_ms = ttl_ms
    assert not bench.run(501, (8.0, 8.0))[-1].are_still
    after = bench.run(ttl_ms + 100)
    first = next(i for i, pins in enumerate(after) if pins.are_still)
    assert ttl_ms - SEND_STEPS <= first <= ttl_ms + 10
    assert all(pins.are_still for pins in after[first:])
    assert {pins.left_bridge for pins in after[first:]} == {"brakes"}
    assert bench.states[-1].bits == pons_mcu.TIMED_OUT


def test_a_pressed_stop_brakes_while_the_host_goes_on(bench: Bench) -> None:
    bench.run(500, (8.0, 8.0))
    pins = bench.run(300, (8.0, 8.0), inputs=STOP_PRESSED)
    assert all(each.are_still for each in pins[6:])
    assert bench.states[-1].bits == pons_mcu.STOP_PRESSED
    assert not bench.run(100, (8.0, 8.0))[-1].are_still


def test_a_reset_in_mid_drive_has_another_number_and_obeys_the_next_command(bench: Bench) -> None:
    bench.run(500, (8.0, 8.0))
    before = bench.states[-1].boot
    assert bench.run(2, faults=FAULT_RESET)[0].are_still
    bench.run(300, (8.0, 8.0))
    assert bench.states[-1].boot != before
    assert bench.states[-1].bits == pons_mcu.ENABLED


def test_a_hung_loop_is_reset_by_the_watchdog(bench: Bench) -> None:
    """Its clock stands, so it regulates no more: the bridge would drive on for ever."""
    bench.run(500, (8.0, 8.0))
    before = bench.states[-1].boot
    pins = bench.run(200, faults=FAULT_CLOCK)
    first = next(i for i, each in enumerate(pins) if each.are_still)
    assert first <= 75
    assert all(each.are_still for each in pins[first:])
    bench.run(100)
    assert bench.states[-1].boot != before


def test_noise_on_the_line_is_silence(bench: Bench) -> None:
    bench.run(501, (8.0, 8.0))
    noise = bytes(range(256))[:10]
    pins = [bench.board.run(STEP_S, noise if step % 2 else b"")[0] for step in range(300)]
    assert all(each.are_still for each in pins[210:])
