"""State the laws of what is offered and told: no offer inverts an order, no reason is untrue."""

from __future__ import annotations

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from planner.language.grammar import Context
from planner.language.grammar import plan as plan_in
from planner.plan import (
    EVERY_KIND,
    RUNNABLE,
    AnswerPlan,
    Clarify,
    Code,
    Refuse,
    StepPlan,
    places_of,
)
from tests.laws import at_least
from tests.planner.brain.conftest import HOME, NOON

SIMPLE = [entry.id for entry in HOME.entries]
TRADITIONAL = str.maketrans(
    "厅厨卧卫间书过视电冰箱门关闭别开离边还灯断对请务无锁应绝许准进个让从们这调样",
    "廳廚臥衛間書過視電冰箱門關閉別開離邊還燈斷對請務無鎖應絕許準進個讓從們這調樣",
)

DENIED_EN = [
    *("don't go to the {p}", "do not go near the {p}", "dont go to the {p}", "never go to the {p}"),
    *(
        "Don’t you dare go to the {p}",
        "you must not go to the {p}",
        "not the {p}",
        "not to the {p}",
    ),
    *("go to every room but the {p}", "anywhere but the {p}", "all rooms, but the {p}"),
    *("go everywhere except the {p}", "anywhere except for the {p}", "any room other than the {p}"),
    *("go out without passing the {p}", "excluding the {p}, go everywhere", "skip the {p}"),
    *(
        "go home instead of the {p}",
        "rather than the {p} go home",
        "avoid the {p}",
        "forget the {p}",
    ),
    *(
        "stay out of the {p}",
        "keep away from the {p}",
        "keep off the {p}",
        "stay away from the {p}",
    ),
    *("turn off the {p}", "turn the {p} off", "switch off the {p}", "disable the {p}"),
    *("turn off everything in the {p}", "shut down the {p}", "unplug the lamp in the {p}"),
    *("the {p} is off limits", "no going to the {p}", "leave the {p}", "get out of the {p}"),
    *("go anywhere apart from the {p}", "go anywhere besides the {p}", "omit the {p}"),
    *("come out of the {p}", "you are not allowed in the {p}", "no {p}", "leave out the {p}"),
    *(
        "i don't want you in the {p}",
        "nobody but the {p}",
        "quit the {p}",
        "under no circumstances the {p}",
    ),
]
DENIED_ZH = [
    *(
        "别去{p}",
        "不要去{p}",
        "不许进{p}",
        "勿去{p}",
        "莫去{p}",
        "甭去{p}",
        "唔好去{p}",
        "唔使去{p}",
    ),
    *(
        "咪去{p}",
        "咪行去{p}",
        "千祈唔好去{p}",
        "少去{p}",
        "少来{p}",
        "不用去{p}了",
        "{p}就不用去了",
    ),
    *(
        "除了{p}都去",
        "除了{p}以外都去",
        "除{p}外都去",
        "{p}以外的房间都去",
        "{p}之外都去",
        "{p}外都去",
    ),
    *(
        "除开{p}",
        "关掉{p}",
        "关闭{p}",
        "把{p}关掉",
        "关掉{p}里的灯",
        "断开{p}",
        "停用{p}",
        "禁止去{p}",
    ),
    *("避开{p}", "绕开{p}", "离开{p}", "从{p}出来", "{p}不去", "绝不去{p}", "不准进{p}", "跳过{p}"),
    *(
        "去哪都行，别去{p}",
        "哪里都可以去，{p}除外",
        "我不想你去{p}",
        "不是{p}",
        "没让你去{p}",
        "排除{p}",
    ),
]
BEFORE_EN = ["", "please ", "hey robot, ", "um, ", "ok ", "listen, ", "could you "]
AFTER_EN = ["", " please", ", ok?", " or the hallway", ", thanks", " and come back", " now!"]
BEFORE_ZH = ["", "请", "麻烦你", "嗯，", "机器人，", "那个，", "你"]
AFTER_ZH = ["", "吧", "，谢谢", "，好吗", "或者走廊", "，然后回来", "！"]


def plan(
    text: str, runnable: frozenset[str] = EVERY_KIND
) -> StepPlan | AnswerPlan | Clarify | Refuse:
    return plan_in(text, HOME, Context(room="study", runnable=runnable, now=NOON))


