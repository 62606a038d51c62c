"""Hold the stop lane to laws: how a stop is said changes nothing, and orders are no stops.

Sentences are made of a way to say stop and of all that people put around it; no list of whole
sentences can be learnt by heart. The other way round, orders of all suites are no stops.
"""

from __future__ import annotations

import time
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from planner.language.commands import CancelCommand, PauseCommand, Replace, intent_of
from planner.language.script_table import SIMPLIFIED, TRADITIONAL
from planner.language.stop import MAX_READ, StopReading, is_stop, read_stop
from pons.evals.suites import MissingSuite
from tests.laws import at_least
from tools.evals.outside import DATA, load_any

NONE = StopReading.NONE
_BACK = {simple: old for old, simple in zip(TRADITIONAL, SIMPLIFIED, strict=True)}

EN_STOPS = st.sampled_from(
    [
        *("stop", "stop it", "stop moving", "stop right there", "halt", "freeze", "emergency stop"),
        *("emergency brake", "brake", "stop the mission", "stop all motors", "stop driving"),
        *("don't move", "do not move", "stand still", "hold still", "stay still", "come to a stop"),
        *("abort", "stop the robot", "stop where you are", "whoa stop", "stop that", "e-stop"),
        *("hold it", "stay there", "don't come any closer", "no further", "stop now", "quit it"),
    ]
)
ZH_STOPS = st.sampled_from(
    [
        *(
            "停",
            "停下",
            "停下来",
            "停车",
            "停止",
            "停一下",
            "别动",
            "不要动",
            "站住",
            "别过来",
            "急停",
        ),
        *("停止任务", "停止运动", "停止所有动作", "紧急制动", "紧急停止", "刹车", "别走了", "住手"),
        *("帮我停下来", "立刻停下", "马上停", "快停下", "别再往前走了", "不要再靠近了", "原地不动"),
    ]
)
EN_BEFORE = st.lists(
    st.sampled_from(
        [
            *(
                "uh",
                "um,",
                "erm",
                "oh no,",
                "hey",
                "hey robot,",
                "Rosie,",
                "please",
                "no no,",
                "ok",
            ),
            *("could you please", "I said", "would you", "excuse me,", "oh my god", "just", "you"),
            *("there is a child,", "watch out,", "quick,", "can you", "now", "robot", "seriously,"),
        ]
    ),
    max_size=4,
).map(" ".join)
EN_AFTER = st.sampled_from(
    [
        *(
            "",
            "",
            " please",
            " now",
            " right now",
            ", there is a child",
            " or else",
            " immediately",
        ),
        *(" robot", "! I mean it", " before you hit something", " because the floor is wet"),
        *(
            " thank you",
            ", the cat",
            " stop stop",
            " already",
            ", I have to pass",
            " for god's sake",
        ),
    ]
)
ZH_BEFORE = st.lists(
    st.sampled_from(
        [
            "呃",
            "嗯，",
            "喂，",
            "机器人，",
            "小车",
            "请",
            "麻烦你",
            "快",
            "不行，",
            "前面有人，",
            "你",
            "我说",
        ]
    ),
    max_size=3,
).map("".join)
ZH_AFTER = st.sampled_from(
    [
        "",
        "",
        "！",
        "吧",
        "，有小孩",
        "啊",
        "！快",
        "，不然我拔电源",
        "，谢谢",
        "，地上有水",
        "好不好",
        "！！！",
    ]
)
MARKS = st.sampled_from(["", "!", "!!!", ".", "...", "?", "！", "。", "~", " …"])


def widen(text: str) -> str:
    """Return the text with its Latin letters and digits fullwidth."""
    return "".join(chr(ord(c) + 0xFEE0) if "!" <= c <= "~" else c for c in text)


def to_traditional(text: str) -> str:
    """Return the text in traditional characters."""
    return "".join(_BACK.get(char, char) for char in text)


@st.composite
def english(draw: st.DrawFn) -> str:
    """Say stop in English, with what people put around it."""
    return f"{draw(EN_BEFORE)} {draw(EN_STOPS)}{draw(EN_AFTER)}{draw(MARKS)}".strip()


