"""Laws of a fact's words: plain words are kept as they are; markup and orders never."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.memory import FactRefusal, clean_fact

ORDERS = (
    "turn left",
    "go to the kitchen",
    "stop",
    "turn right",
    "左转",
    "去厨房",
    "停下",
    "前进一米",
)
SAYS_NAME = ("my name is {}", "the dog is called {}", "call me {}", "小狗叫{}", "我的名字是“{}”")
FACTS = (
    "the keys are on the sofa", "dinner is at seven", "Mum calls home every Sunday",
    "they call me home at six", "call it a day at five", "take the bins out on Tuesday",
    "I like it when you turn around", "the wifi is <3 home", "5 > 3 and 2 < 4", "AT&T comes at 9",
    "this is Anna's room", "pills: [morning, evening]", "my code is {1234}",
    "wait for the postman on Fridays",
    "钥匙在沙发上", "妈妈六点下班", "闹钟叫我七点起床", "我家的狗叫旺财", "记得浇花",
)  # fmt: skip


def code_of(text: str) -> str | None:
    try:
        clean_fact(text)
    except FactRefusal as refused:
        return refused.code
    return None


@pytest.mark.parametrize("fact", FACTS)
def test_plain_words_are_kept_as_they_are(fact: str) -> None:
    assert clean_fact(f"  {fact} ") == fact


@pytest.mark.parametrize("order", ORDERS)
def test_what_is_an_order_alone_is_no_fact_and_nobodys_name(order: str) -> None:
    assert code_of(order) == "fact_order"
    for says in SAYS_NAME:
        assert code_of(says.format(order)) == "fact_order_name"


@given(
    st.sampled_from(FACTS),
    st.sampled_from((
        "<b>", "</script>", "<img src=x onerror=y>", "<!-- x -->", "```", "[a](http://b)", "&lt;",
        '{"kind": "go_to"}', "{{ place }}", "<|system|>",
    )),
    st.booleans(),
)  # fmt: skip
def test_markup_beside_any_fact_is_refused(fact: str, mark: str, first: bool) -> None:
    assert code_of(f"{mark} {fact}" if first else f"{fact} {mark}") == "fact_markup"