def named(made: StepPlan | AnswerPlan | Clarify | Refuse) -> set[str]:
    """Return the places that a plan moves to, or that the options of a question would."""
    plans = [plan(option.text) for option in made.options] if isinstance(made, Clarify) else [made]
    assert all(isinstance(one, StepPlan) for one in plans) or not isinstance(made, Clarify)
    steps = [step for one in plans if isinstance(one, StepPlan) for step in one.steps]
    return {place for step in steps for place in places_of(step)}


def assert_never_there(text: str, place: str, runnable: frozenset[str]) -> None:
    made = plan(text, runnable)
    assert place not in named(made), text
    if isinstance(made, Clarify):
        spellings = HOME.by_id[place].spellings
        offered = f"{made.options} {made.question.en.partition('Did you mean')[2]}".casefold()
        assert not any(name.casefold() in offered for name in spellings), (text, offered)


@given(
    st.sampled_from(DENIED_EN),
    st.sampled_from(SIMPLE),
    st.sampled_from(BEFORE_EN),
    st.sampled_from(AFTER_EN),
    st.sampled_from([EVERY_KIND, RUNNABLE]),
    st.sampled_from([str.lower, str.upper, str.capitalize]),
)
@at_least(400)
def test_what_is_denied_in_english_is_neither_driven_to_nor_offered(
    denied: str, place: str, before: str, after: str, runnable: frozenset[str], case: object
) -> None:
    text = before + denied.format(p=HOME.by_id[place].name.en) + after
    assert callable(case)
    assert_never_there(str(case(text)), place, runnable)


@given(
    st.sampled_from(DENIED_ZH),
    st.sampled_from(SIMPLE),
    st.sampled_from(BEFORE_ZH),
    st.sampled_from(AFTER_ZH),
    st.sampled_from([EVERY_KIND, RUNNABLE]),
    st.booleans(),
)
@at_least(400)
def test_what_is_denied_in_chinese_is_neither_driven_to_nor_offered(
    denied: str, place: str, before: str, after: str, runnable: frozenset[str], old: bool
) -> None:
    text = before + denied.format(p=HOME.by_id[place].name.zh) + after
    assert_never_there(text.translate(TRADITIONAL) if old else text, place, runnable)


WHAT_IT_CAN = [
    *("turn {s}", "turn a bit to the {s}", "make a {s} turn", "take a {s}", "take the next {s}"),
    *("turn {s} ninety-ish degrees", "go {s}", "a little {s}", "spin around twice", "do a u-turn"),
    *("make a {s}", "rotate slightly {s}", "turn to face the sofa", "turn towards the {s} wall"),
    *("take two steps forward", "do a lap of the kitchen", "take a tour of the house", "get going"),
    *("make a loop through the kitchen", "bring yourself to the kitchen", "set off", "come closer"),
    *("go patrol around a bit please", "hold your position", "take me somewhere nice", "give way"),
    *(
        "tell me a secret",
        "say it again",
        "tell us what you think",
        "report",
        "carry on",
        "hang on",
    ),
    *(
        "往{z}转一点",
        "向{z}稍微转一下",
        "转半圈",
        "转两圈",
        "原地转个身",
        "绕餐桌一圈",
        "往前走两步",
    ),
    *(
        "往{z}挪一点",
        "朝{z}边看着走",
        "去客厅放松一下",
        "讲讲你的看法",
        "说一下情况",
        "关于厨房",
        "后退一步",
    ),
]


@given(
    st.sampled_from(WHAT_IT_CAN),
    st.sampled_from([("left", "左"), ("right", "右")]),
    st.sampled_from(["{}", "please {}", "go to the kitchen, then {}", "{} and come back"]),
    st.sampled_from(["{}", "请{}", "去厨房，然后{}"]),
)
@at_least(300)
def test_no_means_is_not_told_of_what_wheels_and_a_voice_can_do(
    order: str, side: tuple[str, str], english: str, chinese: str
) -> None:
    frame = english if order[0].isascii() and "{z}" not in order and order.isascii() else chinese
    made = plan(frame.format(order.format(s=side[0], z=side[1])), RUNNABLE)
    assert getattr(made, "code", None) is not Code.NO_CAPABILITY, made


