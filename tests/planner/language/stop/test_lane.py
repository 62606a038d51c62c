"""Check the stop lane: the table of what stops and what does not, in both languages."""

from __future__ import annotations

import subprocess
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.language.sentence import parse
from planner.language.stop import StopReading, is_stop, read_stop

STOPS = [
    # plain
    *("stop", "Stop!", "STOP", "stop.", "Stop?", "stop...", "  stop  ", "\tstop\n", "stop!!!!11"),
    *("halt", "Freeze!", "HALT HALT", "stop stop stop", "stop, stop, stop!", "stop halt"),
    # polite, urgent, addressed
    *("stop please", "STOP please", "please stop", "Please, stop.", "stop now", "stop right now"),
    *("robot, stop", "Robot stop!", "hey robot, stop", "ok stop", "no, stop!", "No! Stop!"),
    *("wait, stop", "stop at once", "stop immediately", "can you stop", "could you please stop?"),
    *("you can stop now", "I said stop", "quick, stop", "stop thanks", "let's stop", "just stop"),
    # what to stop
    *("stop moving", "stop driving", "stop the robot", "stop it", "stop there", "stop right there"),
    *("stop where you are", "stop everything", "stop following me", "come to a stop", "e-stop"),
    *("emergency stop", "hold still", "stay put", "do not move", "don't move", "Don’t move!"),
    *("dont move", "stay where you are", "abort", "cancel", "cancel the goal", "pause"),
    # the first clause decides, whatever follows
    *("stop, go to the kitchen", "stop and go to the kitchen", "stop then go home", "Stop. Wait."),
    *(
        "stop — the cat!",
        "stop; I need to pass",
        "stop because I say so",
        "stop\ngo to the kitchen",
    ),
    # forms of writing
    *(
        "ｓｔｏｐ",
        "ＳＴＯＰ！",
        "stop！",
        "stop。",
        "🛑",
        "stop 🛑",
        "🛑🛑🛑",
        "✋ stop ✋",
        "stop😡",
    ),
    *("stoooop", "STOPPP!!", "sstop", "s t o p", "S.T.O.P.", "sotp", "stpo", "“stop”", "**stop**"),
    *("st\u200bop", "\ufeffstop", "(stop)", "stop - now", "... stop", "!stop"),
    # Chinese
    *("停", "停！", "停下", "停下来", "停车", "停止", "停一下", "停住", "别动", "不要动", "站住"),
    *(
        "快停",
        "快停下",
        "快快停下",
        "请停",
        "请停下",
        "请你停下来",
        "小车停下",
        "机器人，停！",
        "停停停",
    ),
    *("停！停！停！", "停吧", "停了", "停下好吗", "停下，谢谢", "立刻停止", "马上停车", "现在停下"),
    *(
        "停止移动",
        "停止前进",
        "停止一切动作",
        "急停",
        "紧急停止",
        "刹车",
        "住手",
        "打住",
        "别走",
        "别再走",
    ),
    *(
        "不许动",
        "原地不动",
        "站着别动",
        "能不能停下",
        "可以停了",
        "不，停",
        "等等，停下",
        "喂，别动",
    ),
    *("停，去厨房", "停下然后去厨房", "停。去厨房", "取消任务", "取消", "暂停", "中止", "终止任务"),
    *("停 停 停", " 停 ", "停\u3000下", "停🛑", "停~", "停…", "「停」", "停\n去厨房", "給我停下"),
    *(
        "別動",
        "停車",
        "請停下",
        "站住別動",
        "立刻停止移動",
        "stop吧",
        "please停",
        "停stop",
        "robot 停下",
    ),
]

