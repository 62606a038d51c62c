"""Noise in the middle of a drive is passed over, and a drive that stays deaf is found."""

from __future__ import annotations

import pytest

from tools.attack.drive_lines import INPUTS, KINDS, DrivenLine, SpoiltLines, lines_of
from tools.attack.unsound import Unsound


@pytest.mark.parametrize("kind", KINDS)
def test_after_noise_each_base_is_heard_again(kind: str) -> None:
    spoilt = SpoiltLines(kind)
    lines = lines_of(kind)
    assert lines
    for k in range(INPUTS):
        spoilt.read(lines[k % len(lines)][k % 7 :] + bytes([k % 256]) * (k % 5))


def test_a_drive_that_stays_deaf_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    line = DrivenLine("pons_mcu")
    monkeypatch.setattr(line._protocol, "decode", lambda _data, _now_s: [])
    with pytest.raises(Unsound, match="deaf"):
        line.recover()