@pytest.mark.parametrize(
    "text",
    [
        *("no problem, go to the kitchen", "no rush, go to the kitchen", "why not the kitchen?"),
        *("why don't you go to the kitchen", "don't forget to go to the kitchen", "don't worry"),
        *("go to the kitchen instead", "when you are done, go to the kitchen", "Don, go home"),
        *("go to the kitchen, Donald", "find the donut", "done", "I can't find my keys"),
        *("never mind", "you can't miss it", "I have never been to the kitchen", "not bad"),
        *(
            "我没电了，去充电",
            "不好意思，去厨房",
            "差不多了，去厨房",
            "去特别的厨房",
            "分别去厨房和书房",
        ),
        *(
            "找不锈钢杯子",
            "没关系，去厨房",
            "別墅在哪裡",
            "别忘了去厨房",
            "能不能去一下厨房呢",
            "不错",
        ),
        *("你为什么不去厨房", "我不知道", "没事", "去别的房间"),
    ],
)
def test_a_denial_is_not_told_where_nothing_was_denied(text: str) -> None:
    assert getattr(plan(text), "code", None) is not Code.NEGATED, plan(text)


@pytest.mark.parametrize(
    "text",
    [
        *("go to the kitchen tomorrow", "go to the kitchen later", "go to the kitchen at 5 pm"),
        *("if you please go to the kitchen", "go to the kitchen if you don't mind", "what else"),
        *("when did you last see my keys", "if possible go to the kitchen", "what if"),
        *(
            "明天去厨房",
            "方便的话去厨房",
            "往左转一点点",
            "是不是该去厨房了",
            "要不要去厨房",
            "过一会去厨房",
        ),
    ],
)
def test_a_condition_is_not_told_where_there_is_none(text: str) -> None:
    assert getattr(plan(text), "code", None) is not Code.CONDITIONAL, plan(text)


@pytest.mark.parametrize(
    "text",
    [
        "take a quick look at the kitchen",
        "drive forward for 3 seconds",
        "a quick question",
        "no hurry",
    ],
)
def test_a_speed_is_not_told_where_there_is_none(text: str) -> None:
    assert getattr(plan(text), "code", None) is not Code.OUT_OF_SCOPE, plan(text)


TOLD = {
    "go to the kitchen, but never to the bedroom": ("negated", "“never to the bedroom”"),
    "go to every room but the sofa": ("negated", "“but the sofa”"),
    "go anywhere except the kitchen": ("negated", "“except the kitchen”"),
    "please don't go to the study": ("negated", "“do not go to the study”"),
    "if the door is open, go to the kitchen": ("conditional", "“if the door is open”"),
    "go to the kitchen when I call": ("conditional", "“when i call”"),
    "go home, then drive slowly": ("out_of_scope", "“then drive slowly”"),
    "先去厨房，别去卧室": ("negated", "“别去卧室”"),
    "除了卧室都去看看": ("negated", "“除了卧室”"),
    "如果门开着就去厨房": ("conditional", "“如果门开着”"),
    "有人的话去厨房": ("conditional", "“有人的话”"),
    "no problem, go to the kitchen": ("not_understood", "“no problem”"),
    "wait 0 seconds": ("not_understood", "“wait 0 seconds”"),
}


@pytest.mark.parametrize("text", TOLD)
def test_a_reason_names_the_part_that_it_is_true_of(text: str) -> None:
    made = plan(text)
    assert isinstance(made, Clarify | Refuse)
    said = made.question if isinstance(made, Clarify) else made.reason
    code, part = TOLD[text]
    assert (made.code, part in said.en) == (code, True), said


OFFERING = [
    *("the {p}", "um the {p} please", "bring me the cup from the {p}", "find my keys in the {p}"),
    *("go to the {p} and fly", "where is the cup", "are you able to reach the {p} at all"),
    *("去趟{z}那儿呗", "{z}", "去{z}拿可乐", "去{z}然后飞起来", "去{z}找钥匙", "杯子在哪"),
]


@given(st.sampled_from(OFFERING), st.sampled_from(SIMPLE), st.sampled_from([EVERY_KIND, RUNNABLE]))
@example("the {p}", "kitchen", RUNNABLE)
def test_an_offer_is_an_order_that_is_planned_without_a_question(
    words: str, place: str, runnable: frozenset[str]
) -> None:
    name = HOME.by_id[place].name
    made = plan(words.format(p=name.en, z=name.zh), runnable)
    for option in made.options if isinstance(made, Clarify) else ():
        assert isinstance(plan(option.text, runnable), StepPlan), option


@pytest.mark.parametrize(
    "text", ["我的眼镜找不到了", "找不到我的手机", "我看不到电视了", "够不到冰箱"]
)
def test_what_could_not_be_done_denies_no_order(text: str) -> None:
    assert getattr(plan(text), "code", None) is not Code.NEGATED, plan(text)
    assert getattr(plan("不到厨房去"), "code", None) is Code.NEGATED
