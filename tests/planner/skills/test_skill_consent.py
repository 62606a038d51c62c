"""Check what counts as a plain yes and a plain no: nothing else may set a robot off."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.language.commands import CancelCommand, PauseCommand, intent_of
from planner.language.stop import is_stop
from planner.language.yes_no import consents

YES_EN = (
    "yes", "yeah", "yep", "ok", "okay", "sure", "of course", "go ahead", "please do", "do it",
    "yes please do that", "sounds good", "no problem", "that's right", "uh-huh", "go", "I agree",
    "let's go", "by all means", "all right", "go there", "you may", "absolutely",
)  # fmt: skip
NO_EN = (
    "no", "nope", "nah", "no thanks", "no thank you", "not now", "not yet", "don't", "do not",
    "don’t go there", "of course not", "I'd rather not", "I don't think so", "no way", "no need",
    "not really", "never", "that's wrong",
)  # fmt: skip
YES_ZH = (
    "是", "是的", "好", "好的", "好呀可以", "可以", "行", "行啊", "对", "没问题", "同意", "确认",
    "去吧", "开过去", "要", "当然可以", "好嘞", "是的没错", "就这样", "走吧", "好的没问题", "嗯嗯",
)  # fmt: skip
NO_ZH = (
    "不", "不要", "不用", "不用了", "不行", "不是", "别", "别去", "别过去", "不去",
    "不可以", "没必要", "先不要", "还是不要了", "暂时不用", "唔好", "甭", "不了", "否",
    "当然不", "不好",
)  # fmt: skip
ASKED = {True: (*YES_EN, *YES_ZH), False: (*NO_EN, *NO_ZH)}
NEITHER = (
    "", " ", "please", "yes?", "yes no", "no, yes", "ok no", "yes but slowly", "yesterday", "maybe",
    "what is there?", "the kitchen", "if it is a guitar, yes", "yes\u200b", "y" * 81, "yes, hm",
    "go to the sofa", "go away", "yeah right", "don't stop", "no, go ahead", "can you?", "hello",
    "好不好", "是不是", "好了", "行了", "对了", "要是", "要不", "去不去", "不用谢",
    "可能是", "是吗", "好的，不要", "不去不行", "不能不去", "别不去", "可以是", "你好", "您好",
    "我去", "我想想", "好嘛", "别的", "不错", "可以的话", "对不起", "不好意思", "快要", "行不",
    "可不可以", "嗯", "唔", "谢谢", "等一下再去",
)  # fmt: skip
BEFORE_EN = ("", "um, ", "uh ", "well, ", "oh ", "robot, ", "Pons ", "ah... ", "thanks, ", "so ")
AFTER_EN = ("", ".", "!", " please", ", thanks", ", robot", " thank you!", "...", " then")
BEFORE_ZH = ("", "嗯，", "嗯 ", "呃", "那", "哦，", "那就", "机器人，", "啊 ", "请", "还是")
AFTER_ZH = ("", "。", "！", "，谢谢", "谢谢您", "…", "，机器人", " ", "～")
_TRADITIONAL = str.maketrans(
    "没问题对过开当请谢这别确认还时暂样来动继续说个机们愿绝准发见",
    "沒問題對過開當請謝這別確認還時暫樣來動繼續說個機們願絕準發見",
)


@st.composite
def spoken(draw: st.DrawFn, meaning: bool) -> str:
    """Draw one way to say a word: fillers, courtesy, repetition, script, width, case."""
    word = draw(st.sampled_from(ASKED[meaning]))
    english = word.isascii() or "’" in word
    befores, afters = (BEFORE_EN, AFTER_EN) if english else (BEFORE_ZH, AFTER_ZH)
    before, after = draw(st.sampled_from(befores)), draw(st.sampled_from(afters))
    if word.startswith("uh"):
        before = ""  # "uh uh-huh" may begin with "uh-uh", a no
    again = draw(st.sampled_from(("", " ", ", ") if english else ("", "，", " ")))
    gap = draw(st.booleans())
    said = f"{before}{word}{again or ' '}{word}{after}" if gap else f"{before}{word}{after}"
    if draw(st.booleans()):
        said = said.translate(_TRADITIONAL)
    return draw(st.sampled_from(WRITTEN))(said)


def wide(text: str) -> str:
    """Write the letters of a text as wide as Chinese ones."""
    return "".join(chr(ord(c) + 0xFEE0) if "!" <= c <= "~" and c != "'" else c for c in text)


def padded(text: str) -> str:
    return f"  {text} \n"


WRITTEN: tuple[Callable[[str], str], ...] = (str, str.upper, str.title, wide, padded)


@given(spoken(meaning=True))
def test_a_yes_stays_one_however_it_is_said(said: str) -> None:
    assert consents(said) is True


@given(spoken(meaning=False))
def test_a_no_stays_one_however_it_is_said(said: str) -> None:
    assert consents(said) is False


@given(spoken(meaning=True), spoken(meaning=False), st.booleans())
def test_both_words_are_neither(yes: str, no: str, turned: bool) -> None:
    first, second = (no, yes) if turned else (yes, no)
    assert consents(f"{first}, {second}") is None


TAILS = (
    "?", " if you can", " but slowly", " when I say so", " or", " hm",
    "吗", "呢", "的话", "，等我说",
)  # fmt: skip


@given(st.booleans().flatmap(lambda meaning: spoken(meaning=meaning)), st.sampled_from(TAILS))
def test_a_condition_or_a_question_makes_it_neither(said: str, tail: str) -> None:
    assert consents(f"{said.rstrip()}{tail}") is None


@given(spoken(meaning=True))
def test_what_is_a_yes_is_no_order_to_stop_to_cancel_or_to_pause(said: str) -> None:
    assert not is_stop(said)
    assert not isinstance(intent_of(said), CancelCommand | PauseCommand)


ORDERS = (
    "stop", "halt", "freeze", "cancel", "abort", "pause", "hold on", "emergency stop",
    "停", "停下", "别动", "停止", "取消", "刹车", "站住", "等一下",
)  # fmt: skip
GAPS = (" ", ", ", "，", "")


@given(st.sampled_from(ORDERS), st.sampled_from(ASKED[True]), st.sampled_from(GAPS), st.booleans())
def test_no_word_of_a_stop_or_of_taking_back_is_part_of_a_yes(
    order: str, yes: str, gap: str, first: bool
) -> None:
    assert consents(f"{order}{gap}{yes}" if first else f"{yes}{gap}{order}") is not True


@given(st.text(max_size=200))
def test_any_text_is_read_and_nothing_that_asks_is_a_yes(text: str) -> None:
    assert consents(text) in (True, False, None)
    assert consents(f"{text}?") is None


@pytest.mark.parametrize("answer", NEITHER)
def test_what_is_no_plain_word_is_neither(answer: str) -> None:
    assert consents(answer) is None
