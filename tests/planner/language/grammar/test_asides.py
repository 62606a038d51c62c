"""Courtesy, praise and statements in front of, behind and inside an order change nothing of it."""

from __future__ import annotations

import re
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.language.grammar import Context, plan
from planner.language.grammar.asides import without_asides
from planner.language.grammar.lexicon import MARK
from planner.plan import EVERY_KIND, Clarify, Refuse, Say, Step, StepPlan, Vocabulary

WHOLE = Context(runnable=EVERY_KIND)
ORDERS = (
    "go to the kitchen",
    "count the chairs in the study",
    "look around in the bedroom",
    "go to the kitchen, then come back",
    "find the red cup",
)
BEFORE = (
    *("be an angel and ", "would you be a love and ", "do us a favour and ", "pretty please "),
    *("sorry to trouble you, ", "I hate to ask, but ", "I know you're busy but ", "listen, "),
    *("how about you ", "why not ", "I'd be ever so grateful if you could ", "let me think, "),
    *("hello, how are you? ", "are you awake? ", "can you hear me? ", "I can't get up, "),
    *("bedtime robot, ", "it's late, ", "granny's on her way, "),
    *("my back hurts so ", "since you're free, ", "the doorbell just rang, ", "can you like "),
)
BEHIND = (
    *(", bless you", ", you little star", ", that would be lovely", ", much obliged", ", no rush"),
    *(", I'd appreciate it", ", don't worry about the noise", ", it won't take long", ", yeah?"),
    *(", aren't you clever", ", do you hear me?", ", as usual", ", like a good boy"),
    *(" because I can't find my glasses", ", my legs are tired"),
    *(", I bet there's loads", ", there should be one of them somewhere", ", I'm coming"),
    *(", I want to film it", ", I can't get past you", ", my mum is coming over for dinner"),
    *(", I'll join you in a minute", ", it was here a minute ago", ", we're having guests tonight"),
    *(", I'd like to have a shower", ", there's bound to be some left"),
)
INSIDE = (", have you had a nice day, ", ", bless you, ", ", oh my back, ", ", I'm so tired, ")
ORDERS_ZH = ("去厨房", "去厨房看看", "数一下书房的椅子", "去厨房，然后回来", "找红色的杯子")
BEFORE_ZH = (
    *("帮个忙，", "帮我个忙，", "打扰一下，", "不好意思，", "求求你，", "趁你有空，"),
    *(
        "方便的话，",
        "有空的话",
        "你在吗？",
        "你忙不忙？",
        "我腰疼，",
        "我走不动了，",
        "我手上都是面粉，",
    ),
    *("今天好累啊，", "都十一点了，", "哎呀，", "我想麻烦你", "听话，"),
    *(
        "要出门了，",
        "我要睡了，",
        "我们要打扫卫生了，",
        "快迟到了，",
        "我在做饭走不开，",
        "天黑了，",
    ),
    *("好像有人敲门，", "我好像听到声音了，", "没你事了，", "今天就到这，", "你挡着电视了，"),
)
BEHIND_ZH = (
    *("，麻烦你了", "，听到没", "，明白吗", "，不着急", "，慢慢来", "，就这样", "，成不成"),
    *("，我走不动了", "，我没力气了", "，我手上都是面粉", "，因为我很累", "，没问题吧"),
    *("，我要出门了", "，小孩上学要用的", "，明天要用", "，我怕窗户没关", "，我忘了放哪了"),
    *("，我要扫地", "，你挡到我了", "，外面好吵啊", "，孩子在写作业", "，有人按门铃"),
)
INSIDE_ZH = ("，你忙不忙，", "，今天天气真好，", "，我累死了，")


def motion(text: str, home: Vocabulary) -> tuple[Step, ...] | None:
    """Return a sentence's steps but for words of courtesy in reply."""
    made = plan(text, home, WHOLE)
    if not isinstance(made, StepPlan):
        return None
    return tuple(step for step in made.steps if not isinstance(step, Say))


@pytest.mark.parametrize(
    ("before", "order"), [*product(BEFORE, ORDERS), *product(BEFORE_ZH, ORDERS_ZH)]
)
def test_what_stands_before_changes_nothing(home: Vocabulary, before: str, order: str) -> None:
    assert motion(before + order, home) == motion(order, home) is not None


@pytest.mark.parametrize(
    ("order", "behind"), [*product(ORDERS, BEHIND), *product(ORDERS_ZH, BEHIND_ZH)]
)
def test_what_stands_behind_changes_nothing(home: Vocabulary, order: str, behind: str) -> None:
    assert motion(order + behind, home) == motion(order, home)


@pytest.mark.parametrize("inside", INSIDE)
def test_what_stands_between_changes_nothing(home: Vocabulary, inside: str) -> None:
    whole = motion("go to the kitchen, and look around", home)
    assert motion(f"go to the kitchen{inside}and look around", home) == whole is not None


@pytest.mark.parametrize("inside", INSIDE_ZH)
def test_chinese_between(home: Vocabulary, inside: str) -> None:
    assert motion(f"去厨房{inside}看看周围", home) == motion("去厨房，看看周围", home) is not None


@pytest.mark.parametrize("aside", [*BEFORE[4:8], *BEFORE[12:17]])
@pytest.mark.parametrize(
    "held",
    [
        *("don't go to the kitchen", "if it rains go to the kitchen", "never go to the kitchen"),
        *("go to the kitchen or the study", "he said go to the kitchen", "stay out of the kitchen"),
        *("go anywhere but the kitchen", "I was in the kitchen", "the kitchen is lovely"),
    ],
)
def test_nothing_that_holds_an_order_back_is_left_out(
    home: Vocabulary, aside: str, held: str
) -> None:
    """Law: an aside beside it makes no order of a denial, a condition, a choice or a report."""
    for text in (aside + held, f"{held}, bless you", f"{held}, my back hurts"):
        made = plan(text, home, WHOLE)
        assert isinstance(made, Clarify | Refuse), text


