"""Short moves, turns, stays, ways, lists and rounds are read as the grammar's own words are."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

SAME = {
    "退后一点": "后退20厘米",
    "你稍微往后退一点点": "后退20厘米",
    "往前开一点点，停": "前进20厘米",
    "往前走半米就停": "前进半米",
    "左转九十度，然后往前两米": "左转九十度，然后往前走两米",
    "转过去": "转身",
    "转半圈": "转身",
    "转过去，对着电视": "面对电视",
    "转过去看着门口": "面对门口",
    "转个圈给小朋友看一下": "转一圈",
    "转两圈看看": "转两圈",
    "退后一点再左转看那边有什么": "后退20厘米，左转，看那边有什么",
    "往前走，走到沙发那里再停": "去沙发",
    "走到门口就停": "去门口",
    "去沙发那待着": "去沙发",
    "去餐桌那里停一下": "去餐桌",
    "你上书房去一趟": "去书房",
    "过来，到沙发这儿来": "去沙发",
    "从走廊过去到卧室": "从走廊去卧室",
    "经过走廊去卧室": "从走廊去卧室",
    "去客厅转一下再回来": "去客厅，再回来",
    "去厨房等五分钟回来": "去厨房，等五分钟，再回来",
    "跟我到厨房，然后在那里等着": "跟我到厨房",
    "你先跟着我，到了客厅停下": "跟着我去客厅",
    "去门口等快递": "去门口等人",
    "去充会儿电": "回去充电",
    "你自己回窝里待着去": "回去充电",
    "你还是去卧室吧": "去卧室",
    "厨房客厅都去看看": "去厨房和客厅看看",
    "客厅、厨房、书房各看一眼": "去客厅和厨房和书房看看",
    "把厨房和客厅看一遍": "去厨房和客厅看看",
    "在厨房和客厅之间来回走三趟": "去厨房然后去客厅，三次",
    "在厨房和客厅之间来回走": "去厨房然后去客厅，两次",
    "全屋走一遍": "巡逻所有房间",
    "每个房间都看一遍": "巡逻所有房间",
    "一个房间一个房间看过去": "巡逻所有房间",
    "家里到处看看": "巡逻所有房间",
    "全屋走一圈看看门窗": "去每个房间看看门窗",
    "家里转一圈看看有没有人": "去每个房间看看有没有人",
    "每个屋都转一圈看看": "巡逻所有房间",
    "挨个屋找找我的书": "找我的书",
    "往前一点，再一点": "前进20厘米，前进20厘米",
    "挪到沙发旁边去": "去沙发",
    "去厨房一趟马上回来": "去厨房，回来",
    "给爷爷找找眼镜": "找眼镜",
}
HELD = (
    *("别退后一点", "不要往后退一点", "他退后一点了", "你退后了吗", "退后还是前进", "不用转三圈"),
    *("别转过去", "你转过来了没有", "不要每个房间都看一遍", "除了厨房每个房间都看一遍"),
    *("全屋走一遍除了卧室", "家里转一圈别去卧室", "我每个房间都看了一遍", "每个房间都看过了"),
    *("厨房和客厅都看过了", "厨房客厅都不要去", "别在厨房和客厅之间来回走", "厨房或者客厅都看看"),
    *("在厨房或客厅之间来回走", "你还是去卧室还是去厨房", "别经过走廊去卧室", "绕过沙发去厨房"),
    *("他走到门口就停了", "妈妈去门口等快递", "去门口等快递来了再回来", "他从厨房走到客厅"),
    *("跟他说，退后一点", "告诉妈妈，往前走一点", "上厨房还是上卧室", "谁上厨房去了"),
    *(
        "全屋走一圈看看门窗了吗",
        "客厅、厨房、书房各看一眼了吗",
        "厨房客厅都去看看了吗",
        "转过去看着门口了吗",
    ),
    *("每个房间都看一遍，回来告诉我有什么不对劲的或者去厨房", "去沙发那待着，我自己来"),
    *("走到沙发那里停了没有", "如果快递来了就去门口", "别去沙发那边待着", "回窝了没有"),
)
MOVES = ("move", "turn", "patrol", "kitchen", "living_room", "bedroom", "study", "sofa", "front")


@pytest.mark.parametrize(("said", "plain"), SAME.items(), ids=ascii)
def test_what_people_say_is_what_the_grammar_says(
    said: str, plain: str, understood: Callable[[str], str]
) -> None:
    wanted = understood(plain)
    assert not wanted.startswith(("clarify", "refuse"))
    assert understood(said) == wanted


@pytest.mark.parametrize("said", HELD, ids=ascii)
def test_what_denies_tells_or_leaves_a_choice_moves_nothing(
    said: str, understood: Callable[[str], str]
) -> None:
    assert understood(said).split(" ")[0].split("=")[0] not in MOVES


def test_no_bed_is_gone_to_by_who_gets_up(understood: Callable[[str], str]) -> None:
    assert understood("看看奶奶起床了没") == "look=看看奶奶起床了没"
    assert understood("去床边") == "bed"
