"""Look, find, count and follow as people say it: a question is looked at, an order is done.

A bare question moves the robot to the place that it names, and nowhere without one.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest

from planner.language.grammar.context import Context
from planner.language.grammar.parser import plan
from planner.plan import EVERY_KIND, Clarify, Code, Find, StepPlan, Vocabulary

AT_A_PLACE = {
    "看看客厅有什么": "living_room",
    "客厅里有什么": "living_room",
    "客厅里都有谁": "living_room",
    "看一下厨房有什么东西": "kitchen",
    "厨房有杯子吗": "kitchen",
    "厨房有杯子？": "kitchen",
    "有人在厨房吗": "kitchen",
    "有人在厨房？": "kitchen",
    "请问有人在厨房": "kitchen",
    "有谁在厨房": "kitchen",
    "有没有杯子在桌子上": "desk",
    "看看有人在厨房": "kitchen",
    "客厅灯亮着？": "living_room",
    "客厅干净吗": "living_room",
    "看看客厅灯亮着": "living_room",
    "厨房看看有没有人": "kitchen",
    "厨房看到有人吗": "kitchen",
    "看看有没有人在厨房": "kitchen",
    "客厅有没有人": "living_room",
    "客厅现在什么情况": "living_room",
    "书房的灯亮着吗": "study",
    "门口是谁": "front_door",
    "看看电视开着没有": "tv",
    "拍一张厨房的照片": "kitchen",
    "我的手机在沙发上吗": "sofa",
    "谁坐在沙发上": "sofa",
    "书房还有椅子吗": "study",
    "what is in the kitchen?": "kitchen",
    "have a look what's in the kitchen": "kitchen",
    "see what's on the desk": "desk",
    "is anybody in the living room?": "living_room",
    "anyone in the kitchen?": "kitchen",
    "anyone in the kitchen": "kitchen",
    "someone in the kitchen?": "kitchen",
    "is there someone in the kitchen": "kitchen",
    "are there any cups on the desk": "desk",
    "do you see someone in the kitchen": "kitchen",
    "can you see the cup on the desk": "desk",
    "describe the kitchen": "kitchen",
}
HERE = (
    "有没有人", "有人吗？", "有人？", "看看有没有人", "这里有没有人", "房间里有人吗", "地上有什么",
    "有没有杯子", "看到人了吗", "你看到几个人", "有几把椅子", "数一数这里有几个人", "这是什么",
    "数一下这个房间里的人", "count the people in this room",
    "is anybody there?", "anybody there?", "any people around?", "is there a cup?",
    "do you see anyone", "how many chairs do you see", "how many people are in here",
    "how many chairs are there?",
)  # fmt: skip
OTHERS = {
    "去厨房看看有没有人，告诉他饭好了": (
        "kitchen look=看看有没有人@kitchen find=人@kitchen say=饭好了"
    ),
    "去厨房看看有没有人，然后回来告诉我": "kitchen look=看看有没有人@kitchen come_back",
    "go to the kitchen and tell me where the cup is": "kitchen find=cup@kitchen",
    "到处找找我的手机": "find=手机",
    "去厨房找找看有没有杯子": "kitchen find=杯子@kitchen",
    "家里有几个箱子": "count=箱子",
    "数数家里有多少人": "count=人",
    "数一下家里有几把椅子": "count=椅子",
    "厨房有几个人和几把椅子": "kitchen count=人@kitchen count=椅子@kitchen",
    "家里有几个人和多少只猫": "count=人 count=猫",
    "看看门关了没": "front_door look=看看门关了没@front_door",
    "检查一下冰箱关好了没有": "fridge look=检查一下冰箱关好了没有@fridge",
    "find the cup behind you": "clarify not_understood",
    "find my phone on your left": "clarify not_understood",
    "go to the chair behind you": "clarify not_understood",
    "找你后面的杯子": "clarify not_understood",
    "look up at the ceiling": "clarify not_understood",
    "look out": "clarify not_understood",
    "look down and tell me what you see": "clarify not_understood",
    "look after the baby": "clarify not_understood",
    "把门关了没有": "clarify not_understood",
    "看看没关的门": "clarify not_understood",
    "search the whole house for my phone": "find=phone",
    "count all the boxes in the house": "count=boxes",
    "start following me": "find=person follow=person",
    "follow the person in front of you": "find=person follow=person",
    "跟着前面那个人": "find=人 follow=人",
    "check on the baby in the bedroom": "bedroom find=baby@bedroom",
}
SAID_FLATLY = (
    "厨房有杯子", "客厅有人", "there is a cup in the kitchen", "have breakfast in the kitchen",
    "有人在厨房", "有杯子在桌子上。", "有这么多人在厨房", "客厅灯亮着", "客厅的灯还开着呢",
    "电视开着", "客厅干净", "厨房看到有人", "厨房有人呢", "someone in the kitchen.",
    "something on the desk", "someone here.", "what is behind you", "what do you see on your left",
    "where is everyone", "他们在哪里",
)  # fmt: skip
NOT_AHEAD = (
    "tell me what is behind you", "who's behind you?", "is there someone behind you",
    "can you see anyone behind you", "describe what is behind you", "who is to the right",
    "how many people are behind you", "tell me what you see on your left",
    "is there a chair on your right?",
    "go to the kitchen and tell me what is behind you", "turn left and tell me who is behind you",
    "后面有什么", "告诉我后面有什么", "你背后是谁", "告诉我左边有没有人", "描述一下你后面有什么",
    "你能看到后面有人吗", "看到谁在你后面", "数一数后面有几个人", "去厨房告诉我后面有什么",
    "向左转，告诉我后面有什么", "看看左边", "look behind you", "check what is behind you",
    "look at the chair on your right", "look to the left and tell me what you see", "look back",
    "turn around and tell me who is behind you", "turn right. what is on your right?",
    "看看后面有没有人", "看看你右边的椅子", "往左边看看有什么", "转身，告诉我后面有什么",
    "看看身后",
)  # fmt: skip
LEANS = (
    *("find it for me plssss", "find them all for me", "count them n tell us", "count em"),
    "找它一下",
)
"""What leans on something before it is no thing."""
LOOKED_AT_AFTER_A_TURN = {
    "turn around and tell me what you see": "turn=180 look=tell me what you see",
    "转身告诉我你看到了什么": "turn=180 look=告诉我你看到了什么",
}
WHEREABOUTS = {
    "where is the red cup?": "red cup",
    "do you know where the ball is": "ball",
    "have you seen my phone?": "phone",
    "is anybody home?": "person",
    "杯子在哪里": "杯子",
    "告诉我椅子在哪里": "椅子",
    "哪个房间里有球": "球",
    "家里有没有人": "人",
}


@pytest.mark.parametrize(("text", "place"), AT_A_PLACE.items(), ids=ascii)
def test_a_question_about_a_place_is_answered_by_looking_there(
    text: str, place: str, understood: Callable[[str], str]
) -> None:
    steps = understood(text).split(" ", 1)
    assert (steps[0], steps[1][:5], steps[1].rsplit("@")[-1]) == (place, "look=", place)


@pytest.mark.parametrize("text", HERE, ids=ascii)
def test_a_question_without_a_place_drives_nowhere(text: str, home: Vocabulary) -> None:
    made = plan(text, home, Context(runnable=EVERY_KIND))
    assert isinstance(made, StepPlan), made
    assert [(step.kind, getattr(step, "place", None)) for step in made.steps] == [("look", None)]


@pytest.mark.parametrize(
    ("text", "steps"),
    {
        **OTHERS,
        **LOOKED_AT_AFTER_A_TURN,
        **dict.fromkeys((*NOT_AHEAD, *LEANS), "clarify not_understood"),
    }.items(),
    ids=ascii,
)
def test_an_order_is_done_and_what_is_ahead_answers_nothing_of_beside_or_behind(
    text: str, steps: str, understood: Callable[[str], str]
) -> None:
    assert understood(text) == steps


@pytest.mark.parametrize("text", SAID_FLATLY, ids=ascii)
def test_what_is_only_told_or_not_to_be_seen_moves_nothing(text: str, home: Vocabulary) -> None:
    made = plan(text, home, Context(runnable=EVERY_KIND))
    assert isinstance(made, Clarify)
    assert made.code is Code.NOT_UNDERSTOOD


@pytest.mark.parametrize(("text", "what"), WHEREABOUTS.items(), ids=ascii)
def test_who_asks_where_something_is_is_offered_a_search(
    text: str, what: str, home: Vocabulary
) -> None:
    made = plan(text, home, Context(runnable=EVERY_KIND))
    assert isinstance(made, Clarify)
    assert made.code is Code.INCOMPLETE
    (offered,) = made.options
    again = plan(offered.text, home, Context(runnable=EVERY_KIND))
    assert again == StepPlan(steps=(Find(object=what),))
    blind = plan(text, home, Context(runnable=frozenset({"go_to"})))
    assert blind.kind == "refuse"


@pytest.mark.parametrize(
    ("text", "what"), {"find his keys": "his keys", "找他的手机": "他的手机"}.items(), ids=ascii
)
def test_what_is_somebodys_is_a_thing(text: str, what: str, home: Vocabulary) -> None:
    assert plan(text, home, Context(runnable=EVERY_KIND)) == StepPlan(steps=(Find(object=what),))
