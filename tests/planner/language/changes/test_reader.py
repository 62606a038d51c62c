"""What a sentence changes is read by itself: courtesy and a reason change nothing of it."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.language.changes.reader import MAX_READ, lay_out, read_changes, read_rest
from planner.plan import Change, Edit
from tests.planner.mission.leaning import NAMES

LEAVES = (
    "not {}", "skip {}", "you can skip {}", "leave {} out", "don't bother with {}",
    "don't go into {}", "there's no need to look in {}", "never mind {}", "stay out of {}",
)  # fmt: skip
LEAVES_ZH = ("{}就别进了", "{}别进去", "别去{}了", "{}不用看了", "跳过{}", "{}就算了", "不用去{}")


def acts(text: str) -> list[tuple[Edit, str | None]]:
    """Return each act that a sentence may be, with its place."""
    return [(each.act, each.place) for each in read_changes(text, NAMES)]


@pytest.mark.parametrize("form", LEAVES)
@pytest.mark.parametrize("lead", ["", "oh, ", "no, "])
@pytest.mark.parametrize("tail", ["", ", please", ", the door's shut", " because Anna's asleep"])
@pytest.mark.parametrize(("said", "place"), [("the bathroom", "bathroom"), ("my study", "study")])
def test_a_place_is_left_out_however_it_is_said(
    form: str, lead: str, tail: str, said: str, place: str
) -> None:
    assert (Edit.LEAVE_OUT, place) in acts(f"{lead}{form.format(said)}{tail}")


@pytest.mark.parametrize("form", LEAVES_ZH)
@pytest.mark.parametrize("tail", ["", "，门关着呢", "，孩子他爸睡着呢。", "，我刚看过"])
@pytest.mark.parametrize(("said", "place"), [("卫生间", "bathroom"), ("书房", "study")])
def test_so_it_is_in_chinese(form: str, tail: str, said: str, place: str) -> None:
    assert (Edit.LEAVE_OUT, place) in acts(form.format(said) + tail)


@pytest.mark.parametrize(
    "text",
    [
        "not the bathroom if the door is shut", "not the bathroom, go to the kitchen",
        "not the bathroom?", "skip the bathroom and then come back", "go to the bathroom",
        "don't go into the bedroom until I call", "别进卧室，去厨房", "卧室别进去吗？",
        "如果门关着，卧室就别进了", "去卧室",
    ],
)  # fmt: skip
def test_what_says_more_leaves_nothing_out(text: str) -> None:
    assert Edit.LEAVE_OUT not in {act for act, _ in acts(text)}


PAIRS = (
    ("again", "再来一次"),
    ("twice more", "再来两次"),
    ("the other one", "另一个"),
    ("no, the study", "不对，书房"),
    ("not the kitchen, the study", "不是厨房，是书房"),
    ("and the study?", "书房呢"),
    ("skip the study", "跳过书房"),
    ("start with the study", "从书房开始"),
    ("try the study", "那试试书房"),
    ("she's in the study", "她在书房"),
    ("a bit more", "再来一点"),
    ("a bit closer", "再近一点"),
    ("back a bit", "往后退一点"),
    ("the other way", "另一边"),
    ("another 30 degrees", "再转30度"),
    ("was it in the study?", "是在书房看到的吗"),
    ("say it again", "再说一遍"),
    ("tell her again", "再问她一遍"),
)


@pytest.mark.parametrize(("english", "chinese"), PAIRS)
def test_both_languages_read_the_same_change(english: str, chinese: str) -> None:
    """Law: a sentence and its twin fill the same slots; pronouns and marks of courtesy aside."""
    first, second = read_changes(english, NAMES), read_changes(chinese, NAMES)
    assert first
    assert set(first) & set(second)


@pytest.mark.parametrize(
    "text",
    ["", "hello", "the dinner is ready", "no, my name is Tom", "what a lovely kitchen", "天气真好",
     "say hello again", "again if it rains", "如果下雨就再来一次"],
)  # fmt: skip
def test_other_sentences_change_nothing(text: str) -> None:
    assert read_changes(text, NAMES) == ()


@pytest.mark.parametrize(
    ("text", "rest"),
    [
        ("and then tell Priya that tea is ready", "tell Priya that tea is ready"),
        ("when you're done, go home", "go home"),
        ("no, go to the study", "go to the study"),
        ("然后去书房", "去书房"),
        ("again", None),
        ("go to the study", None),
    ],
)
def test_an_order_behind_another_is_left_in_the_persons_words(text: str, rest: str | None) -> None:
    assert read_rest(text) == rest


@given(st.text(max_size=140))
def test_any_text_is_read_or_left(text: str) -> None:
    assert all(isinstance(each, Change) for each in read_changes(text, NAMES))


@pytest.mark.parametrize("length", [MAX_READ + 1, 4_000, 100_000])
@pytest.mark.parametrize("unit", ["again, ", "no, the study, ", "kitchn ", "再来一次，", "it "])
def test_what_is_longer_than_a_word_in_a_conversation_changes_nothing(
    unit: str, length: int
) -> None:
    """Whoever sends it, no name is sought in it: the door asks this before it knows the length."""
    text = (unit * length)[: 2 * length]
    assert len(lay_out(text)) > MAX_READ
    assert read_changes(text, NAMES) == ()
