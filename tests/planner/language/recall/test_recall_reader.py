"""Questions about before become recalls, orders stay orders, and no wording moves anything."""

from __future__ import annotations

import asyncio

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.brain.interface import ThinkRequest
from planner.brain.offline_brain import OfflineBrain
from planner.brain.situation import RememberedItem, Situation
from planner.language.commands import ForgetFacts, TeachFact, read_statement
from planner.language.grammar.context import Context
from planner.language.grammar.parser import plan
from planner.language.motion_guard.step_words import moves
from planner.language.recall import read_recall
from planner.language.sentence import parse
from planner.plan import Clarify, Plan, Recall, StepPlan, Vocabulary
from tests.planner.language.grammar.conftest import HOME

THINGS = {"red cup": "红色的杯子", "keys": "钥匙", "blue bottle": "蓝色的瓶子", "book": "书"}
PLACES = {"kitchen": "厨房", "study": "书房", "bedroom": "卧室"}
SPANS = {
    "this morning": ("morning", "今天早上"), "yesterday": ("yesterday", "昨天"),
    "today": ("today", "今天"), "last night": ("night", "昨晚"), "": (None, ""),
}  # fmt: skip
COURTESY = ("", "please tell me ", "hey robot, ", "can you tell me ")
COURTESY_ZH = ("", "请问", "请告诉我", "机器人，")


def asked(text: str) -> Recall | None:
    read = read_recall(text, HOME, "study")
    return read.step if read is not None else None


@given(
    thing=st.sampled_from(sorted(THINGS)),
    place=st.sampled_from(sorted(PLACES)),
    span=st.sampled_from(sorted(SPANS)),
    polite=st.integers(0, 3),
)
def test_courtesy_and_language_do_not_change_what_is_asked(
    thing: str, place: str, span: str, polite: int
) -> None:
    when, zh = SPANS[span]
    english = asked(
        f"{COURTESY[polite]}did you see the {thing} in the {place} {span}".strip() + "?"
    )
    chinese = asked(f"{COURTESY_ZH[polite]}{zh}你在{PLACES[place]}看到过{THINGS[thing]}吗？")
    assert english == Recall(object=thing, place=place, span=when)
    assert chinese == Recall(object=THINGS[thing], place=place, span=when)


@given(place=st.sampled_from(sorted(PLACES)), span=st.sampled_from(sorted(SPANS)))
def test_anything_at_all_is_asked_for_in_both_languages(place: str, span: str) -> None:
    when, zh = SPANS[span]
    wanted = Recall(place=place, span=when)
    for what in ("anything", "something strange", "anything else"):
        assert asked(f"did you see {what} in the {place} {span}".strip() + "?") == wanted
    for what in ("有没有发现什么", "有看到什么异常没有", "看到什么了"):
        assert asked(f"{zh}你在{PLACES[place]}{what}？") == wanted


@given(thing=st.sampled_from(sorted(THINGS)))
def test_a_thing_may_be_named_before_it_is_asked_for(thing: str) -> None:
    wanted = Recall(object=THINGS[thing])
    for asks in ("{}你见过吗", "我的{}你有没有看到过", "{}，你看到过没有"):
        assert asked(asks.format(THINGS[thing])) == wanted


@given(place=st.sampled_from(sorted(PLACES)), span=st.sampled_from(sorted(SPANS)))
def test_people_are_asked_for_by_place_and_time(place: str, span: str) -> None:
    when, zh = SPANS[span]
    wanted = Recall(object="person", place=place, span=when)
    assert asked(f"who was in the {place} {span}".strip()) == wanted
    assert asked(f"{zh}谁来过{PLACES[place]}") == wanted


@pytest.mark.parametrize(
    "text",
    ["find the red cup", "go to the kitchen", "look for my keys in the study", "count the chairs",
     "is anybody in the kitchen?", "go to the kitchen and tell me what you saw",
     "what do you see?", "where are you?", "did you see the cup? go there", "厨房有人吗",
     "找红色的杯子",
     "去厨房看看有没有人", "现在谁在厨房", "如果你看到了杯子就去厨房"],
)  # fmt: skip
def test_orders_and_questions_about_now_are_no_recall(text: str) -> None:
    assert asked(text) is None


@pytest.mark.parametrize(
    "text", ["where is the red cup?", "have you seen my keys?", "红色的杯子在哪里？"]
)
def test_a_question_about_now_is_answered_where_something_is_known(text: str) -> None:
    offered = thought(text, None)
    assert isinstance(offered, Clarify), "as before: looking is offered, and drives upon a yes"
    told = thought(text, Situation(remembered=(RememberedItem(what="x", fits=True),)))
    assert isinstance(told, StepPlan)
    assert [step.kind for step in told.steps] == ["recall"]
    assert thought(text, Situation(remembered=(RememberedItem(what="x"),))) == offered


def thought(text: str, situation: Situation | None) -> Plan:
    request = ThinkRequest(
        text=text,
        vocabulary=HOME,
        runnable=Context().runnable | {"find"},
        situation=situation,
    )
    return asyncio.run(OfflineBrain().think(request)).plan


@given(text=st.text(max_size=60))
def test_no_text_is_a_recall_that_moves(text: str) -> None:
    read = read_recall(text, HOME)
    assert read is None or not moves(read.step)
    read_statement(text)


