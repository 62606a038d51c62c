"""Whether something is there is asked in many ways, and looked at in one."""

from __future__ import annotations

from collections.abc import Callable

import pytest

Understood = Callable[[str], str]


@pytest.mark.parametrize(
    "said",
    [
        "{}口这会儿有人没有?",
        "你帮我去看看,{}那里是不是站了个人?",
        "你看一下,{}旁边是不是有个人?",
        "{}现在有人没有",
    ],
)
@pytest.mark.parametrize(("place", "id_"), [("卧室", "bedroom"), ("厨房", "kitchen")])
def test_a_place_is_looked_at(understood: Understood, said: str, place: str, id_: str) -> None:
    done = understood(said.format(place))
    assert done.startswith(f"{id_} look=")
    assert "有没有人" in done


def test_how_it_is_there_is_no_thing(understood: Understood) -> None:
    assert "点热" not in understood("厨房是不是有点热")


@pytest.mark.parametrize("said", ["去客厅看到晚上七点", "去书房守到九点", "看到天亮"])
def test_until_when_is_no_part_of_what_is_looked_at(understood: Understood, said: str) -> None:
    assert understood(said).startswith(("clarify", "refuse"))


@pytest.mark.parametrize("said", ["你回去吧", "好了,你先回去吧", "回去充电歇一歇吧", "回窝充电去"])
def test_who_is_sent_away_goes_home(understood: Understood, said: str) -> None:
    assert understood(said) == "return_home"


@pytest.mark.parametrize("said", ["你别回去", "你回去看看", "你回去吗"])
def test_what_is_denied_asked_or_more_does_not(understood: Understood, said: str) -> None:
    assert understood(said) != "return_home"


@pytest.mark.parametrize("said", ["该吃饭了去叫大家", "该吃饭了,去叫大家来", "该吃饭了,喊一下大家"])
def test_why_they_are_called_is_said(understood: Understood, said: str) -> None:
    assert understood(said) == "say=该吃饭了"
