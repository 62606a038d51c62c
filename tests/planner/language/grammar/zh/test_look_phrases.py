"""States, whereabouts, numbers and reports are asked for in many ways, and read in each."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from planner.language.grammar.plain_words import in_order_words

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.plan import Vocabulary

SAME = {
    "大门关了没有": "看看大门关了没有",
    "大门关没关": "看看大门关了没有",
    "去看看大门有没有关": "看看大门关了没有",
    "大门是不是开着的": "看看大门开着没有",
    "电视还开着没": "看看电视开着没有",
    "去洗手间看看灯有没有关": "去洗手间看看灯关了没有",
    "卫生间的灯是开着还是关着": "看看卫生间的灯开着没有",
    "冰箱关好了没，去看一下": "看看冰箱关好了没有",
    "火关了没，去厨房看看": "去厨房看看火关了没有",
    "厨房水龙头好像没关，你去看看": "看看厨房水龙头关了没有",
    "看看奶奶在沙发上睡着了没有": "去沙发看看奶奶睡着了没有",
    "去看看爸爸在书房干嘛呢": "去书房看看爸爸在做什么",
    "一间一间地看，看看哪里灯没关": "去每个房间看看灯关了没有",
    "看看我的杯子在哪": "找我的杯子",
    "帮我找找书包放哪了": "找书包",
    "我的拖鞋你看看丢哪里去了": "找拖鞋",
    "我书包呢？给我找找": "找书包",
    "我找不到我的水杯了，帮我找一下": "找水杯",
    "有没有看到我的水杯啊，帮我找一下": "找水杯",
    "看看哪个房间有瓶子": "找瓶子",
    "我的书不见了，你去卧室看看": "去卧室找书",
    "我好像把杯子落在书房了，你去看看": "去书房找杯子",
    "去书房找书，应该在那儿": "去书房找书",
    "看看伞在不在门口": "看看门口有没有伞",
    "床底下帮我看看有没有球": "看看床底下有没有球",
    "看看家里有没有人": "去每个房间看看有没有人",
    "先去餐桌那儿，再去沙发那儿，看看哪边有杯子": "去餐桌和沙发看看有没有杯子",
    "数一下总共几个瓶子": "数一下瓶子",
    "你数一下餐桌那边有几张椅子": "数一下餐桌的椅子",
    "餐桌上摆了几个碗": "数一下餐桌的碗",
    "宝宝醒了没有，去卧室看看": "去卧室看看宝宝醒了没有",
    "瓶子还剩几个，你去厨房数数": "去厨房数瓶子",
    "数一下沙发上坐着几个人": "数一下沙发上的人",
    "看看家里有什么异常": "去每个房间看看有什么异常",
    "你能看见我不": "你能看见我吗",
    "上厨房数数还剩几个瓶子": "去厨房数瓶子",
    "去厨房看看有什么，回来跟我说": "去厨房看看有什么，然后回来",
    "先去厨房看看有什么，然后过来告诉我": "先去厨房看看有什么，然后回来",
    "每个房间都看一遍，回来告诉我有什么不对劲的": "巡逻所有房间，然后回来",
    "去客厅数椅子，数完回来告诉我": "去客厅数椅子，然后回来",
    "去大门看一下，看完就回去充电": "去大门看一下，然后回去充电",
    "去书房找书，找到了告诉我": "去书房找书",
    "去厨房，回来告诉我有没有人": "去厨房看看有没有人，然后回来",
}
STILL = (
    *("大门没关", "大门关了", "把灯关了", "大门关了就回去充电", "等大门关了再去厨房", "灯没关"),
    *("昨天大门关了没有", "你把灯关了没有", "妈妈把门关了没有", "我的杯子不见了", "我找不到杯子了"),
    *("看完电视再去厨房", "等我看完电视再去厨房", "妈妈讲完就去充电", "去撞他", "别看大门关了没有"),
    *("如果灯没关就去厨房", "我把杯子落在书房了", "找不到杯子", "回来告诉我", "厨房水龙头好像没关"),
)
DRIVES = {"kitchen", "study", "bedroom", "front_door", "charging_dock", "return_home", "come_back"}
TOLD = ("跟妈妈说灯关没关", "问爸爸，大门关没关", "告诉他：退后一点", "妈妈喊你转过去")


@pytest.mark.parametrize(("said", "plain"), SAME.items(), ids=ascii)
def test_what_people_ask_is_what_the_grammar_asks(
    said: str, plain: str, understood: Callable[[str], str]
) -> None:
    wanted = understood(plain)
    assert not wanted.startswith(("clarify", "refuse"))
    assert understood(said) == wanted


@pytest.mark.parametrize("said", STILL, ids=ascii)
def test_what_tells_hangs_on_something_or_is_past_drives_nowhere(
    said: str, understood: Callable[[str], str]
) -> None:
    assert understood(said).split(" ")[0] not in DRIVES
    assert not understood(said).startswith("find=")


@pytest.mark.parametrize("said", TOLD, ids=ascii)
def test_words_for_others_are_left_as_they_are(said: str, home: Vocabulary) -> None:
    assert in_order_words(said, home) == said


@pytest.mark.parametrize("turned", ["向后转", "转过去", "转身"])
def test_nobody_turns_twice_to_look_behind(turned: str, understood: Callable[[str], str]) -> None:
    steps = understood(f"{turned}，看看后面有没有人").split(" ")
    assert [step.split("=")[0] for step in steps] == ["turn", "look"]
