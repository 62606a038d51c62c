"""The bytes for a Raspberry Pi Pico start, obey, and brake, in an emulator of its processor alone.

No Pico ran them, and no emulator of the chip exists here: the registers are played by tests.
"""

from __future__ import annotations

import itertools
import struct
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from devices import pons_mcu
from devices.pons_mcu import McuCommand, McuReader, McuState, encode_command
from firmware.rp2040.image import crc32_mpeg2, uf2, with_checksum
from tests.firmware.conftest import build, require

if TYPE_CHECKING:
    from tests.firmware.pico import Pico

TICKS = 2048
FULL_MV, FULL_MA, FULL = 14_190, 5_000, 4_095
STOP, LEFT_A, LEFT_B = 1 << 2, 1 << 8, 1 << 9
IDLE = 0b1111 << 8 | 0b111 << 3
"""All inputs high by their pull-ups, but the stop input, which is joined to ground."""


@pytest.fixture(scope="session")
def pico_build(tmp_path_factory: pytest.TempPathFactory) -> Path:
    require("make", "arm-none-eabi-gcc")
    return build(tmp_path_factory.mktemp("firmware-pico"), "rp2040")


@pytest.fixture
def pico(pico_build: Path) -> Pico:
    return started(pico_build)


@pytest.fixture
def measuring(pico_build: Path, tmp_path: Path) -> Pico:
    """Return a chip whose build has a divider and a sense of current, of at most 2 A."""
    assert pico_build.is_dir()
    fitted = f"-DBATTERY_FULL_SCALE_MV={FULL_MV}UL -DCURRENT_FULL_SCALE_MA={FULL_MA}UL"
    return started(build(tmp_path, "rp2040", f"CONFIG={fitted} -DMOST_MA=2000"))


def started(folder: Path) -> Pico:
    pytest.importorskip("unicorn", reason="no emulator of the processor (pip install unicorn)")
    from tests.firmware.pico import load

    made = load(folder)
    made.pins = IDLE
    return made


