"""Hold docs/security.md to the tests that it names."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from scripts.threats import THREATS, render

TESTS = Path(__file__).resolve().parents[1]


@pytest.mark.parametrize("named", sorted({test for threat in THREATS for test in threat.tests}))
def test_each_named_test_exists(named: str) -> None:
    file, _, function = named.partition("::")
    source = (TESTS / file).read_text("utf-8")
    assert re.search(rf"^(?:async )?def {function}\(", source, re.MULTILINE), named


def test_every_attack_has_an_answer_and_a_test_and_stands_once() -> None:
    assert all(threat.answer and threat.tests for threat in THREATS)
    assert len({threat.attack for threat in THREATS}) == len(THREATS)


def test_the_page_has_a_row_for_each() -> None:
    page = render()
    assert all(f"| {threat.attack} | {threat.answer} |" in page for threat in THREATS)