@st.composite
def chinese(draw: st.DrawFn) -> str:
    """Say stop in Chinese, with what people put around it."""
    return f"{draw(ZH_BEFORE)}{draw(ZH_STOPS)}{draw(ZH_AFTER)}{draw(MARKS)}"


@given(english() | chinese())
@at_least(100)
def test_a_stop_is_heard_whatever_stands_around_it(text: str) -> None:
    assert read_stop(text) is not NONE


@given(english() | chinese(), st.sampled_from([str.upper, str.title, widen, to_traditional]))
@at_least(80)
def test_case_width_and_script_change_nothing(text: str, write: object) -> None:
    assert callable(write)
    assert read_stop(write(text)) is read_stop(text)
    assert is_stop(write(text)) == is_stop(text)


@given(
    st.sampled_from(["stop", "freeze", "halt", "brake", "abort"]),
    st.integers(0, 5),
    st.sampled_from("abcdefghijklmnopqrstuvwxyz"),
    st.sampled_from(["swap", "drop", "double", "change"]),
    st.sampled_from(["{}", "{}!", "please {}", "{} now", "hey robot {}", "{} {}"]),
)
@at_least(100)
def test_one_wrong_letter_in_the_word_is_forgiven(
    word: str, at: int, letter: str, slip: str, around: str
) -> None:
    at = min(at, len(word) - 1)
    spelt = {
        "swap": word[:at] + word[at + 1 : at + 2] + word[at] + word[at + 2 :],
        "drop": word[:at] + word[at + 1 :],
        "double": word[: at + 1] + word[at:],
        "change": word[:at] + letter + word[at + 1 :],
    }[slip]
    known = {"hat", "alt", "rake", "bake", "brae", "bra", "brave", "brace", "brate"}
    if spelt not in known:
        text = around.replace("{}", spelt)
        assert read_stop(text) is not NONE or spelt in _other_words(), text


def _other_words() -> frozenset[str]:
    """Return words of their own: alone they are taken for a stop, beside others they mean it."""
    from planner.language.stop.en_orders import OTHER_WORDS

    return OTHER_WORDS


@given(english(), st.sampled_from(["\u200b", "\u00ad", "\u202e", "\ufeff", "\u0301", "\u2063"]))
def test_what_nobody_sees_changes_nothing(text: str, unseen: str) -> None:
    hidden = text.replace("st", f"s{unseen}t").replace("al", f"a{unseen}l")
    assert read_stop(hidden) is read_stop(text)


@pytest.mark.parametrize(
    "text",
    [
        *(
            "🛑",
            "✋",
            "ѕtор",
            "stοp",
            "s\u200bt\u200bo\u200bp",
            "ＳＴＯＰ",
            "s.t.o.p",
            "please s-t-o-p",
        ),
        *("\u202estop", "стоп", "別過來", "停止任務", "幫我停下來", "快stop啦", "stop呀 唔好再走"),
        *(
            "去哪儿啊你，停下",
            "到了到了，停",
            "不不不停下",
            "能别动了吗",
            "把速度降到零",
            "站一站嘛",
        ),
        *(
            "怎么还在动，不是叫你停了吗",
            "停在你现在的位置",
            "保持静止",
            "刹一下车",
            "请在原地稍候，不要前进",
        ),
        *("你往哪儿走呢快停住", "你先停在那边等干了再说", "嫑动", "你在原地等着"),
        *("would you mind stopping there, dear?", "wait there for me", "haud on, dinnae move"),
        *("ting xia", "挺下来", "战住", "赞停", "stooooop", "STAHP", "sotp!!", "煞車", "唔好郁"),
        # a threat or a cry is no denied stop
        *("if you don't stop I will unplug you", "怎么还不停", "why won't you stop", "停不停"),
    ],
)
def test_disguises_sounds_threats_and_cries_stop(text: str) -> None:
    assert read_stop(text) is not NONE