QUITS = [
    *("stop looking", "stop searching", "stop counting", "stop patrolling", "stooop looking"),
    *(
        "stop looking for the cup",
        "stop looking for the red cup in the kitchen",
        "stop tracking him",
    ),
    *("quit looking", "quit searching", "quit following me", "please quit following me", "quit"),
    *("give up", "give up looking", "give up the search", "cease searching", "quit it"),
    *("cancel the search", "stop the search", "end the search", "call off the search"),
    *("cancel the count", "abort your patrol", "no more searching", "enough looking for it"),
    *("could you stop looking for the cup please", "you can stop looking now"),
    *("stop looking and come back", "stop looking until I say so", "stop running after me"),
    *("stop going to the kitchen", "stop driving to the kitchen", "stop turning left"),
    *("stop coming after me", "stop going in circles", "stop moving towards me"),
    # denied: behind it nothing is left to a brain
    *("don't follow me", "Don’t follow me any more!", "dont follow me", "never follow me again"),
    *("don't look for it any more", "do not search any more", "don't look for the cup"),
    *(
        "please don't count",
        "you shouldn't follow me",
        "you must not follow me",
        "don't follow him",
    ),
    *("I don't want you to follow me", "don't follow me if I go out", "no longer follow me"),
    *("don't look for the cup, find the ball", "don't come after me", "don't keep searching"),
    *("don't come closer", "don't come here", "do not drive", "don't turn any more"),
    *("leave me alone", "stop the robot following me", "stop it from following me"),
    # Chinese
    *("别过来", "别靠近我", "不要再过来了"),
    *("别找了", "不要找了", "停止寻找", "停止搜索", "别跟着我", "别跟着我了", "别跟了", "别数了"),
    *("不要跟着我了", "不要再找了", "别再跟着我", "不要跟我了", "先别找", "别看了", "别转了"),
    *(
        "停止寻找杯子",
        "别找杯子了",
        "不要再数椅子了",
        "停止对杯子的搜索",
        "取消搜索任务",
        "暂停搜索",
    ),
    *("结束寻找", "放弃搜索", "中止跟随", "停止跟着我", "停下别找了", "别找了好吗", "别巡逻了"),
    *("我不要你跟着我", "别跟得太近", "小车别跟着我了谢谢", "先别找，等我一下", "别找杯子，找球"),
    *("別跟著我", "不要再尋找了", "停止搜尋", "別數了", "停止跟隨"),
]
"""A robot that searches, counts or follows is told to quit."""

GOES_ON = [
    # quitting that is asked about, denied, or told for another time or place
    *("find the ball, don't look for the cup", "go to the kitchen and don't look for the cup"),
    *("stop looking when you see the cup", "stop following me when I reach the kitchen"),
    *("why did you stop looking", "did you stop looking?", "don't stop following me", "search"),
    *("do not stop looking", "never stop searching", "don't forget to find the cup", "the search"),
    *("stop waiting", "don't wait", "stop driving so fast", "stop looking after the baby"),
    *("don't turn left", "don't come to the kitchen", "leave me alone with it", "don't go"),
    *("keep looking", "resume the search", "the search engine", "you should find the cup"),
    *("找球，别找杯子", "去厨房，别找杯子", "停止搜索了吗", "停止跟随了没有", "为什么停止搜索"),
    *(
        "不要停止寻找",
        "别停止跟着我",
        "不停地找",
        "别跟丢了",
        "别数错了",
        "别忘了找杯子",
        "别跟他说",
    ),
    *("停止键在哪里", "取消数据上传", "别的杯子", "找杯子", "继续搜索", "搜索"),
    # the word inside another clause
    *("bus stop", "go to the bus stop", "the bus stop", "don't stop", "do not stop", "Don’t stop!"),
    *("dont stop", "never stop", "please don't stop", "no, don't stop", "stop at the kitchen"),
    *("stop by the sofa", "stop by the kitchen", "stop in front of the tv", "stop for 5 seconds"),
    *("stop when you see me", "stop if it is blocked", "stop 2 m before the wall", "stop 2"),
    *(
        "stop talking",
        "stop the music",
        "stop sign",
        "stop-sign",
        "find the stop sign",
        "stopwatch",
    ),
    *("why did you stop", "how do I stop you", "did you stop?", "you stopped", "stopping", "stops"),
    *("non-stop", "nonstop", "one-stop shop", "go to the kitchen and stop", "go, then stop"),
    *("go to the kitchen, stop", "the next stop", "say stop", "full stop sign", "unstoppable"),
    # neighbours that are words of their own
    *("shop", "step", "top", "slop", "stomp", "halter", "freezer", "go to the freezer", "freezing"),
    *("wait", "wait 5 seconds", "wait, go to the kitchen", "hold the door", "cancel culture"),
    *("pause for 5 seconds", "stay in the kitchen", "move", "do not move to the kitchen"),
    # nothing at all
    *("", "   ", "!!!", "please", "robot", "hey, robot", "no", "🙂", "🚏", "\x00", "...", "now"),
    # Chinese
    *(
        "停车位",
        "去停车位",
        "停车场",
        "停车位在哪",
        "停在厨房",
        "停到厨房",
        "停在沙发旁边",
        "不要停",
    ),
    *("别停", "别停下", "不停", "不要停下来", "千万别停", "不准停", "停不停", "停不下来", "停了吗"),
    *(
        "停下没有",
        "停电了",
        "停留",
        "停留在厨房",
        "停靠",
        "停好车",
        "停5秒",
        "停一会儿再走",
        "公交站",
    ),
    *("不要去厨房", "别去厨房", "去厨房停下", "去厨房，停", "然后停下", "如果停下", "停止键在哪"),
    *("等一下", "等等", "请", "小车", "机器人", "快点", "别动厨房的东西", "别走厨房", "取消静音"),
    *(
        "他停下了吗",
        "什么时候停",
        "为什么停下",
        "到站停",
        "暂停键",
        "不停地走",
        "別停",
        "不",
        "你好",
    ),
]


