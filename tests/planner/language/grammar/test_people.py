"""Tell, ask and find people: who is named is searched for, and hears it with the name first."""

from __future__ import annotations

import pytest

from planner.language.grammar.context import Context
from planner.language.grammar.parser import plan
from planner.plan import EVERY_KIND, Ask, Clarify, Code, Find, Say, StepPlan, Vocabulary

HERE = Context(things=frozenset({"person", "人", "cup", "杯子"}), runnable=EVERY_KIND)


@pytest.mark.parametrize(
    ("said", "who", "words"),
    [
        ("tell Mum I'm home", "Mum", "Mum, i am home"),
        ("go and tell my husband dinner is ready", "husband", "husband, dinner is ready"),
        ("go find Dad and tell him the phone's for him", "Dad", "Dad, the phone's for him"),
        ("跟我老婆说饭好了", "我老婆", "老婆,饭好了"),
        ("跟妈妈说我出门了", "妈妈", "妈妈,我出门了"),
    ],
)
def test_who_is_told_without_a_place_is_searched_for(
    home: Vocabulary, said: str, who: str, words: str
) -> None:
    made = plan(said, home, HERE)
    assert isinstance(made, StepPlan)
    assert made.steps == (Find(object=who), Say(text=words))


@pytest.mark.parametrize(
    ("said", "who", "question"),
    [
        ("go ask Dad if he wants a cuppa", "Dad", "Dad, do you want a cuppa?"),
        ("问问妈妈想吃什么", "妈妈", "妈妈,想吃什么"),
    ],
)
def test_who_is_asked_without_a_place_is_searched_for(
    home: Vocabulary, said: str, who: str, question: str
) -> None:
    made = plan(said, home, HERE)
    assert isinstance(made, StepPlan)
    assert made.steps == (Find(object=who), Ask(question=question))


@pytest.mark.parametrize("said", ["follow Dad", "take Grandma to the kitchen", "跟着奶奶"])
def test_who_is_followed_or_led_is_asked_for(home: Vocabulary, said: str) -> None:
    made = plan(said, home, HERE)
    assert isinstance(made, Clarify)
    assert made.code is Code.INCOMPLETE


@pytest.mark.parametrize(
    "said",
    [
        "don't tell Dad dinner is ready",
        "Dad told me to go to the kitchen",
        "Mum says dinner is ready",
        "tell Dad or Mum",
        "别告诉妈妈我出门了",
        "妈妈跟我说她出门了",
    ],
)
def test_who_is_only_spoken_of_is_not_searched_for(home: Vocabulary, said: str) -> None:
    assert not isinstance(plan(said, home, HERE), StepPlan)
