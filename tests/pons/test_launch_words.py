"""Whoever reads Chinese learns from ``pons up`` what to mend."""

from __future__ import annotations

import pytest

from planner.perception.failure import REFUSALS
from pons.launch_words import CHINESE, chinese_cure
from tests.known import known


@pytest.mark.parametrize(
    ("refusal", "code"),
    [
        ("robot_toml_syntax: my.toml: Unterminated string", "robot_toml_syntax"),
        ("bridge refused to start:\nbridge: port_forbidden: drive.port /dev/x", "port_forbidden"),
        ("bridge refused to start:\nbridge: fence_invalid: fence.json: x: y", "fence_invalid"),
        ("setup refused to start:\nsetup: operator_key_missing: /h", "operator_key_missing"),
        ("planner refused to start:\nplanner: voice_offhost: people's voices", "voice_offhost"),
        ("planner refused to start:\nplanner: speech_program: [speech] needs", "speech_program"),
        ("planner refused to start:\nplanner: settings_malformed: unknown", "settings_malformed"),
    ],
)
def test_the_cure_of_the_code_that_came_is_said(refusal: str, code: str) -> None:
    assert chinese_cure(refusal) == CHINESE[code]


@pytest.mark.parametrize("code", REFUSALS)
def test_a_detectors_refusal_is_said_in_the_words_of_the_catalogue(code: str) -> None:
    cure = known(chinese_cure(f"planner refused to start:\nplanner: {code}: the file (best.onnx)"))
    assert REFUSALS[code][1] in cure


def test_without_a_known_code_nothing_is_added() -> None:
    assert chinese_cure("odd_thing: http://x: y") is None


def test_every_cure_is_chinese() -> None:
    for code, words in CHINESE.items():
        assert any(ord(letter) > 0x2E80 for letter in words), code
