"""Say cheaply which sentences may be about standing orders."""

from __future__ import annotations

import pytest

from planner.language.commands.parser import may_concern_orders
from planner.language.schedule import read_order_command
from tests.conftest import ROOT

SENTENCES = tuple(
    part
    for folder in ("tools/evals", "pons/evals")
    for path in sorted((ROOT / folder).glob("[!l]*/*.tsv"))
    for line in path.read_text().splitlines()
    for part in line.split("\t")
    if part.strip()
)


def test_no_sentence_of_a_standing_order_is_kept_out() -> None:
    kept_out = [each for each in SENTENCES if not may_concern_orders(each)]
    assert [each for each in kept_out if read_order_command(each) is not None] == []
    assert len(kept_out) > len(SENTENCES) // 4  # most of what people order is done now


@pytest.mark.parametrize(
    "text", ["go to the kitchen", "come here please", "find my keys", "去厨房", "跟着我"]
)
def test_an_order_of_now_is_kept_out(text: str) -> None:
    assert not may_concern_orders(text)


@pytest.mark.parametrize(
    "text",
    [
        "Remind me at eight",
        "on the fourteenth go to the kitchen",
        "say hello to everybody who comes in",
        "forget the welcome thing",
        "有人来就说你好",
        "没电了就回去充电",
        "睡觉前",
    ],
)
def test_a_time_an_event_and_what_is_kept_concern_them(text: str) -> None:
    assert may_concern_orders(text)