def test_a_robot_without_names_of_places_is_asked_too() -> None:
    assert read_recall("where did you see the cup?", Vocabulary()) is not None
    made = plan("where did you last see the red cup?", HOME, Context(runnable=frozenset({"say"})))
    assert not isinstance(made, StepPlan), "what can't be done is not planned"


@given(
    fact=st.sampled_from(
        ("the keys are on the sofa", "Tom is allergic to nuts", "grandma likes tea")
    )
)
def test_a_fact_is_kept_word_for_word(fact: str) -> None:
    for frame in ("remember that {}", "please remember: {}", "don't forget that {}", "{}"):
        said = frame.format(fact)
        intent = parse(said).intent or read_statement(said)
        if isinstance(intent, TeachFact):
            assert intent.words == fact
        else:
            assert frame == "{}", said


@pytest.mark.parametrize(
    "text",
    ["remember to go to the kitchen", "remember where you are", "记得去厨房", "记住这里叫充电角",
     "刚才谁在浴室", "the kitchen", "is the cup on the table?", "what is on the table",
     "弟弟在不在客厅", "有没有人在家呀", "书包都在走廊放着没", "球在客厅还是在书房来着",
     "放学回来你在门口跟她讲一声饭在锅里", "只要客厅没人你就在里面转", "她在客厅",
     "去厨房，别忘了", "厨房去一趟，别忘了", "go to the kitchen, don't forget",
     "the sofa is so comfy I could fall asleep", "my sister is going to the study later",
     "杯子在哪里", "停在门前一米", "站在沙发旁边", "等在走廊的门口", "应该在书房"],
)  # fmt: skip
def test_orders_and_questions_are_no_facts(text: str) -> None:
    assert not isinstance(parse(text).intent, TeachFact)
    assert read_statement(text) is None


@pytest.mark.parametrize(
    ("text", "wanted"),
    [("forget everything you have seen", ForgetFacts("", told=False, seen=True)),
     ("forget everything I told you", ForgetFacts("", told=True, seen=False)),
     ("forget everything", ForgetFacts()), ("清空你的记忆", ForgetFacts()),
     ("forget about the red cup", ForgetFacts("the red cup")),
     ("忘掉我说的关于钥匙的话", ForgetFacts("钥匙", told=True, seen=False))],
)  # fmt: skip
def test_what_is_to_be_forgotten(text: str, wanted: ForgetFacts) -> None:
    assert parse(text).intent == wanted


def test_a_fact_with_a_stop_word_still_may_mean_stop() -> None:
    said = parse("remember that you must not go on, stop there")
    assert said.may_mean_stop or said.orders_stop or not isinstance(said.intent, TeachFact)


FLAT = (
    "the blue cup belongs to Lena", "my name is Tobias", "my favourite colour is green",
    "I parked the stroller in the hallway", "this is my friend Rosa", "the keys are on the sofa",
    "我叫小雨", "我最喜欢绿色", "蓝杯子是丽丽的", "我把钥匙放沙发上了",
    "这是我朋友小芳", "钥匙在沙发上",
)  # fmt: skip


@pytest.mark.parametrize("fact", FLAT)
def test_a_flat_statement_is_kept_alone_and_where_it_is_asked_for(fact: str) -> None:
    assert read_statement(fact) == TeachFact(fact)
    english = ("{}, remember that", "{}, don't forget")
    for frame in english if fact.isascii() else ("{}，你记着点", "{}，别忘了"):
        said = frame.format(fact)
        assert parse(said).intent == TeachFact(fact), said


@pytest.mark.parametrize(
    ("text", "what"),
    [("whose is the blue cup?", "blue cup"), ("who does the blue cup belong to?", "blue cup"),
     ("when's the plumber coming", "plumber"), ("where does mum keep her backpack", "backpack"),
     ("蓝杯子是谁的？", "蓝杯子"), ("修水管的哪天来", "修水管")],
)  # fmt: skip
def test_what_was_told_is_asked_of_memory(text: str, what: str) -> None:
    read = read_recall(text, HOME)
    assert read is not None
    assert (read.step.object, read.present) == (what, True)


@pytest.mark.parametrize(
    ("text", "what"),
    [("whose room is this?", "room"), ("whose cup is that", "cup"), ("这是谁的房间？", "房间")],
)
def test_whose_something_here_is_asks_of_this_room(text: str, what: str) -> None:
    read = read_recall(text, HOME, "study")
    assert read is not None
    assert (read.step.object, read.step.place, read.present) == (what, "study", True)


@given(place=st.sampled_from(sorted(PLACES)), span=st.sampled_from(sorted(SPANS)))
def test_whether_it_was_somewhere_is_asked_of_its_deeds(place: str, span: str) -> None:
    when, zh = SPANS[span]
    wanted = Recall(place=place, span=when, deeds=True)
    assert asked(f"have you been to the {place} {span}".strip() + "?") == wanted
    assert asked(f"你{zh}去过{PLACES[place]}吗？") == wanted


@pytest.mark.parametrize("mark", ["\ue000", "\ue7ff", "\ue900", "\ue9ff"])
@pytest.mark.parametrize(
    "text", ["who was in the {}?", "have you seen {} in the {}?", "{}在哪里？"]
)
def test_a_private_character_of_the_persons_own_names_nothing(text: str, mark: str) -> None:
    read = read_recall(text.replace("{}", mark), HOME)
    assert read is None or read.step.place is None