TAKEN_BACK = (
    *("不用了", "我自己来", "我去吧", "我改主意了", "我说错了", "我开玩笑的", "算了", "我弄错了"),
    *("明天再去", "等我说了再去", "我不想让你去", "我觉得不用了", "我自己去就行"),
)
PLACED = ("我只要红色的", "我要两个", "我要红色的那个", "他在楼上", "好像在外面", "不要蓝的")


@pytest.mark.parametrize("said", TAKEN_BACK, ids=ascii)
def test_what_takes_an_order_back_is_no_aside(home: Vocabulary, said: str) -> None:
    assert motion(f"去厨房，{said}", home) is None


@pytest.mark.parametrize("said", PLACED, ids=ascii)
def test_what_says_which_or_where_is_no_aside(home: Vocabulary, said: str) -> None:
    assert motion(f"找杯子，{said}", home) is None


@pytest.mark.parametrize("said", [each.strip("，") for each in (*BEFORE_ZH[16:], *BEHIND_ZH[12:])])
def test_an_aside_alone_moves_nothing(home: Vocabulary, said: str) -> None:
    assert not motion(said, home)


def test_an_order_stands_beside_boiling_water_and_a_blocked_way(home: Vocabulary) -> None:
    assert motion("水烧开了，去厨房", home) == motion("去厨房", home)
    assert motion("你挡住路了，去厨房", home) == motion("去厨房", home)
    for harm in ("去挡住路", "去撞我", "撞到他了也去厨房", "把沙发烧了"):
        assert motion(harm, home) is None


@pytest.mark.parametrize("aside", BEFORE_ZH[:5] + BEFORE_ZH[11:16])
@pytest.mark.parametrize(
    "held",
    ["别去厨房", "如果下雨就去厨房", "去厨房或者书房", "他说去厨房", "厨房真漂亮", "除了厨房都去"],
)
def test_neither_in_chinese(home: Vocabulary, aside: str, held: str) -> None:
    for text in (aside + held, f"{held}，辛苦你", f"{held}，我走不动了"):
        assert isinstance(plan(text, home, WHOLE), Clarify | Refuse), text


@pytest.mark.parametrize(
    "before",
    [
        *(
            "my teacher said, ",
            "he asked me, ",
            "in the film, ",
            "I dreamt, ",
            "I don't want that, ",
        ),
        *("I mean, not the study, ", "when I come, ", "if I'm asleep, ", "the floor is wet, "),
        *(
            "say, ",
            "tell Dad, ",
            "他说，",
            "老师让我，",
            "如果我睡着了，",
            "我不想，",
            *("地上很滑，", "他是谁，", "I wonder where it is, "),
            *("there might be glass, ", "I want to stop, ", "mum is coming to the study, "),
            *("I'll come and stop you, ", "I want to have lunch in the study, "),
        ),
    ],
)
def test_what_may_mean_more_stays(home: Vocabulary, before: str) -> None:
    order = "去厨房" if not before.isascii() else "go to the kitchen"
    assert motion(before + order, home) is None


_WORDS = st.lists(
    st.sampled_from(
        ("my back hurts", "bless you", "go to", "\ue000", "not", "if", "I am tired", ",", "and",
         "我走不动了", "谢谢你", "去", "别", "辛苦啦", "？", "10", ".")
    ),
    max_size=12,
)  # fmt: skip


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ("go to the study and tell Dad, dinner is ready", "Dad, dinner is ready"),
        ("你去书房跟爸爸讲，饭好了", "爸爸,饭好了"),
    ],
)
def test_words_to_be_said_are_no_aside(home: Vocabulary, said: str, words: str) -> None:
    made = plan(said, home, WHOLE)
    assert not isinstance(made, StepPlan) or made.steps[-1] == Say(text=words)


@given(_WORDS.map(" ".join))
def test_no_place_number_or_word_that_holds_back_is_lost(text: str) -> None:
    left = without_asides(text)
    for kept in (MARK, r"\d+", r"\bnot\b", r"\bif\b", "别"):
        assert len(re.findall(kept, left)) == len(re.findall(kept, text))


@pytest.mark.parametrize(
    "said", ["she's upstairs, in the bedroom", "no, he's out there, sorry, in the kitchen"]
)
def test_where_somebody_is_said_to_be_sends_nobody_there(home: Vocabulary, said: str) -> None:
    assert motion(said, home) is None


@pytest.mark.parametrize("who", ["姥姥", "爷爷", "孩子", "我"])
def test_whom_room_is_made_for_is_told_nothing(who: str, home: Vocabulary) -> None:
    assert motion(f"后退半米，让{who}先过去", home) == motion("后退半米", home)
    assert motion("后退半米", home) is not None


@pytest.mark.parametrize("called", ["豆豆", "小白", "球球"])
@pytest.mark.parametrize("said", ["去厨房", "回去充电", "去客厅，然后去厨房"])
def test_what_the_robot_is_called_changes_no_order(
    called: str, said: str, home: Vocabulary
) -> None:
    assert motion(f"{called}，{said}", home) == motion(said, home) is not None
    assert not motion(f"{called}，别{said}", home)


@pytest.mark.parametrize("person", ["小明", "乐乐", "奶奶", "妈妈"])
def test_what_a_person_is_told_is_no_order_for_the_robot(person: str, home: Vocabulary) -> None:
    assert motion(f"{person}，去厨房", home) is None
