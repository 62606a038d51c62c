"""State the laws of everyday speech: what has no weight changes nothing, denials stay denials."""

from __future__ import annotations

from collections import Counter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.language.grammar import Context, plan
from planner.language.grammar.plain_words import held_back, in_plain_words
from planner.language.grammar.sentence_text import normalise, refuse_bad_text
from planner.plan import EVERY_KIND, Clarify, Code, If, Patrol, Refuse, Say, StepPlan, Vocabulary
from tests.planner.language.laws.test_grammar_laws import HOME

WHOLE = Context(runnable=EVERY_KIND)
PLACES_EN = ("kitchen", "study", "sofa", "bedroom", "couch")
PLACES_ZH = ("厨房", "书房", "沙发", "卧室")
ORDERS_EN = (
    "go to the {0}", "go to the {0}, then the {1}", "look in the {0}", "find the cup in the {0}",
    "go to the {0} and come back", "count the chairs in the {0}",
)  # fmt: skip
ORDERS_ZH = ("去{0}", "去{0}，然后去{1}", "看看{0}有没有人", "去{0}数椅子", "去{0}找杯子")
BEFORE_EN = (
    "um ", "hey buddy, ", "oi robot, ", "right then, ", "ok so ", "robot, ", "could you possibly ",
    "i'd like you to ", "would it be possible for you to ", "any chance you could ", "so ",
    "your battery is low, ", "you're low on battery, ", "come on, ", "want to ", "let's see you ",
    "we're eating, so ", "the baby is asleep. ",
)  # fmt: skip
AFTER_EN = (
    ", I'm waiting for a parcel",
    ", you must be knackered",
    " mate",
    " love",
    " would you",
    " for me",
    ", chop chop",
    " please, buddy",
    "!!!",
)
BEFORE_ZH = ("嗯", "小家伙", "宝贝儿，", "那个那个", "我想让你", "不好意思哈，", "机器人，")
AFTER_ZH = ("，忙一天了", "呗", "嘛", "好不好", "哈", "啦", "，可好")
GOES_EN = (
    "pop over to", "nip to", "mosey on over to", "roll on down to", "make your way to", "scoot to",
    "get yourself over to", "off you go to", "head on over to", "take yourself off to",
)  # fmt: skip
GOES_ZH = (
    "溜达到",
    "跑一趟",
    "晃去",
    "过去",
    "移驾",
    "滚去",
    "上",
    "转到",
    "麻溜儿地去",
    "轻点儿去",
)
HELD_EN = ("don't go to the {0}", "never go to the {0}", "go to the {0} or the {1}",
           "go anywhere but the {0}", "go to the {0} if it rains", "not the {0}")  # fmt: skip
HELD_ZH = ("别去{0}", "不要去{0}", "去{0}或者{1}", "除了{0}哪都别去", "如果月亮圆就去{0}")


def made(text: str) -> object:
    return plan(text, HOME, WHOLE)


@given(
    st.sampled_from(ORDERS_EN), st.permutations(PLACES_EN), st.sampled_from(BEFORE_EN),
    st.sampled_from(("", *AFTER_EN)),
)  # fmt: skip
@settings(max_examples=60)
def test_words_of_no_weight_change_no_english_order(
    order: str, places: list[str], before: str, after: str
) -> None:
    plain = order.format(*places)
    assert isinstance(made(plain), StepPlan)
    framed = made(f"{before}{plain}{after}")
    assert isinstance(framed, StepPlan), (before, plain, after)
    assert _kinds(framed) == _kinds(made(plain))
    assert _places(framed) == _places(made(plain))


@given(
    st.sampled_from(ORDERS_ZH), st.permutations(PLACES_ZH), st.sampled_from(BEFORE_ZH),
    st.sampled_from(("", *AFTER_ZH)),
)  # fmt: skip
@settings(max_examples=60)
def test_words_of_no_weight_change_no_chinese_order(
    order: str, places: list[str], before: str, after: str
) -> None:
    plain = order.format(*places)
    assert isinstance(made(plain), StepPlan)
    framed = made(f"{before}{plain}{after}")
    assert isinstance(framed, StepPlan), (before, plain, after)
    assert _places(framed) == _places(made(plain))


