"""Hold docs/security.md to the tests that it names."""

from __future__ import annotations

import re

import pytest

from tests.conftest import ROOT

PAGE = (ROOT / "docs" / "security.md").read_text("utf-8")
ROWS = [
    tuple(cell.strip() for cell in line.strip("|").split(" | "))
    for line in PAGE.partition("## What was tried")[2].splitlines()
    if line.startswith("| ") and ".py::" in line
]
"""Attack, answer and tests of each line."""


@pytest.mark.parametrize("named", sorted(set(re.findall(r"`([^`\s]+\.py::\w+)`", PAGE))))
def test_each_named_test_exists(named: str) -> None:
    file, _, function = named.partition("::")
    source = (ROOT / "tests" / file).read_text("utf-8")
    assert re.search(rf"^(?:async )?def {function}\(", source, re.MULTILINE), named


def test_every_attack_has_an_answer_and_a_test_and_stands_once() -> None:
    assert len(ROWS) >= 35
    assert all(len(row) == 3 and all(row) for row in ROWS)
    assert len({attack for attack, _, _ in ROWS}) == len(ROWS)
