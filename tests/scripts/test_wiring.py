"""The wiring picture leaves no pin without a wire, and names the pins that the firmware uses."""

from __future__ import annotations

import re

from scripts.wiring import PARTS, WIRES
from tests.conftest import ROOT


def test_each_pin_has_a_wire_and_each_wire_two_pins() -> None:
    pins = {f"{part.name}.{pin}" for part in PARTS for pin in part.left + part.right}
    ends = {end for start, end, _ in WIRES} | {start for start, _, _ in WIRES}
    assert pins == ends


def test_the_motors_pins_are_those_of_the_firmware() -> None:
    source = (ROOT / "firmware" / "avr" / "motors.c").read_text("utf-8")
    (line,) = re.findall(r"/\* PWM left (.*?)\. Both", source, re.DOTALL)
    named = set(re.findall(r"D\d+", f"D9 {line}"))
    to_driver = {
        start.rpartition(".")[2]
        for start, end, _ in WIRES
        if end.startswith("TB6612FNG") and re.search(r"\.D\d+$", start)
    }
    assert to_driver == named
