"""Flat statements are kept word for word; talk, orders, questions and answers are not."""

from __future__ import annotations

import pytest

from planner.language.commands import TeachFact, read_statement
from planner.language.sentence import parse

FACTS = (
    "I've put your spare cable in the bedroom, under the bed",
    "Auntie Bernie's sleeping in the study this week", "Dad's working in the study today",
    "I moved the red umbrella, it's in the bathroom drying now", "Tom's bike is in the hallway",
    "we've got guests coming on Saturday", "the plumber's coming on Friday at ten",
    "the cleaner comes at three this afternoon", "the wifi password is sunflower",
    "Grandma is allergic to nuts", "小宝的水壶在沙发后面", "我刚把雨伞挂到门后面了",
    "明天下午快递会到", "奶奶这周住书房", "阿姨今天下午三点来搞卫生",
)  # fmt: skip
TALK = (
    "I'm hungry", "dinner is ready", "Mum is in the kitchen", "she's in the study",
    "he comes at three", "I'm in the bedroom", "the kitchen is dirty", "the door is open",
    "come to the kitchen this afternoon", "go to the kitchen, the keys are on the table",
    "the kids are asleep", "Tom is coming", "the study, please", "it's on the desk",
    "I'm working in the study today", "the plumber is coming on Friday, remind me",
    "put the cup on the table", "my back hurts today", "Anna is nice", "I left the kitchen",
    "you left the cup on the table", "if the keys are on the table, come back",
    "is the plumber coming on Friday?",
    "我肚子饿了", "他在书房", "妈妈来了", "今天天气真好", "把杯子放在桌子上", "我今天下午三点来",
    "你去厨房", "等爸爸回来了跟他说饭在锅里",
    "等妈妈到家钥匙在门口", "跟小明讲一声饭在锅里", "客厅有人", "饭好了", "客人来了",
    "阿姨今天来不来",
    "厨房去一趟，别忘了", "明天下午三点叫我",
)  # fmt: skip
AROUND = (
    ("by the way, {}", "{}"), ("{}, in case anybody asks", "{}"), ("{}, just so you know", "{}"),
    ("{}, don't forget", "{}"), ("跟你讲一下，{}", "{}"), ("{}，你要知道", "{}"),
    ("{}，等下他问你你就告诉他", "{}"),
)  # fmt: skip


def fact_of(text: str) -> str | None:
    """Return what is kept of a sentence, as the planner reads it."""
    intent = parse(text).intent or read_statement(text)
    return intent.words if isinstance(intent, TeachFact) else None


@pytest.mark.parametrize("text", FACTS)
def test_a_statement_is_kept_word_for_word(text: str) -> None:
    assert fact_of(text) == text


@pytest.mark.parametrize("text", TALK)
def test_talk_and_orders_are_not_kept(text: str) -> None:
    assert fact_of(text) is None


@pytest.mark.parametrize(("frame", "kept"), AROUND)
def test_what_is_said_around_it_is_not_kept(frame: str, kept: str) -> None:
    fact = "车钥匙在餐桌上" if not frame.isascii() else "the remote is on the sofa"
    told = fact_of(frame.format(fact))
    assert told is not None
    assert told in (kept.format(fact), frame.format(fact))
    assert fact in told


def test_what_is_to_be_kept_may_be_any_statement() -> None:
    said = "bins go out on Thursday, don't let me forget which day it is"
    assert fact_of(said) == "bins go out on Thursday"
