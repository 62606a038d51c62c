"""The wiring picture names the pins that the firmware uses."""

from __future__ import annotations

import re

from tests.conftest import ROOT


def test_the_motors_pins_are_those_of_the_firmware() -> None:
    source = (ROOT / "firmware" / "avr" / "motors.c").read_text("utf-8")
    (line,) = re.findall(r"/\* PWM left (.*?)\. Both", source, re.DOTALL)
    drawn = set(re.findall(r">(D\d+)<", (ROOT / "docs" / "wiring.svg").read_text("utf-8")))
    assert set(re.findall(r"D\d+", f"D9 {line}")) <= drawn
