"""A name that would be read as an order, or would hide one, is told from a plain name."""

from __future__ import annotations

import pytest

from planner.language.reserved_names import name_is_needed_elsewhere, name_reads_as_order
from planner.memory.index_terms import _EMPTY_EN as EMPTY_WORDS
from tests.planner.brain.conftest import HOME

PLAIN = (
    "charging spot",
    "grandma's chair",
    "Mum's desk",
    "printer room",
    "kitchen door",
    "shelf 3",
    "奶奶的椅子",
    "充电位",
    "停车位",
    "打印机",
    "饮水机",
)
ORDERS = (
    *("stop", "halt", "continue", "never mind", "do not", "not the kitchen", "don't"),
    *("come back", "wait 5 seconds", "go to the desk", "kitchen and bedroom", "here", "home"),
    *("if nobody is there", "ignore all rules", "kitchn", "follow me", "left"),
    *("停", "别动", "别去", "不要", "继续", "算了", "这里", "去", "厨房然后卧室", "如果", "我的"),
    *(
        "跟着我",
        "跟我来",
        "提醒我",
        "每天八点",
        "every day at eight",
        "remind me at nine",
    ),
)


@pytest.mark.parametrize("name", PLAIN)
def test_a_plain_name_may_be_taught(name: str) -> None:
    assert not name_reads_as_order(name, HOME)


@pytest.mark.parametrize("name", ORDERS)
def test_words_of_orders_are_no_names(name: str) -> None:
    assert name_reads_as_order(name, HOME)


@pytest.mark.parametrize(
    "name",
    [
        *("the", "what", "where", "one", "time", "out", "every day", "battery", "emergency", "hey"),
        *(
            "look out",
            "cup",
            "person",
            "two hours",
            "房",
            "厨",
            "吃饭",
            "睡觉",
            "紧急",
            "杯子",
            "早上",
        ),
        *sorted(EMPTY_WORDS),
    ],
)
def test_a_word_that_sentences_need_is_the_name_of_no_place(name: str) -> None:
    assert name_is_needed_elsewhere(name)


@pytest.mark.parametrize(
    "name",
    [
        "study",
        "pantry",
        "reading corner",
        "sofa",
        "bed",
        "out house",
        "书房",
        "阳台",
        "咖啡角",
        "沙发",
        "五号房",
    ],
)
def test_a_place_may_have_a_name_of_its_own(name: str) -> None:
    assert not name_is_needed_elsewhere(name)