@pytest.mark.parametrize("text", [*STOPS, *QUITS])
def test_stops(text: str) -> None:
    assert is_stop(text)


@pytest.mark.parametrize("text", GOES_ON)
def test_goes_on(text: str) -> None:
    assert not is_stop(text)


STANDING = (
    *("wait there a second", "wait right there one moment", "remain here a minute"),
    *("停在原处", "停在原位", "停在原地"),
)
AROUND = ("{}", "no no, {}, let me move my case", "不对，{}，我要过去")


@pytest.mark.parametrize("order", STANDING)
@pytest.mark.parametrize("around", AROUND)
def test_an_order_to_stand_where_it_is_stops_whatever_is_said_around_it(
    order: str, around: str
) -> None:
    said = around.format(order)
    assert parse(said).reading is not StopReading.NONE


@given(st.text(max_size=200))
@settings(max_examples=150)
def test_any_text_gets_an_answer(text: str) -> None:
    assert is_stop(text) in {True, False}


@given(
    st.sampled_from(["go", "to", "the", "kitchen", "don't", "never", "why did you", "bus"]),
    st.sampled_from(["stop", "halt", "Stop!", "stop moving"]),
)
def test_a_word_before_that_is_no_courtesy_makes_it_another_sentence(
    before: str, rest: str
) -> None:
    assert not is_stop(f"{before} {rest}")


@pytest.mark.parametrize(
    "piece",
    [
        *(
            "stop ",
            "please ",
            "停",
            "快停",
            "麻烦你",
            "you can ",
            "stop it ",
            "can you ",
            "好了",
            "s",
        ),
        *(
            "stop looking ",
            "never ",
            "no more ",
            "the ",
            "别找",
            "停止",
            "别再",
            "停下",
            "我不要你",
        ),
    ],
)
def test_endless_repetition_is_answered(piece: str) -> None:
    """A repeated courtesy must not make the pattern backtrack (the time-out would catch it)."""
    assert is_stop(piece * 25_000 + "x") in {True, False}


def test_a_long_object_is_answered() -> None:
    """Nor may a repeated part of what is quitted."""
    for begun, piece in (
        ("停止", "对"),
        ("别", "找错"),
        ("stop the ", "my "),
        ("stop looking", " a if"),
    ):
        assert is_stop(begun + piece * 380 + "x") in {True, False}


def test_importing_the_stop_lane_brings_in_neither_pydantic_nor_numpy() -> None:
    code = (
        "import sys; from planner.language.stop import is_stop; assert is_stop('stop');"
        "sys.exit(','.join({'pydantic', 'numpy', 'rapidfuzz', 'asyncio'} & set(sys.modules)) or 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, ""), done.stderr


@pytest.mark.parametrize(
    "again", ["and, ", "please, ", "ok, so, ", "robot , , ", "请，", "and 厨房, "]
)
@pytest.mark.parametrize("end", ["", "stop", "go to the kitchen", "x"])
@pytest.mark.timeout(20)
def test_a_courtesy_said_without_end_is_read_at_all(again: str, end: str) -> None:
    """Each comma doubled the ways to read it: 23 of "and, " took a minute, 40 hours."""
    assert read_stop(again * 150 + end) in StopReading
    assert read_stop(again * 60 + end) in StopReading


@pytest.mark.parametrize("lead", ["", "actually ", "oh ", "no wait, ", "hey robot "])
def test_a_bare_denial_may_mean_a_stop_whatever_stands_before_it(lead: str) -> None:
    assert read_stop(f"{lead}don't") is not StopReading.NONE


@pytest.mark.parametrize(
    "said",
    [
        *("emergency", "Emergency!", "this is an emergency", "please, emergency!", "stay there"),
        *("紧急", "紧急！", "紧急情况", "有紧急情况！"),
    ],
)
def test_a_cry_of_an_emergency_stops_what_moves(said: str) -> None:
    assert read_stop(said) is not StopReading.NONE


@pytest.mark.parametrize(
    "said",
    [
        *("go to the emergency exit", "where is the emergency exit", "is there an emergency"),
        *("go to the kitchen and stay there", "no emergency", "call the emergency services"),
        *("去紧急出口", "紧急出口在哪", "这不是紧急情况", "紧急通知妈妈吃饭"),
    ],
)
def test_an_emergency_that_is_a_name_or_none_is_no_stop(said: str) -> None:
    assert read_stop(said) is StopReading.NONE
