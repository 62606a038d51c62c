"""Dialect is read as the standard words; words for others stay, and nothing is denied less."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.language.commands import intent_of
from planner.language.dialect import in_standard_words
from planner.language.grammar.parser import plan
from planner.plan import AnswerPlan, StepPlan
from planner.site import Site
from planner.site.site_view import vocabulary_of
from tests.conftest import ROOT

VOCABULARY = vocabulary_of(Site.load(ROOT / "sites" / "home"))

PAIRS = (
    ("上书房瞅一眼", "去书房看看"),
    ("客厅也瞅瞅", "客厅也看看"),
    ("你刚才在走廊瞧见狗了没有", "你刚才在走廊看见狗了没有"),
    ("今儿晚上甭去厨房", "今天晚上不用去厨房"),
    ("往后退点儿", "往后退点"),
    ("往后每天八点去书房", "以后每天八点去书房"),
    ("过一个钟头到卧室来", "过一个小时到卧室来"),
    ("挨屋转一圈", "每个房间转一圈"),
    ("你往右边转九十度", "你向右转九十度"),
    ("转过去，脸冲着电视", "转过去对着电视"),
    ("去厨房讲一声", "去厨房说一声"),
)


@pytest.mark.parametrize(("said", "standard"), PAIRS)
def test_a_dialects_words_are_the_standard_ones(said: str, standard: str) -> None:
    assert in_standard_words(said) == standard


@pytest.mark.parametrize(
    "said",
    [
        "去厨房看看有没有杯子",
        "上午八点去厨房",
        "看看桌上有什么",
        "等我的时候再说",
        "去上面看看",
        "往后退半米",
        "it is 5 o'clock",
        "看看瞅不瞅得见",
    ],
)  # fmt: skip
def test_standard_words_stay(said: str) -> None:
    assert in_standard_words(in_standard_words(said)) == in_standard_words(said)
    assert "去午" not in in_standard_words(said)


@pytest.mark.parametrize("said", PAIRS)
@pytest.mark.parametrize("opener", ["去告诉奶奶{}", "跟爷爷说{}", "说“{}”", "大声喊{}"])
def test_words_for_somebody_stay_as_they_were_said(said: tuple[str, str], opener: str) -> None:
    assert said[0].replace("，", ",") in in_standard_words(opener.format(said[0])).replace(
        "，", ","
    )


@pytest.mark.parametrize(
    ("said", "standard"),
    [
        ("你刚才在走廊瞧见狗了没有？", "你刚才在走廊看见狗了没有？"),
        ("往后每天晚上八点去书房", "以后每天晚上八点去书房"),
    ],
)
def test_the_brain_reads_both_alike(said: str, standard: str) -> None:
    assert intent_of(said) == intent_of(standard)
    read, meant = plan(said, VOCABULARY), plan(standard, VOCABULARY)
    assert read == meant or not isinstance(meant, StepPlan | AnswerPlan)


@given(st.text(alphabet="瞅瞧甭搁咱俩今儿候着上厨房去看别不没说点，。“”讲声", max_size=20))
def test_twice_changes_nothing_more_and_no_denial_is_lost(said: str) -> None:
    once = in_standard_words(said)
    assert in_standard_words(once) == once
    denials = "不没别甭"
    assert sum(map(once.count, denials)) >= sum(map(said.count, denials))
