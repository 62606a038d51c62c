"""Check that a shell tells who planned in a model's place."""

from __future__ import annotations

import pytest

from planner.brain.model_error_codes import REASONS
from pons.terminal_text import stand_in


def goal(**brain: object) -> dict[str, object]:
    return {"brain": {"name": "offline", "fallback_from": None, **brain}}


@pytest.mark.parametrize("given", [{}, {"brain": None}, goal()])
def test_nothing_is_said_of_the_brain_that_was_asked(given: dict[str, object]) -> None:
    assert stand_in(given, "en") == ""


def test_a_stand_in_is_named_with_the_reason_in_both_languages() -> None:
    words = REASONS["timeout"].model_dump()
    given = goal(fallback_from="qwen3", fallback_reason="timeout", fallback_message=words)
    said = "offline planned in place of qwen3: The model did not answer in time."
    assert stand_in(given, "en") == said
    assert stand_in(given, "zh") == "offline 代替 qwen3 规划：模型没有及时应答。"
    assert stand_in(goal(fallback_from="m", fallback_reason="resting"), "en").endswith("resting")