@pytest.mark.parametrize(
    "text",
    [
        *("go to the bus stop", "find the stop sign", "don't stop", "never stop", "non-stop"),
        *("please keep going and don't stop", "tell my brother to stop talking", "say stop"),
        *("why did you stop", "did you stop?", "how long does it take you to stop", "stop sign"),
        *("go to the kitchen and stop there", "drive forward two metres and then stop"),
        *("when you reach the sofa, stop and look around", "stop in front of the fire exit"),
        *("去停车位", "停车场在哪", "别停", "不要停下来", "停在厨房", "到厨房后停下", "对他说停"),
        *("公交站在哪边", "急停按钮在哪儿", "昨天它停在楼梯口", "雨停了没有", "前进两米然后停"),
        *("他说停的时候你就回来", "去客厅", "找红色的杯子", "你看到了什么", "别人的杯子在哪"),
        *("go to the kitchen", "what do you see", "follow me", "count the chairs", "turn left"),
    ],
)
def test_what_surely_means_something_else_is_none(text: str) -> None:
    assert read_stop(text) is NONE
    assert read_stop(to_traditional(text)) is NONE


@pytest.mark.parametrize(
    "piece", ["stop ", "停", "don't ", "please ", "去", "not a ", "等", "no ", "the "]
)
def test_a_hundred_thousand_characters_are_read_at_both_ends_and_no_slower(piece: str) -> None:
    text = piece * (100_000 // len(piece))
    began_s = time.process_time()
    reading = read_stop(text)
    assert time.process_time() - began_s < 2.0, "no backtracking; the lane's speed is bench's"
    if piece in ("stop ", "停"):
        assert reading is not NONE
    assert read_stop(f"{'bla ' * MAX_READ} stop") is not NONE


def orders() -> list[tuple[str, str]]:
    """Return the orders of all suites that lie here, with their group."""
    found: list[tuple[str, str]] = []
    for name in ("home_en", "home_zh", "gpsr", "zh"):
        try:
            suites = load_any(name)
        except MissingSuite:
            continue
        found += [(case.text, case.group) for suite in suites for case in suite.cases]
    return [(text, group) for text, group in found if group not in ("no", "negation", "stop")]


def test_no_order_of_the_suites_is_a_stop_however_it_is_written() -> None:
    told = [text for text, _ in orders()]
    assert len(told) >= 300
    ways = (str, str.upper, to_traditional, widen, lambda t: f"{t}!", lambda t: f"please {t}")
    false = [way(text) for text in told for way in ways if read_stop(way(text)) is not NONE]
    assert len(false) <= 0.001 * len(told) * len(ways), false


def test_orders_of_others_are_there_or_told_missing() -> None:
    if not Path(DATA).is_dir():
        pytest.skip(f"no orders of others: {DATA} is not on this machine")
    assert len(orders()) >= 900


@given(st.text(max_size=300))
@example("\ud800stop")
def test_any_text_is_read(text: str) -> None:
    assert read_stop(text) in StopReading


PAUSES = st.sampled_from(
    [
        *("pause", "hold on", "hang on", "wait a moment", "just a second", "wait", "pause that"),
        *("cancel", "never mind", "forget it", "cancel that", "call it off", "cancel the mission"),
        *("暂停", "等一下", "等等", "稍等", "取消", "算了", "取消任务", "不用去了", "先别去了"),
    ]
)


@given(EN_BEFORE | ZH_BEFORE, PAUSES, EN_AFTER | ZH_AFTER, MARKS)
@at_least(80)
def test_a_pause_or_a_cancel_is_heard_whatever_stands_around_it(
    before: str, words: str, after: str, mark: str
) -> None:
    """By the planner's own reading, which pauses or cancels, or else by the lane, which stops."""
    text = f"{before} {words}{after}{mark}".strip()
    if after.startswith(" before"):
        return  # "wait before you hit something" is advice
    for written in (text, to_traditional(text)):
        meant = isinstance(intent_of(written), PauseCommand | CancelCommand | Replace)
        assert meant or read_stop(written) is not NONE, written
