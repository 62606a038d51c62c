"""A round without some rooms goes to all the others; any other exception moves nothing."""

from __future__ import annotations

from collections.abc import Callable

import pytest

Understood = Callable[[str], str]
ROOMS = {"厨房": "kitchen", "卧室": "bedroom", "书房": "study", "卫生间": "bathroom"}
FORMS = (
    "除了{},别的房间都转一圈",
    "除了{}以外,其他房间都看一遍",
    "帮我除了{},其余的房间都看看有没有人",
    "每个房间转一圈,{}不用去",
    "把所有房间都转一圈,但{}就别进去了",
    "每个房间都看看有没有猫,别进{}",
    "全屋走一遍,跳过{}",
)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("room", ROOMS)
def test_all_other_rooms_are_gone_to(understood: Understood, form: str, room: str) -> None:
    done = understood(form.format(room))
    assert not done.startswith(("refuse", "clarify"))
    assert ROOMS[room] not in done
    assert all(other in done for name, other in ROOMS.items() if name != room)


@pytest.mark.parametrize(
    "said",
    [
        "除了卧室都别去",
        "除了卧室都去看看",
        "除了卧室,别去",
        "除了卧室和阳台都看一遍",
        "除了爷爷都叫来吃饭",
        "每个房间转一圈,别太快",
        "每个房间转一圈,如果有人就不用去卧室",
        "每个房间转一圈,卧室不用去,书房也不用",
        "除了桌子都看一遍",
    ],
)
def test_what_else_is_excepted_moves_nothing(understood: Understood, said: str) -> None:
    assert understood(said).startswith(("refuse", "clarify"))
