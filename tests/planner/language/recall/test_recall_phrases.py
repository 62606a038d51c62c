"""Everyday questions about before, and what stands near them and asks nothing of memory."""

from __future__ import annotations

import pytest

from planner.language.recall import read_recall
from planner.plan import Recall
from tests.planner.language.grammar.conftest import HOME


@pytest.mark.parametrize(
    ("text", "asked"),
    [
        ("when were you last in the kitchen?", Recall(place="kitchen", deeds=True)),
        ("did you already check the bedroom or not yet?", Recall(place="bedroom", deeds=True)),
        ("when was the last time you checked the front door?",
         Recall(place="front_door", deeds=True)),
        ("what've you been doing all morning", Recall(span="morning", deeds=True)),
        ("What did you do this morning while I was out?", Recall(span="morning", deeds=True)),
        ("did anyone come in through the front door today?",
         Recall(object="person", place="front_door", span="today")),
        ("did you see anybody while I was at work today", Recall(object="person", span="today")),
        ("do you remember how many chairs you counted yesterday?",
         Recall(span="yesterday", deeds=True)),
        ("do you remember where I said my glasses are?", Recall(object="glasses")),
        ("did you tell Emma dinner's ready?", Recall(deeds=True)),
        ("have you already asked Grandpa about his pills?", Recall(deeds=True)),
        ("what did you say to Emma this morning?", Recall(span="morning", deeds=True)),
        ("why did you go to the kitchen?", Recall(place="kitchen", deeds=True)),
        ("did you see the ball anywhere today?", Recall(object="ball", span="today")),
        ("did you notice a bottle anywhere on your rounds this morning?",
         Recall(object="bottle", span="morning")),
        ("你刚才都干嘛了", Recall(span="hour", deeds=True)),
        ("今天上午你都去哪儿了", Recall(span="morning", deeds=True)),
        ("钥匙我讲过放哪里了，你记得不", Recall(object="钥匙")),
        ("我出去这会儿有人来过吗", Recall(object="person")),
        ("早上那个红色书包是几点看到的", Recall(object="红色书包", span="morning")),
        ("你上次去厨房是什么时候", Recall(place="kitchen", deeds=True)),
        ("刚才你在厨房看见谁了没有", Recall(object="person", place="kitchen", span="hour")),
        ("你刚才在走廊瞧见狗了没有？", Recall(object="狗", place="hallway", span="hour")),
        ("我跟你说过车钥匙放哪儿来着？", Recall(object="车钥匙")),
        ("我的老花镜放在哪里了，你还记不记得？", Recall(object="老花镜")),
        ("我上班这一天你都干什么了", Recall(deeds=True)),
        ("厨房你检查过没有", Recall(place="kitchen", deeds=True)),
    ],
)  # fmt: skip
def test_a_question_about_before_is_read(text: str, asked: Recall) -> None:
    read = read_recall(text, HOME)
    assert read is not None
    assert (read.step, read.present) == (asked, False)


@pytest.mark.parametrize(
    "text",
    ["check the bedroom", "can you check the kitchen", "check the bedroom while I am out",
     "did you check the bedroom and the kitchen, then go home", "what are you doing",
     "count the chairs", "看过厨房再去书房", "你去厨房", "去厨房检查过再回来", "我出去了你去厨房"],
)  # fmt: skip
def test_an_order_is_no_question_about_before(text: str) -> None:
    assert read_recall(text, HOME) is None