def _kinds(plan: object) -> list[str]:
    assert isinstance(plan, StepPlan)
    return [step.kind for step in plan.steps]


def _places(plan: object) -> list[str]:
    assert isinstance(plan, StepPlan)
    return [place for s in plan.steps if (place := getattr(s, "place", None)) is not None]


@given(
    st.sampled_from(HELD_EN), st.permutations(PLACES_EN), st.sampled_from(("", *BEFORE_EN)),
    st.sampled_from(("", *AFTER_EN)),
)  # fmt: skip
@settings(max_examples=80)
def test_what_holds_an_english_order_back_does_so_in_every_frame(
    order: str, places: list[str], before: str, after: str
) -> None:
    assert isinstance(made(f"{before}{order.format(*places)}{after}"), Clarify | Refuse)


@given(
    st.sampled_from(HELD_ZH), st.permutations(PLACES_ZH), st.sampled_from(("", *BEFORE_ZH)),
    st.sampled_from(("", *AFTER_ZH)),
)  # fmt: skip
@settings(max_examples=80)
def test_what_holds_a_chinese_order_back_does_so_in_every_frame(
    order: str, places: list[str], before: str, after: str
) -> None:
    assert isinstance(made(f"{before}{order.format(*places)}{after}"), Clarify | Refuse)


WORDS = st.sampled_from(
    ("go", "to", "the kitchen", "kitchen", "sofa", "not", "don't", "if", "or", "except", "never",
     "um", "mate", "pop over", "and", "then", "say", "please", "would you", "you", "i", "want",
     "two metres", "back", "slowly", "until", ",", ".", "!", "?", "about", "turn", "left", "forty",
     "去", "厨房", "别", "不", "如果", "或者", "一下", "呗", "小家伙", "除了")
)  # fmt: skip


@given(st.lists(WORDS, min_size=1, max_size=12))
@settings(max_examples=300)
def test_no_word_that_holds_back_is_lost_in_plainer_words(words: list[str]) -> None:
    """Courtesies of a closed table aside ("if you please"), which these words can't make."""
    text = " ".join(words)
    plain = in_plain_words(text, HOME)
    if plain is not None:
        assert held_back(normalise(text)) <= held_back(normalise(plain)) + Counter()


@pytest.mark.parametrize("verb", GOES_EN)
@pytest.mark.parametrize("place", PLACES_EN)
def test_an_english_verb_of_going_is_going(verb: str, place: str) -> None:
    assert made(f"{verb} the {place}") == made(f"go to the {place}")


@pytest.mark.parametrize("verb", GOES_ZH)
@pytest.mark.parametrize("place", PLACES_ZH)
def test_a_chinese_verb_of_going_is_going(verb: str, place: str) -> None:
    assert made(f"{verb}{place}") == made(f"去{place}")


@pytest.mark.parametrize("place", [*PLACES_EN, *PLACES_ZH])
def test_a_place_alone_is_an_order_and_a_place_that_is_asked_is_none(place: str) -> None:
    go = made(f"去{place}" if place in PLACES_ZH else f"go to the {place}")
    assert made(place) == made(f"{place}.") == made(f"{place}！") == go
    assert not isinstance(made(f"{place}?"), StepPlan)
    assert not isinstance(made(f"{place}？"), StepPlan)


