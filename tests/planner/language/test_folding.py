"""Check the one folding of text: stable, and the same for every way of writing one word."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.language.folding import fold, fold_script, fold_width, fold_words, unmask
from planner.language.script_table import SIMPLIFIED, TRADITIONAL
from planner.language.sentence import language_of
from planner.plan import Language


@given(st.text(max_size=100))
def test_folding_twice_changes_nothing_more(text: str) -> None:
    assert fold(fold(text)) == fold(text)
    assert fold_words(fold_words(text)) == fold_words(text)


@given(st.text(alphabet=TRADITIONAL, max_size=30))
def test_traditional_characters_fold_to_their_simplified_forms_one_by_one(text: str) -> None:
    folded = fold_script(text)
    assert len(folded) == len(text)
    assert not set(folded) & (set(TRADITIONAL) - set(SIMPLIFIED))


@given(st.text(alphabet="abcxyz ", max_size=30))
def test_width_and_case_do_not_matter(text: str) -> None:
    wide = "".join(chr(ord(char) + 0xFEE0) if char != " " else "\u3000" for char in text.upper())
    assert fold(wide) == fold(text)
    assert fold_width(wide) == text.upper()


@pytest.mark.parametrize(
    ("written", "folded"),
    [
        ("别過來", "别过来"),
        ("停止任務", "停止任务"),
        ("幫我停下來", "帮我停下来"),
        ("去書房等十秒鐘", "去书房等十秒钟"),
        ("巡邏客廳", "巡逻客厅"),
        ("ＳＴＯＰ！", "stop!"),
        ("煞車", "刹车"),
    ],
)
def test_the_words_of_orders_fold(written: str, folded: str) -> None:
    assert fold(written) == folded


@pytest.mark.parametrize(
    "text", ["st\u200bop", "ѕtор", "s\u0301top", "\u202estop", "stοp", "st\u00adop"]
)
def test_what_looks_like_stop_is_read_as_stop(text: str) -> None:
    assert unmask(fold(text)) == "stop"


def test_the_language_is_the_one_with_more_words() -> None:
    assert language_of("go to the 厨房") is Language.EN
    assert language_of("去kitchen") is Language.ZH
    assert language_of("") is Language.EN
