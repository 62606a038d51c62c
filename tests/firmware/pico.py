"""Run the RP2040's bytes, instruction by instruction, with the few registers that they use played.

Unicorn emulates the processor alone. Clocks, pins, PWM, UART and watchdog are what this file makes
of the datasheet, by who wrote the port: it shows that the bytes start, regulate and brake as meant,
and not that the chip does what is believed of it. No Pico ran them.
"""

from __future__ import annotations

import struct
from collections import deque
from pathlib import Path
from random import Random
from typing import Any

import unicorn
from unicorn import arm_const as arm

FLASH, MEMORY, SSI, SYSTEM = 0x1000_0000, 0x2000_0000, 0x1800_0000, 0xE000_E000
PERIPHERALS, SIO = 0x4000_0000, 0xD000_0000
RETURN = MEMORY + 0x41F00
STEP_US, INSTRUCTIONS = 50, 400
"""12 MHz, at 1.5 cycles an instruction."""
QUEUE, BYTE_US = 32, 86.8
CONVERSION_US = 8
"""96 cycles of the crystal."""
ALWAYS = 301
"""Above the top of the count: high throughout."""


class Pico:
    """Be one chip: its time passes in steps of 50 us."""

    def __init__(self, image: bytes) -> None:
        self.now_us = 0
        self.registers: dict[int, int] = {}
        self.out = self.outputs = 0
        self.pins = 0
        """Levels at the inputs; pull-ups are the test's affair."""
        self.heard: deque[int] = deque()
        self.said = bytearray()
        self.fed_us: list[int] = []
        self.analogue = [0, 0]
        """Readings of the converter's inputs 0 and 1, of 4095."""
        self.is_failing = False
        """Every conversion ends in an error."""
        self._conversion = (0, 0)
        """The input, and when it was begun [us]."""
        self._edges = 0
        self._random = Random(7)
        self._enabled = 0
        self._sending: deque[int] = deque()
        self._has_room = False
        self._sent_us = 0.0
        chip = self._chip = unicorn.Uc(
            unicorn.UC_ARCH_ARM, unicorn.UC_MODE_THUMB | unicorn.UC_MODE_MCLASS
        )
        chip.ctl_set_cpu_model(arm.UC_CPU_ARM_CORTEX_M0)
        for base, size in ((FLASH, 0x20_0000), (MEMORY, 0x4_2000), (SSI, 0x1000), (SYSTEM, 0x1000)):
            chip.mem_map(base, size)
        chip.mem_write(FLASH, image)
        chip.mmio_map(PERIPHERALS, 0x7_0000, self._read, None, self._write, None)
        chip.mmio_map(SIO, 0x1000, self._read_sio, None, self._write_sio, None)
        chip.hook_add(
            unicorn.UC_HOOK_MEM_WRITE, self._enable, begin=SYSTEM + 0x100, end=SYSTEM + 0x103
        )
        self._at = FLASH | 1

    def run(self, milliseconds: float) -> None:
        """Let time pass."""
        for _ in range(round(1000 * milliseconds / STEP_US)):
            self.now_us += STEP_US
            self._chip.emu_start(self._at, 0, count=INSTRUCTIONS)
            self._at = self._chip.reg_read(arm.UC_ARM_REG_PC) | 1
            self._send()
            self._interrupt()

    def _send(self) -> None:
        """Let what the sender's queue holds go out, byte by byte; half empty it asks for more."""
        while self._sending and self._sent_us + BYTE_US <= self.now_us:
            self._sent_us += BYTE_US
            self.said.append(self._sending.popleft())
            self._has_room |= len(self._sending) == QUEUE // 2
        if not self._sending:
            self._sent_us = float(self.now_us)

    def turn(self, pins: int) -> None:
        """Change the levels at the inputs; edges are remembered as the chip does."""
        changed = (self.pins ^ pins) >> 8 & 0xFF
        for bit in range(8):
            if changed >> bit & 1:
                self._edges |= (8 if pins >> (8 + bit) & 1 else 4) << 4 * bit
        self.pins = pins
        self._interrupt()

    @property
    def levels(self) -> tuple[int, int]:
        """Return the two PWM levels of slice 0."""
        both = self.registers.get(0x5000C, 0)
        return both & 0xFFFF, both >> 16

    @property
    def is_braked(self) -> bool:
        """Return whether both motors are shorted: all inputs of the driver high."""
        inputs = 0b1111 << 18
        return self.out & inputs == inputs and min(self.levels) >= ALWAYS

    def _interrupt(self) -> None:
        """Call the handler of an interrupt that is due, where they are let in."""
        enabled = self._enabled
        if self._chip.reg_read(arm.UC_ARM_REG_PRIMASK) & 1:
            return
        mask = self.registers.get(0x34038, 0)
        if enabled & 1 << 20 and ((self.heard and mask & 0x50) or (self._has_room and mask & 0x20)):
            self._has_room = False
            self._call(16 + 20)
        if enabled & 1 << 13 and self._edges & self.registers.get(0x14104, 0):
            self._call(16 + 13)

    def _enable(self, _chip: Any, _kind: int, _at: int, _size: int, value: int, _: Any) -> None:
        self._enabled |= value

    def _call(self, number: int) -> None:
        table = struct.unpack("<I", self._chip.mem_read(SYSTEM + 0xD08, 4))[0]
        handler = struct.unpack("<I", self._chip.mem_read(table + 4 * number, 4))[0]
        before = self._chip.context_save()
        self._chip.reg_write(arm.UC_ARM_REG_LR, RETURN | 1)
        self._chip.emu_start(handler, RETURN, count=10_000)
        assert self._chip.reg_read(arm.UC_ARM_REG_PC) == RETURN, "the handler returns"
        self._chip.context_restore(before)

    def _read(self, _chip: Any, offset: int, _size: int, _data: Any) -> int:
        ctrl = self.registers.get
        match offset:
            case 0xC008:
                return ~ctrl(0xC000, 0x1FF_FFFF) & 0x1FF_FFFF
            case 0x24004:
                return 1 << 31 if ctrl(0x24000, 0) >> 12 == 0xFAB else 0
            case 0x8038:
                return 1 << (ctrl(0x8030, 0) & 3)
            case 0x8044:
                return 1 << (ctrl(0x803C, 0) & 1)
            case 0x54028:
                assert ctrl(0x5802C, 0) == 1 << 9 | 12, "the timer ticks by this"
                return self.now_us & 0xFFFF_FFFF
            case 0x6001C:
                return self._random.getrandbits(1)
            case 0x34018:
                full = len(self._sending) >= QUEUE
                return (0 if self.heard else 1 << 4) | (1 << 5 if full else 0)
            case 0x34000:
                return self.heard.popleft()
            case 0x140F4:
                return self._edges
            case 0x4C000:
                is_ready = self.now_us - self._conversion[1] >= CONVERSION_US
                return ctrl(0x4C000, 0) & ~4 | is_ready << 8 | self.is_failing << 9
            case 0x4C004:
                return self.analogue[self._conversion[0]]
            case _:
                return ctrl(offset, 0)

    def _write(self, _chip: Any, offset: int, _size: int, value: int, _data: Any) -> None:
        register, alias = offset & ~0x3000, offset >> 12 & 3
        before = self.registers.get(register, 0x1FF_FFFF if register == 0xC000 else 0)
        new = (value, before ^ value, before | value, before & ~value)[alias]
        if register == 0x140F4:
            self._edges &= ~value
            return
        self.registers[register] = new & 0xFFFF_FFFF
        if register == 0x4C000 and value & 4:
            self._convert(value >> 12 & 7)
        if register == 0x34000:
            assert len(self._sending) < QUEUE, "what a full queue is given is lost"
            self._sending.append(value & 0xFF)
        if register == 0x58004:
            self.fed_us.append(self.now_us)

    def _convert(self, number: int) -> None:
        """Begin a conversion, on which all that the datasheet asks for must be done before."""
        assert not self.registers[0xC000] & 1, "the converter is out of reset"
        assert self.registers[0x8060] == 1 << 11 | 3 << 5, "and has a clock"
        assert self.registers[0x1C004 + 4 * (26 + number)] == 1 << 7, "and a pad without pulls"
        assert self.now_us - self._conversion[1] >= CONVERSION_US, "and has ended the last"
        self._conversion = number, self.now_us

    def _read_sio(self, _chip: Any, offset: int, _size: int, _data: Any) -> int:
        return self.pins if offset == 4 else 0

    def _write_sio(self, _chip: Any, offset: int, _size: int, value: int, _data: Any) -> None:
        if offset == 0x14:
            self.out |= value
        elif offset == 0x18:
            self.out &= ~value
        elif offset == 0x24:
            self.outputs |= value


def load(folder: Path) -> Pico:
    """Return a chip whose flash holds what UF2's blocks write there."""
    data = (folder / "pons_mcu.uf2").read_bytes()
    image = bytearray()
    for at in range(0, len(data), 512):
        address, size = struct.unpack_from("<II", data, at + 12)
        assert address == FLASH + len(image), "one block behind the other"
        image += data[at + 32 : at + 32 + size]
    return Pico(bytes(image))
