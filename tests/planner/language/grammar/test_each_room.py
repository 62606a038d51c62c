"""Words for every room are said in every room; with a condition in them nothing is written out."""

from __future__ import annotations

from hypothesis import given
from hypothesis.strategies import sampled_from

from planner.language.grammar import Context, plan
from planner.language.grammar.each_room import say_in_each_room
from planner.plan import EVERY_KIND, GoTo, Say, StepPlan, Vocabulary

WHOLE = Context(runnable=EVERY_KIND)
WORDS = sampled_from(("good night", "dinner's ready", "we are leaving now"))
ORDERS = sampled_from(
    (
        "say {} in every room", "please say {} to everybody, one room after another",
        "go through all the rooms and say {}", "tell everyone in the house {}",
        "visit every room and tell everybody {}",
    )
)  # fmt: skip


@given(ORDERS, WORDS, sampled_from(("", ", then go home", " please")))
def test_words_are_said_in_every_room(home: Vocabulary, order: str, words: str, rest: str) -> None:
    made = plan(order.format(words) + rest, home, WHOLE)
    assert isinstance(made, StepPlan)
    rooms = [entry.id for entry in home.entries if entry.kind == "room"]
    assert [s.place for s in made.steps if isinstance(s, GoTo)] == rooms
    assert [s.text for s in made.steps if isinstance(s, Say)] == [words] * len(rooms)


@given(ORDERS, sampled_from(("good night if they are there", "hello or goodbye", "what is there")))
def test_open_words_are_left_as_they_are(home: Vocabulary, order: str, words: str) -> None:
    text = order.format(words)
    assert say_in_each_room(text, home) == text


@given(ORDERS, WORDS)
def test_a_denied_order_says_nothing(home: Vocabulary, order: str, words: str) -> None:
    made = plan(f"don't {order.format(words)}", home, WHOLE)
    assert not isinstance(made, StepPlan)


@given(
    sampled_from(
        ("每个房间喊一声{}", "去每个房间说一声{}", "挨个房间都喊“{}”", "饭好了，所有房间喊一下{}")
    ),
    sampled_from(("吃饭了", "晚安", "我们出发了")),
)  # fmt: skip
def test_words_are_said_in_every_room_in_chinese(home: Vocabulary, order: str, words: str) -> None:
    made = plan(order.format(words), home, WHOLE)
    assert isinstance(made, StepPlan)
    rooms = [entry.id for entry in home.entries if entry.kind == "room"]
    assert [s.place for s in made.steps if isinstance(s, GoTo)] == rooms
    assert [s.text for s in made.steps if isinstance(s, Say)] == [words] * len(rooms)
