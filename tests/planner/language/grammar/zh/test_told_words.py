"""What is told to somebody is words and orders nothing; a "not" outside them stays."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from planner.language.grammar.zh.told_words import quote_told_words

Understood = Callable[[str], str]

WORDS = ("不用等我吃饭", "别忘了关火", "我晚上不回来了", "不要进厨房", "厨房的水别关")


@pytest.mark.parametrize("words", WORDS)
@pytest.mark.parametrize(
    "tells", ["告诉妈妈", "跟妈妈说", "跟妈妈说一声", "麻烦你通知妈妈", "对妈妈说"]
)
def test_denied_words_are_said(understood: Understood, tells: str, words: str) -> None:
    assert understood(tells + words) == f"find=妈妈 say=妈妈,{words}"


def test_they_are_said_where_the_robot_was_sent(understood: Understood) -> None:
    assert understood("先去书房,再告诉爷爷别熬夜") == "study find=爷爷@study say=爷爷,别熬夜"


@pytest.mark.parametrize(
    "said",
    [
        "别告诉妈妈我摔了杯子",
        "不要跟爸爸说我回来了",
        "告诉妈妈不用了",
        "告诉妈妈没有",
        "告诉爷爷饭好了,别去卧室",
        "别去厨房,告诉妈妈不用等我",
        "告诉妈妈完了别去厨房",
        "告诉我没有人",
        "跟着妈妈不要停",
        "叫爸爸不去了",
    ],
)
def test_a_denied_order_stays_denied(understood: Understood, said: str) -> None:
    assert understood(said).startswith(("refuse", "clarify"))


def test_words_without_a_denial_are_left_alone() -> None:
    assert quote_told_words("告诉妈妈饭好了") == "告诉妈妈饭好了"
    assert quote_told_words("tell Mum not to wait") == "tell Mum not to wait"


@pytest.mark.parametrize("says", ["说一句", "大声说一句", "喊一声", "喊一嗓子", "说声"])
@pytest.mark.parametrize("words", ["汤好了", "欢迎光临", "水开了"])
def test_how_loud_or_how_often_is_none_of_the_words(
    understood: Understood, says: str, words: str
) -> None:
    for order in (f"{says}{words}", f"去厨房,{says}{words}", f"等十分钟,然后{says}{words}"):
        assert understood(order).endswith(f"say={words}")


@pytest.mark.parametrize(
    "said", ["跟爷爷说一声", "跟爷爷也说一声", "告诉爷爷一声", "去跟爷爷说一下"]
)
def test_which_words_is_asked_where_none_are_told(understood: Understood, said: str) -> None:
    assert understood(said) == "clarify incomplete"


@pytest.mark.parametrize("who", ["那位", "那位老人", "的人"])
def test_whoever_is_in_a_room_is_asked_there(understood: Understood, who: str) -> None:
    assert understood(f"问一下卧室里{who}几点出门").startswith("bedroom find=")


@pytest.mark.parametrize("said", ["再往前走一点点,好,就一点", "往前走一点,就一点点"])
def test_only_a_bit_is_the_same_bit(understood: Understood, said: str) -> None:
    assert understood(said) == "move=0.2"


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ("上客厅来提醒我关火", "关火"),
        ("到客厅来叫我起床", "起床"),
        ("来客厅跟我说,该休息眼睛了", "该休息眼睛了"),
        ("去客厅提醒我不要忘了吃药", "不要忘了吃药"),
    ],
)
def test_where_the_robot_is_sent_the_speaker_hears_the_words(
    understood: Understood, said: str, words: str
) -> None:
    assert understood(said) == f"living_room say={words}"


@pytest.mark.parametrize("said", ["去客厅叫我", "来客厅跟我说厨房有没有人", "来客厅跟我说一声"])
def test_what_is_to_be_found_out_is_no_words(understood: Understood, said: str) -> None:
    assert "say=" not in understood(said)


@pytest.mark.parametrize("who", ["孩子他爸", "宝宝妈妈", "孩子奶奶"])
def test_who_is_called_by_the_child_is_one_person(understood: Understood, who: str) -> None:
    assert understood(f"去卧室喊{who}起来") == f"bedroom find={who}@bedroom say={who},起来"


@pytest.mark.parametrize("said", ["在这里等,我说“走”再去厨房", "在这里等,我说走再去厨房"])
def test_a_word_that_is_waited_for_is_heard_in_its_marks(understood: Understood, said: str) -> None:
    assert understood(said) == understood("在这里等,我说走再去厨房")
    assert understood(said).startswith("wait_for")


@pytest.mark.parametrize(("often", "times"), [("两遍", 2), ("三声", 3), ("五次", 5)])
@pytest.mark.parametrize("words", ["开饭了", "“开饭了”"])
def test_words_are_said_as_often_as_is_told(
    understood: Understood, often: str, times: int, words: str
) -> None:
    said = " ".join(["say=开饭了"] * times)
    assert understood(f"喊{often}{words}") == said
    assert understood(f"去书房喊{often}{words}") == f"study {said}"


@pytest.mark.parametrize("said", ["出来一下", "快出来", "来这边一下", "过来"])
def test_where_the_speaker_is_is_asked(understood: Understood, said: str) -> None:
    assert understood(said) == "clarify incomplete"