class PicoHost:
    """Send a command every 10 ms, and read the states."""

    def __init__(self, pico: Pico) -> None:
        self.pico, self.reader, self.seq = pico, McuReader(), 0
        self.states: list[McuState] = []

    def run(self, milliseconds: int, order: tuple[float, float] | None = None) -> None:
        for _ in range(milliseconds // 10):
            if order is not None:
                self.seq += 1
                left, right = (round(1000 * radps) for radps in order)
                command = McuCommand(self.seq, 9, left, right, TICKS, 200, pons_mcu.ENABLE)
                self.pico.heard.extend(encode_command(command))
            self.pico.run(10)
            frames = self.reader.read(bytes(self.pico.said))
            self.pico.said.clear()
            self.states += [frame for frame in frames if isinstance(frame, McuState)]


def test_the_checksum_of_boot2_is_the_roms_and_the_image_goes_into_blocks(
    pico_build: Path,
) -> None:
    assert crc32_mpeg2(b"123456789") == 0x0376_E6E7, "the check value of CRC-32/MPEG-2"
    image = with_checksum((pico_build / "pons_mcu_rp2040.bin").read_bytes())
    (told,) = struct.unpack_from("<I", image, 252)
    assert told == crc32_mpeg2(image[:252])
    blocks = uf2(image)
    assert (pico_build / "pons_mcu.uf2").read_bytes() == blocks
    assert len(blocks) % 512 == 0
    assert blocks[:4] == b"UF2\n"


@pytest.mark.parametrize("driver", ["1", "2"])
def test_it_is_built_for_both_kinds_of_driver(
    driver: str, tmp_path: Path, pico_build: Path
) -> None:
    assert pico_build.is_dir()
    build(tmp_path, "rp2040", f"CONFIG=-DDRIVER={driver}")
    assert (tmp_path / "pons_mcu.uf2").stat().st_size < 100_000


def test_it_starts_braked_and_reports_a_hundred_times_a_second(pico: Pico) -> None:
    host = PicoHost(pico)
    host.run(30)
    assert pico.is_braked
    host.run(500)
    assert pico.is_braked
    assert len(host.states) == pytest.approx(50, abs=4)
    last = host.states[-1]
    assert last.boot != 0
    assert last.echo_boot == 0
    assert not last.bits & pons_mcu.STOP_PRESSED
    assert (last.current_ma, last.battery_mv) == (pons_mcu.NOT_MEASURED, pons_mcu.NOT_MEASURED)
    assert last.time_us == pytest.approx(pico.now_us, abs=15_000)


def test_it_obeys_and_brakes_when_the_host_falls_silent(pico: Pico) -> None:
    host = PicoHost(pico)
    host.run(100)
    host.run(300, (5.0, -3.0))
    assert not pico.is_braked
    left, right = pico.levels
    assert 0 < right < left < 300, "feed-forward, and the error of wheels that don't turn here"
    assert pico.out >> 18 & 0b1111 == 0b1001, "left forward, right back"
    assert host.states[-1].echo_boot == 9
    assert host.states[-1].bits & pons_mcu.ENABLED
    silent_ms = 0
    while not pico.is_braked:
        pico.run(1)
        silent_ms += 1
        assert silent_ms < 300
    assert silent_ms <= 200 + 10


def test_a_stop_input_that_opens_brakes_whatever_the_host_says(pico: Pico) -> None:
    host = PicoHost(pico)
    host.run(200, (5.0, 5.0))
    assert not pico.is_braked
    pico.pins |= STOP
    host.run(20, (5.0, 5.0))
    assert pico.is_braked
    assert host.states[-1].bits & pons_mcu.STOP_PRESSED


def test_battery_and_current_are_read_by_turns(measuring: Pico) -> None:
    host = PicoHost(measuring)
    measuring.analogue = [3_000, 1_000]
    host.run(100)
    measured = host.states[-1]
    assert measured.battery_mv == 3_000 * FULL_MV // FULL
    assert measured.current_ma == 1_000 * FULL_MA // FULL
    assert not [state for state in host.states if 0 in (state.battery_mv, state.current_ma)]
    measuring.analogue = [FULL, 0]
    host.run(100)
    assert (host.states[-1].battery_mv, host.states[-1].current_ma) == (FULL_MV, 0)
    measuring.analogue, measuring.is_failing = [1, FULL], True
    host.run(100)
    assert (host.states[-1].battery_mv, host.states[-1].current_ma) == (FULL_MV, 0)


def test_too_much_current_takes_the_torque_away(measuring: Pico) -> None:
    host = PicoHost(measuring)
    measuring.analogue = [3_000, 1_600]  # 1.95 A
    host.run(300, (5.0, 5.0))
    assert not measuring.is_braked
    measuring.analogue = [3_000, 1_700]  # 2.08 A
    host.run(80, (5.0, 5.0))
    assert not measuring.is_braked, "a motor that starts draws more for less than 0.1 s"
    host.run(50, (5.0, 5.0))
    assert measuring.is_braked
    assert host.states[-1].bits & pons_mcu.TRIPPED


def test_a_converter_that_is_not_fitted_stays_in_its_reset(pico: Pico) -> None:
    PicoHost(pico).run(50)
    assert pico.registers[0xC000] & 1
    assert 0x4C000 not in pico.registers


def test_a_most_current_that_nothing_measures_is_no_build(tmp_path: Path, pico_build: Path) -> None:
    assert pico_build.is_dir()
    with pytest.raises(AssertionError, match="a current that isn't measured"):
        build(tmp_path, "rp2040", "CONFIG=-DMOST_MA=2000")


def test_edges_are_counted_both_ways(pico: Pico) -> None:
    host = PicoHost(pico)
    host.run(50)
    phases = [0, LEFT_A, LEFT_A | LEFT_B, LEFT_B]
    rest = IDLE & ~(LEFT_A | LEFT_B)
    at = 2  # both high, as the pull-ups leave them
    for _ in range(400):
        at = (at + 1) % 4
        pico.turn(rest | phases[at])
        pico.run(0.1)
    host.run(30)
    forward = host.states[-1].left_ticks
    assert abs(forward) == 400
    for _ in range(150):
        at = (at - 1) % 4
        pico.turn(rest | phases[at])
        pico.run(0.1)
    host.run(30)
    assert host.states[-1].left_ticks == forward - 150 * (1 if forward > 0 else -1)
    assert host.states[-1].right_ticks == 0


def test_the_watchdog_is_on_and_fed_by_the_regulation_alone(pico: Pico) -> None:
    host = PicoHost(pico)
    host.run(500)
    assert pico.registers[0x58000] & 1 << 30
    assert not pico.registers[0x58000] & 7 << 24, "no debugger holds it up"
    assert pico.registers[0x58004] == 2 * 60_000
    assert pico.registers[0x10008] == 0x1FFFC
    fed = pico.fed_us[5:]
    gaps = [after - before for before, after in itertools.pairwise(fed)]
    assert max(gaps) <= 7_000
    assert len(fed) == pytest.approx(500 / 5, abs=12), "once a turn of the regulation, not more"
