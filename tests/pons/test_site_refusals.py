"""Test that a refusal has the catalogue's words of both languages, and a code of its own."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from bridge.recording.recording_reader import BadRecording
from maps.errors import CODES
from planner.language.catalogue import CATALOGUE, raw
from pons.site_refusals import keyframes_malformed, recording_refused, site_refusal
from tests.site_sentences import english_in


@pytest.mark.parametrize("told", CATALOGUE.keys("site_refusal"))
def test_no_refusal_has_english_in_its_chinese(told: str) -> None:
    assert english_in(re.sub(r"\{[^}]*\}", "‹›", raw(f"site_refusal.{told}", "zh"))) == ""


def test_a_refusal_fills_both_sentences() -> None:
    error = site_refusal("mend_unknown", "mend_none", site="attic")
    assert error.message["en"] == "none waits for attic; make one: pons map attic --mend"
    assert error.message["zh"] == "attic 没有待定的提案；新建：pons map attic --mend"


@pytest.mark.parametrize("code", CATALOGUE.keys("recording_refusal"))
def test_a_recording_is_refused_by_its_readers_code(code: str) -> None:
    error = recording_refused(Path("/a.mcap"), BadRecording(code, "/a.mcap: it is odd in there"))
    assert error.code == code in CODES
    assert error.message["en"] == "/a.mcap: it is odd in there"
    assert error.message["zh"].startswith("录制文件 /a.mcap 无法使用：")


def test_no_blank_stands_in_the_chinese_alone() -> None:
    for group in ("site_refusal", "recording_refusal"):
        for told in CATALOGUE.keys(group):
            blanks = [
                set(re.findall(r"\{(\w+)", raw(f"{group}.{told}", language)))
                for language in ("en", "zh")
            ]
            assert blanks[1] <= blanks[0], told


def test_what_a_library_says_of_keyframes_stays_out_of_the_chinese() -> None:
    error = keyframes_malformed(Path("/k.npz"), ValueError("File is not a zip file"))
    assert error.message["zh"] == "/k.npz：保存的关键帧已损坏，无法读取"
