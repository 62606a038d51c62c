"""Chinese orders whose words stand apart from their marks: speech, rounds, and standing by."""

from __future__ import annotations

from collections.abc import Callable

import pytest

PLACES = {"厨房": "kitchen", "走廊": "hallway", "客厅": "living_room"}
SAID = ("饭好了", "我回来了", "该喝水了")


@pytest.mark.parametrize("words", SAID)
@pytest.mark.parametrize("frame", ["说{}", "请说{}", "说“{}”", "大声说{}", "说{}！"])
def test_words_to_be_said_need_no_marks(
    words: str, frame: str, understood: Callable[[str], str]
) -> None:
    assert understood(frame.format(words)) == f"say={words}"


@pytest.mark.parametrize("words", SAID)
@pytest.mark.parametrize(("place", "id_"), PLACES.items())
def test_they_are_said_at_their_place(
    words: str, place: str, id_: str, understood: Callable[[str], str]
) -> None:
    assert understood(f"去{place}说{words}，然后回来") == f"{id_} say={words} come_back"


@pytest.mark.parametrize("text", ["说一下你在哪", "说明书在哪", "说说话", "说什么好呢"])
def test_what_asks_is_not_said(text: str, understood: Callable[[str], str]) -> None:
    assert not understood(text).startswith("say=")


@pytest.mark.parametrize(("place", "id_"), PLACES.items())
@pytest.mark.parametrize("frame", ["去{}等到有人来，然后说欢迎", "去{}等有人来，再说欢迎"])
def test_who_stands_by_waits_for_somebody_there(
    place: str, id_: str, frame: str, understood: Callable[[str], str]
) -> None:
    assert understood(frame.format(place)) == f"{id_} wait_for say=欢迎"


def test_who_comes_back_tells_what_came_of_it(understood: Callable[[str], str]) -> None:
    assert understood("去书房，回来告诉我") == "study come_back"


@pytest.mark.parametrize(
    "order", ["后退半米", "前进半米", "转一圈", "向左转", "往前走半米", "去厨房"]
)
def test_whatever_moves_may_be_asked_for_slowly(
    order: str, understood: Callable[[str], str]
) -> None:
    assert understood(f"慢慢地{order}") == understood(f"慢慢{order}") == understood(order)


@pytest.mark.parametrize("frame", ["跟{}的妈妈说“{}”", "去{}跟妈妈说“{}”", "告诉{}的妈妈{}"])
def test_somebody_is_told_the_words_whether_in_marks_or_not(
    frame: str, understood: Callable[[str], str]
) -> None:
    assert understood(frame.format("卧室", "饭好了")).endswith("say=妈妈,饭好了")
