"""One more person is told the same, or the same person more; of two nobody is chosen."""

from __future__ import annotations

import pytest

from planner.language.sentence import parse
from planner.mission.events import Submitted
from planner.mission.reception import receive
from planner.plan import Language
from tests.planner.mission.leaning import (
    NOW_S,
    changed_by,
    means,
    order_asked_about,
    order_under_way,
)

DAD = order_under_way("tell Dad in the study that tea is ready")
DAD_ZH = order_under_way("去书房叫爸爸吃饭")
MUM_ZH = order_under_way("跟卧室的妈妈说我出门了")


@pytest.mark.parametrize("said", ["and Grandma too", "Grandma as well"])
def test_one_more_person_is_told_the_same(said: str) -> None:
    assert means(DAD, said, "tell Grandma in the study that tea is ready")
    heard = receive(DAD, parse(said), Submitted("new", said, Language.EN), NOW_S)
    assert (heard.takes_back, heard.given.first) == (None, True)


@pytest.mark.parametrize("said", ["顺便叫上奶奶", "奶奶也叫一下", "还有奶奶", "也叫奶奶一声"])
def test_so_it_is_in_chinese(said: str) -> None:
    assert means(DAD_ZH, said, "去书房叫奶奶吃饭")


@pytest.mark.parametrize(
    "said",
    [
        "跟奶奶也说一声",
        "也跟奶奶说一声",
        "再去跟奶奶也说一声",
        "奶奶那边也说一下",
        "奶奶也告诉一声",
    ],
)
def test_who_is_told_too_hears_the_words_before(said: str) -> None:
    told = order_under_way("告诉爸爸饭好了")
    assert means(told, said, "告诉奶奶饭好了")


@pytest.mark.parametrize("said", ["还要讲晚上不回来吃饭", "再跟她说一声晚上不回来吃饭"])
def test_the_same_person_is_told_more(said: str) -> None:
    assert means(MUM_ZH, said, "跟卧室的妈妈说“晚上不回来吃饭”")


def test_her_whom_the_order_before_names_is_told_more() -> None:
    wanted = "tell Dad in the study dinner is ready"
    assert means(DAD, "and tell him dinner is ready", wanted)


@pytest.mark.parametrize("said", ["me too", "and me", "and the robot too", "and Dad", "and Dad?"])
def test_nobody_else_is_added(said: str) -> None:
    assert changed_by(DAD, said) is None


@pytest.mark.parametrize("said", ["还要吃饭", "还要说什么", "爸爸呢", "顺便看看"])
def test_nor_is_anybody_in_chinese(said: str) -> None:
    assert changed_by(DAD_ZH, said) is None


def test_who_else_is_meant_waits_until_it_is_known_where_the_first_is() -> None:
    asked = order_asked_about("去叫爸爸吃饭")
    assert changed_by(asked, "顺便叫上奶奶") is None


@pytest.mark.parametrize(
    "said", ["no, tell Grandma", "sorry, I meant Grandma", "tell Grandma instead"]
)
def test_another_person_is_told_in_place_of_the_first(said: str) -> None:
    assert means(DAD, said, "tell Grandma in the study that tea is ready")


@pytest.mark.parametrize("said", ["不对，是告诉奶奶", "我说的是奶奶", "错了，叫奶奶"])
def test_so_another_is_told_in_chinese(said: str) -> None:
    assert means(DAD_ZH, said, "去书房叫奶奶吃饭")


SAYS = order_under_way("go to the study and say tea is ready")
SAYS_ZH = order_under_way("去书房说吃饭了")


@pytest.mark.parametrize(
    ("said", "order"),
    [
        ("say lunch is ready instead", "go to the study and say lunch is ready"),
        ("no, say lunch is ready", "go to the study and say lunch is ready"),
    ],
)
def test_other_words_are_said_in_place_of_the_first(said: str, order: str) -> None:
    assert means(SAYS, said, order)


@pytest.mark.parametrize("said", ["不，说“开会了”", "换成说开会了吧"])
def test_so_other_words_are_said_in_chinese(said: str) -> None:
    assert means(SAYS_ZH, said, "去书房说开会了")


@pytest.mark.parametrize("said", ["say lunch is ready", "if Dad is there, say lunch is ready"])
def test_words_that_take_nothing_back_are_an_order_of_their_own(said: str) -> None:
    assert changed_by(SAYS, said) is None
