"""Draw docs/wiring.svg: who is wired to whom in the robot of docs/build-a-robot.md.

Parts stand in columns, wires run in the gaps between them, each in a lane of its own, so that none
lies on another. The pins of the controller are those of firmware/avr/.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape

TARGET = Path(__file__).resolve().parents[1] / "docs" / "wiring.svg"
SHIFT_PX = (6.0, 0.0, 6.0, 13.0)
"""Of each column: two pins at one height would have their wires on one line."""
PIN_PX, HEAD_PX, WIDTH_PX, LANE_PX, MARGIN_PX, BETWEEN_PX = 19, 44, 168, 11, 24, 22
POWER, GROUND, SIGNAL, MOTOR, USB, HOLD = (
    "#c0392b",
    "#444444",
    "#1f6fb2",
    "#b9770e",
    "#6c3483",
    "#1e8449",
)
LEGEND = (
    (POWER, "supply"),
    (GROUND, "ground"),
    (SIGNAL, "signals"),
    (MOTOR, "motors"),
    (USB, "USB"),
    (HOLD, "pull-up of 10 kΩ to 5 V: brakes while the controller resets"),
)


@dataclass(frozen=True, slots=True)
class Part:
    """Place one part: its column, what is written on it, and its pins on either side."""

    name: str
    note: str
    column: int
    left: tuple[str, ...] = ()
    right: tuple[str, ...] = ()


PARTS = (
    Part("Raspberry Pi", "planner and bridge", 0, right=("USB 1", "USB 2", "USB-C in")),
    Part("LD19", "lidar, on its USB adapter", 0, right=("USB",)),
    Part("Stop button", "opens when pressed", 0, right=("a", "b")),
    Part(
        "Arduino Nano",
        "firmware/ pons_mcu",
        1,
        left=("USB", "D8", "GND"),
        right=(
            "5V", "GND ", "D9", "D4", "D5", "D10", "D6", "D7", "A0", "A1", "A2", "A3", "A6",
        ),
    ),
    Part(
        "TB6612FNG",
        "motor driver",
        2,
        left=("VCC", "GND", "PWMA", "AIN1", "AIN2", "PWMB", "BIN1", "BIN2", "STBY"),
        right=("AO1", "AO2", "BO1", "BO2", "VM", "GND "),
    ),
    Part("5 V, 5 A converter", "for the Pi", 2, left=("USB-C out",), right=("in +", "in -")),
    Part("Divider", "10 kΩ over 3.3 kΩ", 2, left=("middle",), right=("top", "bottom")),
    Part(
        "Left motor", "with encoder", 3, left=("M+", "M-", "5V", "GND", "A", "B")
    ),
    Part(
        "Right motor", "with encoder", 3, left=("M+", "M-", "5V", "GND", "A", "B")
    ),
    Part("Battery", "3 cells, fuse and switch", 3, left=("+", "-")),
)  # fmt: skip

WIRES = (
    ("Raspberry Pi.USB 1", "Arduino Nano.USB", USB),
    ("Raspberry Pi.USB 2", "LD19.USB", USB),
    ("Stop button.a", "Arduino Nano.D8", SIGNAL),
    ("Stop button.b", "Arduino Nano.GND", GROUND),
    ("Arduino Nano.5V", "TB6612FNG.VCC", POWER),
    ("Arduino Nano.GND ", "TB6612FNG.GND", GROUND),
    ("Arduino Nano.D9", "TB6612FNG.PWMA", SIGNAL),
    ("Arduino Nano.D4", "TB6612FNG.AIN1", HOLD),
    ("Arduino Nano.D5", "TB6612FNG.AIN2", HOLD),
    ("Arduino Nano.D10", "TB6612FNG.PWMB", SIGNAL),
    ("Arduino Nano.D6", "TB6612FNG.BIN1", HOLD),
    ("Arduino Nano.D7", "TB6612FNG.BIN2", HOLD),
    ("TB6612FNG.VCC", "TB6612FNG.STBY", HOLD),
    ("TB6612FNG.AO1", "Left motor.M+", MOTOR),
    ("TB6612FNG.AO2", "Left motor.M-", MOTOR),
    ("TB6612FNG.BO1", "Right motor.M+", MOTOR),
    ("TB6612FNG.BO2", "Right motor.M-", MOTOR),
    ("Arduino Nano.A0", "Left motor.A", SIGNAL),
    ("Arduino Nano.A1", "Left motor.B", SIGNAL),
    ("Arduino Nano.A2", "Right motor.A", SIGNAL),
    ("Arduino Nano.A3", "Right motor.B", SIGNAL),
    ("Arduino Nano.A6", "Divider.middle", SIGNAL),
    ("Battery.+", "TB6612FNG.VM", POWER),
    ("Battery.-", "TB6612FNG.GND ", GROUND),
    ("Battery.+", "5 V, 5 A converter.in +", POWER),
    ("Battery.-", "5 V, 5 A converter.in -", GROUND),
    ("Battery.+", "Divider.top", POWER),
    ("Battery.-", "Divider.bottom", GROUND),
    ("5 V, 5 A converter.USB-C out", "Raspberry Pi.USB-C in", POWER),
    ("TB6612FNG.VCC", "Left motor.5V", POWER),
    ("TB6612FNG.GND", "Left motor.GND", GROUND),
    ("Left motor.5V", "Right motor.5V", POWER),
    ("Left motor.GND", "Right motor.GND", GROUND),
)


class Drawing:
    """Lay the parts out and draw the wires."""

    def __init__(self) -> None:
        self._gap_px = [self._lanes(column) * LANE_PX + 3 * LANE_PX for column in range(3)]
        self._used = [0, 0, 0]
        self._below = 0
        self._tops = self._stack()
        self._floor_px = max(self._tops[part.name] + _height(part) + BETWEEN_PX for part in PARTS)
        self.lines: list[str] = []

    def svg(self) -> str:
        """Return the whole picture."""
        for wire in WIRES:
            self._wire(*wire)
        for part in PARTS:
            self._part(part)
        legend_px = self._floor_px + self._below * LANE_PX + 30
        width_px = round(self._x(3) + WIDTH_PX + MARGIN_PX)
        height_px = round(legend_px + 16 * len(LEGEND) + MARGIN_PX)
        for row, (colour, words) in enumerate(LEGEND):
            y = legend_px + 16 * row
            self.lines.append(f'<path d="M{MARGIN_PX} {y}h30" stroke="{colour}"/>')
            self.lines.append(_text(MARGIN_PX + 40, y + 4, words))
        body = "\n".join(self.lines)
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width_px} {height_px}" '
            f'width="{width_px}" height="{height_px}" role="img">\n'
            "<title>Wiring of a robot with an Arduino Nano, a TB6612FNG and an LD19</title>\n"
            "<style>text{font:11px sans-serif;fill:#222}.n{font-weight:bold}"
            "path{fill:none;stroke-width:1.8}</style>\n"
            f'<rect width="{width_px}" height="{height_px}" fill="#ffffff"/>\n{body}\n</svg>\n'
        )

    def _lanes(self, gap: int) -> int:
        return sum(gap in self._gaps(start, end) for start, end, _ in WIRES)

    def _gaps(self, start: str, end: str) -> set[int]:
        return {_gap_of(start), _gap_of(end)}

    def _stack(self) -> dict[str, float]:
        tops = dict[str, float]()
        down = [MARGIN_PX + shift for shift in SHIFT_PX]
        for part in PARTS:
            tops[part.name] = down[part.column]
            down[part.column] += _height(part) + BETWEEN_PX
        return tops

    def _x(self, column: int) -> float:
        return MARGIN_PX + column * WIDTH_PX + sum(self._gap_px[:column])

    def _pin(self, name: str) -> tuple[float, float]:
        part, side, row = _find(name)
        x = self._x(part.column) + (0 if side == "left" else WIDTH_PX)
        return x, self._tops[part.name] + HEAD_PX + row * PIN_PX

    def _lane(self, gap: int) -> float:
        self._used[gap] += 1
        return self._x(gap) + WIDTH_PX + LANE_PX + self._used[gap] * LANE_PX

    def _wire(self, start: str, end: str, colour: str) -> None:
        (x1, y1), (x2, y2) = self._pin(start), self._pin(end)
        first, last = _gap_of(start), _gap_of(end)
        path = f"M{x1:g} {y1:g}H{self._lane(first):g}"
        if first == last:
            path += f"V{y2:g}H{x2:g}"
        else:
            self._below += 1
            path += f"V{self._floor_px + self._below * LANE_PX:g}H{self._lane(last):g}"
            path += f"V{y2:g}H{x2:g}"
        self.lines.append(f'<path d="{path}" stroke="{colour}"/>')
        for x, y in ((x1, y1), (x2, y2)):
            self.lines.append(f'<circle cx="{x:g}" cy="{y:g}" r="3" fill="{colour}"/>')

    def _part(self, part: Part) -> None:
        x, y = self._x(part.column), self._tops[part.name]
        self.lines.append(
            f'<rect x="{x:g}" y="{y:g}" width="{WIDTH_PX}" height="{_height(part)}" rx="5" '
            'fill="#f4f6f7" stroke="#566573"/>'
        )
        self.lines.append(_text(x + WIDTH_PX / 2, y + 16, part.name, "middle", bold=True))
        self.lines.append(_text(x + WIDTH_PX / 2, y + 29, part.note, "middle"))
        for side, pins in (("left", part.left), ("right", part.right)):
            for row, pin in enumerate(pins):
                at = x + (8 if side == "left" else WIDTH_PX - 8)
                down = y + HEAD_PX + row * PIN_PX + 4
                self.lines.append(_text(at, down, pin, "start" if side == "left" else "end"))


def _height(part: Part) -> int:
    return HEAD_PX + max(len(part.left), len(part.right)) * PIN_PX


def _find(name: str) -> tuple[Part, str, int]:
    for part in PARTS:
        for side, pins in (("left", part.left), ("right", part.right)):
            for row, pin in enumerate(pins):
                if name == f"{part.name}.{pin}":
                    return part, side, row
    raise KeyError(name)


def _gap_of(name: str) -> int:
    part, side, _ = _find(name)
    return part.column - 1 if side == "left" else part.column


def _text(x: float, y: float, words: str, anchor: str = "start", *, bold: bool = False) -> str:
    kind = ' class="n"' if bold else ""
    return f'<text x="{x:g}" y="{y:g}" text-anchor="{anchor}"{kind}>{escape(words.strip())}</text>'


def main(arguments: list[str]) -> int:
    """Write the picture, or with ``--check`` return 1 where it is stale."""
    fresh = Drawing().svg()
    if "--check" in arguments:
        return int(not TARGET.is_file() or TARGET.read_text("utf-8") != fresh)
    TARGET.write_text(fresh, "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
