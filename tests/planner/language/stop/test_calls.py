"""A robot that is called and told to stop is heard in the middle of speech, in both languages."""

from __future__ import annotations

from itertools import product

import pytest

from planner.language.stop import calls_stop, is_stop

BEFORE = ("", "so then she went out and ", "no no no ", "i told her ", "look at that ")
CALLED = (
    *("robot stop", "hey robot stop", "robot please stop", "robot, stop", "pons stop"),
    *("robot will you please just stop", "robot stop it", "robot don't move", "robot halt"),
)
BEHIND = ("", " right there", " you are in my way", " and then we had tea")
BEFORE_ZH = ("", "我们刚才在说", "哎呀", "你看然后")
CALLED_ZH = (
    *("机器人停", "机器人停下", "机器人快停下来", "机器人，停！", "小车停车", "机器人别动"),
    *("机器人站住", "机器人请停一下", "小车快停"),
)
BEHIND_ZH = ("", "你挡着我了", "，然后我们再说")
NO_CALLS = (
    *("tell the robot stop signs are red", "our robot stops at the door", "the robot stopped"),
    *("robot don't stop", "robots stop", "robot go to the bus stop", "robot what is a stop"),
    *("my robot stop button", "stopwatch", "go to the kitchen", "robot", ""),
    *("我的机器人停了", "机器人别停", "机器人不要停", "去厨房找机器人", "你看机器人在走", "机器人"),
)


@pytest.mark.parametrize("called", [*CALLED, *CALLED_ZH])
def test_whatever_is_said_around_it_a_called_stop_is_heard(called: str) -> None:
    around = product(BEFORE, BEHIND) if called in CALLED else product(BEFORE_ZH, BEHIND_ZH)
    assert [each for each in around if not calls_stop(called.join(each))] == []


@pytest.mark.parametrize("text", NO_CALLS)
def test_nobody_is_called_to_stop_here(text: str) -> None:
    assert not calls_stop(text)


@pytest.mark.parametrize("text", ["so I told her, hey robot, stop", "然后机器人快停下来"])
def test_a_called_stop_is_heard_as_soon_as_its_word_is_there(text: str) -> None:
    """A recogniser that streams gives growing pieces: the first with the whole word is enough."""
    heard = [calls_stop(text[:end]) for end in range(len(text) + 1)]
    first = heard.index(True)
    assert all(heard[first:])
    assert text[:first].endswith(("stop", "停"))


@pytest.mark.parametrize(
    ("text", "stops"), [("停", True), ("停车", True), ("停车场", False), ("停车场在哪", False)]
)
def test_a_car_park_stops_only_while_it_is_half_said(text: str, stops: bool) -> None:
    """What 停车 goes on with is not waited for: a needless stop costs a word, a late one a foot."""
    assert is_stop(text) is stops