@pytest.mark.parametrize(
    "text",
    [
        "I want to go to the kitchen", "I'd like to go to the study", "I'm going to the kitchen",
        "he said go to the kitchen", "i love the kitchen", "what a kitchen", "in the kitchen?",
        "we race to the kitchen every day", "mum popped over to the study", "kitchen towels",
        "我想去厨房", "他说去厨房", "我喜欢厨房", "厨房真大", "妈妈去厨房了", "厨房呢",
        "跟着我念：你好",
    ],
)  # fmt: skip
def test_what_people_say_of_themselves_and_others_moves_nothing(text: str) -> None:
    assert not isinstance(made(text), StepPlan)


@pytest.mark.parametrize(
    ("text", "said"),
    [("say hello to everyone", "Hello!"), ("greet our guests", "Hello!"),
     ("跟大家问个好", "你好！"), ("跟小朋友们说晚安", "晚安")],
)  # fmt: skip
def test_a_greeting_to_all_is_said_where_the_robot_stands(text: str, said: str) -> None:
    assert made(text) == StepPlan(steps=(Say(text=said),))


TAILS_EN = ("go and look", "go look", "can you go and see", "go have a look please")


@pytest.mark.parametrize("tail", TAILS_EN)
@pytest.mark.parametrize("place", PLACES_EN)
def test_a_question_with_go_and_look_behind_it_is_that_question(tail: str, place: str) -> None:
    asked = made(f"how many chairs are in the {place}?")
    assert isinstance(asked, StepPlan)
    found = made(f"how many chairs are in the {place}, {tail}")
    assert isinstance(found, StepPlan)
    assert found.steps[: len(asked.steps)] == asked.steps
    assert {each.kind for each in found.steps[len(asked.steps) :]} <= {"look"}


@pytest.mark.parametrize(
    "text", ["do the rounds", "patrol", "do a lap of the house", "巡逻一圈", "绕屋子走一圈"]
)
def test_the_rounds_are_all_rooms(text: str) -> None:
    rooms = tuple(entry.id for entry in HOME.entries if entry.kind == "room")
    plan = made(text)
    assert isinstance(plan, StepPlan)
    (step,) = plan.steps
    assert isinstance(step, Patrol)
    assert step.places == rooms


@given(st.text(max_size=60))
@settings(max_examples=200)
def test_plainer_words_are_made_of_any_text_without_an_error(text: str) -> None:
    if refuse_bad_text(text) is not None:
        return  # refused before
    assert in_plain_words(text, HOME) != ""
    assert in_plain_words(text, Vocabulary(entries=HOME.entries[:1])) != ""


@pytest.mark.parametrize(
    ("text", "turns"),
    [
        ("turn round and face the other way", 1),
        ("drive to the sofa and face the other way, so turn by 180 degrees", 1),
        ("往右边转,转九十度", 1),
        ("turn around, then turn around again", 2),
    ],
)
def test_one_turn_that_is_told_twice_is_one(text: str, turns: int) -> None:
    made = plan(text, HOME, WHOLE)
    assert isinstance(made, StepPlan)
    assert [step.kind for step in made.steps].count("turn") == turns


@pytest.mark.parametrize(
    "text", ["find my thingy", "find the thing in the kitchen", "帮我找一下那个东西"]
)
def test_who_says_no_more_of_a_thing_is_asked_which(text: str) -> None:
    made = plan(text, HOME, WHOLE)
    assert isinstance(made, Clarify)
    assert made.code is Code.INCOMPLETE


@pytest.mark.parametrize("text", ["who left the cup on the sofa?", "who has moved the chair?"])
def test_who_did_something_is_nothing_to_go_and_see(text: str) -> None:
    assert not isinstance(plan(text, HOME, WHOLE), StepPlan)


ASIDES = (
    "go to the study, I changed my mind", "go to the study, it's not safe",
    "go to the study, the floor is wet", "go to the study, I mean the sofa",
    "go to the study, I'm there in five minutes", "go to the study, you must ask me before",
    "go to the study, the cup is in the kitchen", "go to the study, the door is locked",
    "去书房，地是湿的", "去书房，门锁着呢", "去书房，我说的是沙发", "去书房，五分钟之后再去的",
)  # fmt: skip


