"""Find out what is behind each serial port by listening, and by questions that move nothing.

Every speed that a known device speaks is listened at first; a port that says anything by itself is
asked nothing. Ports are questioned side by side, each in a thread of its own.
"""

from __future__ import annotations

import select
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from devices import PortTrouble, SerialPort, pons_mcu, ros_arduino, turtlebot3, waveshare
from devices.port_probe import PortAnswer
from sensors.lidar import ld08, ldrobot, rplidar, ydlidar
from sensors.lidar.kinds import recognize

if TYPE_CHECKING:
    from collections.abc import Sequence

    from devices.port_listing import SerialPortEntry
    from devices.port_probe import PortProbe

PROBES: Final[tuple[PortProbe, ...]] = (
    *pons_mcu.PROBES, *waveshare.PROBES, *ros_arduino.PROBES, *turtlebot3.PROBES,
    *ld08.PROBES, *ldrobot.PROBES, *rplidar.PROBES, *ydlidar.PROBES,
)  # fmt: skip
BOOT_S: Final = 2.5
"""The first listening: opening a port resets most Arduinos, whose loader then waits so long."""
LISTEN_S: Final = 0.35
"""Three turns of a lidar, 35 states of a controller."""
ANSWER_S: Final = 0.3
CHATTER_BYTES: Final = 16
"""A port that says so much unasked is one that speaks, at this speed or another."""
MOST_BYTES: Final = CHATTER_BYTES * 200


@dataclass(frozen=True, slots=True)
class PortFinding:
    """Hold what was found out about one port."""

    entry: SerialPortEntry
    code: str
    """``port_found``, or why nothing is known; :mod:`pons.robot.command` has the words."""
    part: str = ""
    kind: str = ""
    baud: int = 0
    answer: PortAnswer | None = None
    detail: str = ""


def question_ports(
    entries: Sequence[SerialPortEntry], probes: Sequence[PortProbe] = PROBES
) -> list[PortFinding]:
    """Question ports side by side; the findings come in the order of the ports."""
    if not entries:
        return []
    with ThreadPoolExecutor(len(entries)) as threads:
        return list(threads.map(lambda entry: question_port(entry, probes), entries))


def question_port(
    entry: SerialPortEntry, probes: Sequence[PortProbe] = PROBES, boot_s: float = BOOT_S
) -> PortFinding:
    """Listen at one port, ask where it is silent, and say what is behind it. Never raises."""
    if entry.is_console:
        return PortFinding(entry, "port_console")
    if entry.holders:
        first = entry.holders[0]
        return PortFinding(entry, "port_busy", detail=f"{first.command} (pid {first.pid})")
    if not entry.is_permitted and entry.path.exists():
        return PortFinding(entry, "port_forbidden", detail=entry.group)
    speeds = sorted({probe.baud for probe in probes})
    try:
        with SerialPort(entry.path, speeds[0]) as port:
            return _PortInterview(entry, port, probes).hold(speeds, boot_s)
    except PortTrouble as trouble:
        return PortFinding(entry, trouble.code, detail=_detail_of(entry, trouble))


def _detail_of(entry: SerialPortEntry, trouble: PortTrouble) -> str:
    """Return what the words of a code have a place for."""
    if trouble.code == "port_forbidden":  # though the file's mode allows it: in a container
        return ""
    if trouble.code == "port_busy":
        return f"a program of another user (`sudo fuser -v {entry.path}` names it)"
    return trouble.fact


def name_speaker(data: bytes) -> str | None:
    """Return which device said some bytes of itself, for a person; None where nobody knows."""
    for probe in PROBES:
        answer = None if probe.question else probe.recognise(data)
        if answer is not None:
            return f"{probe.part} {probe.kind}: {answer.words}"
    kind = recognize(data)
    return None if kind is None else f"a lidar of kind {kind}"


class _PortInterview:
    """Go through the speeds of one open port."""

    def __init__(
        self, entry: SerialPortEntry, port: SerialPort, probes: Sequence[PortProbe]
    ) -> None:
        self._entry, self._port, self._probes = entry, port, probes
        self._chatter = 0

    def hold(self, speeds: Sequence[int], boot_s: float) -> PortFinding:
        """Listen at every speed, then ask at every speed, if nothing spoke by itself.

        Raises:
            PortTrouble: ``port_gone``; a speed that the driver does not do is left out.
        """
        refused = 0
        heard: dict[int, bytes] = {}
        for number, baud in enumerate(speeds):
            try:
                self._port.set_baud(baud)
            except PortTrouble as trouble:
                if trouble.code != "baud_unknown":
                    raise
                refused += 1
                continue
            heard[baud] = self._listen(LISTEN_S if number else boot_s, MOST_BYTES)
            self._chatter += len(heard[baud])
            found = self._recognise(baud, heard[baud], asked=False)
            if found is not None:
                return found
        if not heard:
            return PortFinding(self._entry, "baud_unknown", detail=f"{refused} speeds refused")
        if self._chatter >= CHATTER_BYTES:
            return self._listen_again(list(heard)) or self._name_chatter(heard)
        return self._ask(list(heard)) or PortFinding(self._entry, "port_silent")

    def _listen_again(self, speeds: Sequence[int]) -> PortFinding | None:
        """Listen longer where something speaks: a busy computer may have read it too late."""
        for baud in speeds:
            self._port.set_baud(baud)
            found = self._recognise(baud, self._listen(2 * LISTEN_S, MOST_BYTES), asked=False)
            if found is not None:
                return found
        return None

    def _ask(self, speeds: Sequence[int]) -> PortFinding | None:
        for baud in (*speeds, *speeds):  # the first question may meet a device that boots
            self._port.set_baud(baud)
            for question in dict.fromkeys(p.question for p in self._probes if p.baud == baud):
                if not question:
                    continue
                self._port.write(question)
                found = self._recognise(baud, self._listen(ANSWER_S, 256), asked=True)
                if found is not None:
                    return found
        return None

    def _recognise(self, baud: int, data: bytes, *, asked: bool) -> PortFinding | None:
        for probe in self._probes:
            if probe.baud != baud or bool(probe.question) != asked:
                continue
            answer = probe.recognise(data)
            if answer is not None:
                return PortFinding(self._entry, "port_found", probe.part, probe.kind, baud, answer)
        return None

    def _name_chatter(self, heard: dict[int, bytes]) -> PortFinding:
        """Name a lidar that still turns from an earlier use, or say that something speaks."""
        for baud, data in heard.items():
            kind = recognize(data) if len(data) >= CHATTER_BYTES else None
            if kind is not None:
                words = f"a lidar of kind {kind} that is turning; unplug it for its model's name"
                answer = PortAnswer(words, missing={"model": "printed on it; docs/lidars.md"})
                return PortFinding(self._entry, "port_found", "lidar", kind, baud, answer)
        most = max(heard, key=lambda baud: len(heard[baud]))
        detail = f"{self._chatter} bytes of no known device, most of them at {most} baud"
        return PortFinding(self._entry, "port_unknown", detail=detail)

    def _listen(self, seconds: float, most_bytes: int) -> bytes:
        """Return what comes within some seconds, or sooner what is enough to judge."""
        end_s = time.monotonic() + seconds
        data = b""
        while (left_s := end_s - time.monotonic()) > 0 and len(data) < most_bytes:
            select.select([self._port], [], [], left_s)
            data += self._port.read()
        return data
