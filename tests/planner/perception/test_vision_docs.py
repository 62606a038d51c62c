"""Hold docs/vision.md to the code: every code, decoder and setting stands there, and no other."""

from __future__ import annotations

import re
from pathlib import Path

from planner.perception.detect.decoders import ALL
from planner.perception.failure import REASONS, REFUSALS, SKIPS
from planner.settings import VisionSettings


def rows(text: str, head: str) -> list[str]:
    """Return the first cells of the table with that head."""
    table = text.split(f"| {head} |", 1)[1].split("\n\n", 1)[0]
    return re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE)


def test_every_code_is_documented(repository: Path) -> None:
    text = (repository / "docs" / "vision.md").read_text("utf-8")
    assert rows(text, "code | what to do") == list(REFUSALS)
    assert rows(text, "code | the picture") == list(SKIPS)
    assert rows(text, "decoder | made by") == list(ALL)
    assert rows(text, "key of `[vision]` | default") == list(VisionSettings.model_fields)


def test_every_code_has_a_sentence_in_both_languages() -> None:
    for english, chinese in REASONS.values():
        assert english.isascii()
        assert re.search(r"[\u4e00-\u9fff]", chinese)