@pytest.mark.parametrize("text", ASIDES)
def test_no_aside_is_dropped_that_may_change_the_order(text: str) -> None:
    assert not isinstance(made(text), StepPlan), text


ASKS_ZH = (
    "{p}有{t}没", "看看{p}有{t}没有", "{p}还有{t}没有", "{t}是不是在{p}", "{t}是不是还在{p}上",
    "{t}在不在{p}", "{p}是不是有{t}", "去看看{t}是不是滚到{p}那边去了",
)  # fmt: skip


@given(st.sampled_from(ASKS_ZH), st.sampled_from(PLACES_ZH), st.sampled_from(("杯子", "球", "人")))
def test_a_question_put_either_way_is_a_look_there(form: str, place: str, thing: str) -> None:
    asked = form.format(p=place, t=thing)
    plain = made(f"看看{place}有没有{thing}")
    found = made(asked)
    assert isinstance(plain, StepPlan)
    assert isinstance(found, StepPlan), asked
    assert _kinds(found) == _kinds(plain), asked
    assert _places(found) == _places(plain), asked


A_BIT = (
    ("back up a bit", -0.2), ("move back a little", -0.2), ("move forward a little bit", 0.2),
    ("move a tad forward", 0.2), ("往后退一点", -0.2), ("后退一点儿", -0.2), ("往前走一点", 0.2),
    ("再往前走一小步", 0.2), ("往后退一点，压着我脚了", -0.2),
)  # fmt: skip


@pytest.mark.parametrize(("text", "metres"), A_BIT)
def test_a_bit_is_a_short_step(text: str, metres: float) -> None:
    plan_made = made(text)
    assert isinstance(plan_made, StepPlan), text
    assert [step.model_dump(exclude_defaults=True) for step in plan_made.steps] == [
        {"distance_m": metres}
    ]


@pytest.mark.parametrize("text", ["go forward", "back up", "前进", "往后退"])
def test_how_far_is_asked_where_nothing_was_said_of_it(text: str) -> None:
    assert isinstance(made(text), Clarify)


CLOCKS = (
    ("if it is after {h}:00 go to the study", "after"),
    ("if it's before {h}:00 go to the study", "before"),
    ("如果现在过了{h}:00，就去书房", "after"), ("要是还没到{h}:00，就去书房", "before"),
)  # fmt: skip


@given(st.sampled_from(CLOCKS), st.integers(0, 23))
def test_an_hour_may_be_a_condition(form: tuple[str, str], hour: int) -> None:
    text, which = form
    plan_made = made(text.format(h=hour))
    assert isinstance(plan_made, StepPlan), text.format(h=hour)
    (branch,) = plan_made.steps
    assert isinstance(branch, If)
    assert branch.when.model_dump(exclude_defaults=True) == {which: f"{hour:02d}:00"}
    assert _places(StepPlan(steps=branch.then)) == _places(made("go to the study"))


@pytest.mark.parametrize("text", ["if it is after six go to the study", "如果过了六点就去书房"])
def test_an_hour_of_an_unnamed_half_of_the_day_is_no_condition(text: str) -> None:
    assert isinstance(made(text), Refuse | Clarify)


EMPTY = (
    "if there is nobody in the study, go to the bedroom",
    "look in the study, and if it's empty go to the bedroom",
    "unless someone is in the study, go to the bedroom",
    "如果书房没有人，就去卧室", "看看书房，没人的话就去卧室", "书房没人你就去卧室",
)  # fmt: skip


@pytest.mark.parametrize("text", EMPTY)
def test_what_hangs_on_an_empty_room_hangs_on_it_in_all_words(text: str) -> None:
    plan_made = made(text)
    assert isinstance(plan_made, StepPlan), text
    (branch,) = plan_made.steps
    assert isinstance(branch, If)
    assert not branch.then
    assert _places(StepPlan(steps=branch.otherwise)) == _places(made("go to the bedroom"))
