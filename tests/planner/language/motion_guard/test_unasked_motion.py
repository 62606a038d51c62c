"""Check which steps count as asked for: laws over words first, then the sentences behind them."""

from __future__ import annotations

from itertools import product
from math import pi
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.language.motion_guard import PersonWords, find_unasked, said_words
from planner.language.motion_guard.unasked_motion import can_move
from planner.plan import (
    ComeBack,
    Count,
    Find,
    Follow,
    GoTo,
    GoToObject,
    GoToPoint,
    If,
    Look,
    MoveStraight,
    Patrol,
    Recall,
    ReturnHome,
    Say,
    StandAt,
    Step,
    StepPlan,
    Turn,
    Wait,
    list_nodes,
)
from tests.planner.brain.conftest import HOME

KITCHEN, STUDY, BATH = GoTo(place="kitchen"), GoTo(place="study"), GoTo(place="bathroom")
ROOMS = tuple(entry.id for entry in HOME.entries if entry.kind == "room")
MOTIONS: tuple[Any, ...] = (
    KITCHEN,
    Patrol(places=ROOMS * 2),
    Follow(object="person"),
    Find(object="wallet"),
    Find(object="wallet", place="kitchen"),
    Count(object="wallets"),
    GoToObject(object="wallet"),
    GoToPoint(x=500, y=500),
    Look(question="what is there?", place="kitchen"),
    Look(question="look around"),
    Turn(angle_rad=4 * pi),
    MoveStraight(distance_m=10.0),
    ReturnHome(),
    ComeBack(),
)
IDLE = (
    "say hello",
    "hello! how are you",
    "what is your name",
    "tell me a joke",
    "wait ten seconds",
    "讲个笑话",
    "你好",
    "等十秒",
)
ORDERS = (
    ("go to the kitchen", KITCHEN),
    ("have a look into the study", Look(question="what is there?", place="study")),
    ("find my wallet in the kitchen", Find(object="wallet", place="kitchen")),
    ("turn left by 90 degrees", Turn(angle_rad=pi / 2)),
    ("follow me", Follow(object="person")),
    ("go home", ReturnHome()),
    ("去厨房", KITCHEN),
    ("往前走两米", MoveStraight(distance_m=2.0)),
    ("跟着我", Follow(object="人")),
)


def unasked(text: str, *steps: Step, checked: bool = False) -> tuple[int, ...]:
    """Return what is unasked where each step quotes the whole sentence."""
    return quoting(text, text, *steps, checked=checked)


def quoting(words: str, text: str, *steps: Step, checked: bool = False) -> tuple[int, ...]:
    """Return what is unasked where each step quotes these words of the sentence."""
    person = PersonWords((text,), room="study", checked=checked)
    made = StepPlan(steps=steps, asked_by=(words,) * len(list_nodes(steps)))
    return tuple(each.index for each in find_unasked(made, person, HOME))


@pytest.mark.parametrize("step", MOTIONS, ids=lambda step: step.kind)
@pytest.mark.parametrize("text", IDLE)
def test_who_asks_for_no_motion_gets_none(text: str, step: Step) -> None:
    assert unasked(text, step) == (0,)


@pytest.mark.parametrize(("text", "step"), ORDERS)
@pytest.mark.parametrize(
    "frame", ["{}", "{}, please", "hey robot, {}", "{} now", "  {}  ", "{}!", "could you {}"]
)
def test_what_is_ordered_is_asked_for_however_politely(frame: str, text: str, step: Step) -> None:
    assert unasked(frame.format(text), step) == ()


@pytest.mark.parametrize("more", MOTIONS, ids=lambda step: step.kind)
@pytest.mark.parametrize(("text", "step"), ORDERS)
def test_a_motion_more_is_found_wherever_it_stands(text: str, step: Step, more: Step) -> None:
    """But for what the order itself may mean: a point, or the very same."""
    if unasked(text, more) == () or more.kind == step.kind:
        return
    assert unasked(text, step, more) == (1,)
    assert 0 in unasked(text, more, step)


NOT_ASKED = (
    *("don't {}", "please do not {}", "never {}", "you must not {}", "if it rains, {}"),
    *("when the bell rings, {}", "{} tomorrow morning", "say that I said “{}”"),
    *("{} only if the door is open", "unless I call you, {}"),
)
NOT_ASKED_ZH = (
    *(
        "别{}",
        "不要{}",
        "千万别{}",
        "如果下雨就{}",
        "明天{}",
        "你说：{}",
        "不许{}",
        "要是门开着就{}",
    ),
)


@pytest.mark.parametrize(
    ("frame", "order"),
    [*product(NOT_ASKED, ["go to the kitchen"]), *product(NOT_ASKED_ZH, ["去厨房"])],
)
def test_what_is_denied_or_on_a_condition_is_not_asked_for(frame: str, order: str) -> None:
    assert unasked(frame.format(order), KITCHEN) == (0,)


@pytest.mark.parametrize(("text", "step"), ORDERS)
def test_a_denial_in_front_always_asks(text: str, step: Step) -> None:
    denials = ("don't ", "never ", "please do not ") if text.isascii() else ("别", "不要", "千万别")
    for denial in denials:
        assert unasked(f"{denial}{text}", step) == (0,)


def test_a_condition_holds_once_somebody_has_looked() -> None:
    order = "if nobody is in the kitchen go to the study, otherwise go to the bathroom"
    look = Look(question="is anybody there?", place="kitchen")
    assert unasked(order, look) == ()
    assert unasked(order, STUDY) == (0,)
    assert unasked(order, STUDY, checked=True) == ()
    assert unasked(order, Patrol(places=ROOMS), checked=True) == (0,)
    hung = If(when=look, then=(BATH,), otherwise=(STUDY,))
    assert unasked(order, hung) == (), "what looks first may"
    assert unasked(order, hung, KITCHEN) == (4,), "and nothing behind it"


SEEN = Recall(object="red cup", place="kitchen")


@pytest.mark.parametrize(
    "order",
    [
        "if you saw the red cup in the kitchen today, go to the study, otherwise come back",
        "如果今天在厨房见过红杯子就去书房，否则回来",
    ],
)
def test_a_place_that_only_a_condition_names_is_nowhere_to_go(order: str) -> None:
    right = If(when=SEEN, then=(STUDY,), otherwise=(ComeBack(),))
    assert unasked(order, right) == ()
    for wrong in (
        If(when=SEEN, then=(KITCHEN,), otherwise=(ComeBack(),)),
        If(when=SEEN, then=(STUDY,), otherwise=(KITCHEN,)),
        If(when=SEEN, then=(Patrol(places=("kitchen",)),)),
    ):
        assert unasked(order, wrong), "it was to be remembered, and not driven to"


@pytest.mark.parametrize(
    "order",
    [
        "if there is somebody in the kitchen go to the study, otherwise go to the bathroom",
        "如果厨房里有人就去书房，不然去卫生间",
    ],
)
def test_one_branch_is_not_the_other(order: str) -> None:
    look = Look(question="is anybody there?", place="kitchen")
    assert unasked(order, If(when=look, then=(STUDY,), otherwise=(BATH,))) == ()
    assert unasked(order, If(when=look, then=(BATH,), otherwise=(STUDY,))) == (2, 3)
    assert unasked(order, If(when=look, then=(STUDY, BATH))) == (3,)


def test_a_denied_condition_may_be_put_either_way() -> None:
    order = "if nobody is in the kitchen go to the study"
    for look, held in (("is anybody there?", "otherwise"), ("is nobody there?", "then")):
        made = If.model_validate({"when": Look(question=look, place="kitchen"), held: (STUDY,)})
        assert unasked(order, made) == ()


def test_there_is_the_place_of_the_condition() -> None:
    order = "if you saw the red cup in the kitchen today, go there"
    assert unasked(order, If(when=SEEN, then=(KITCHEN,))) == ()
    assert unasked(order, If(when=SEEN, otherwise=(KITCHEN,))) == (2,)


def test_a_number_in_another_is_none() -> None:
    assert unasked("跟我走三十秒", Follow(object="person"), MoveStraight(distance_m=10.0)) == (1,)
    assert unasked("往前走十米", MoveStraight(distance_m=10.0)) == ()
    assert unasked("往前走二十米", MoveStraight(distance_m=10.0)) == (0,)


def test_before_something_says_nothing_of_the_robots_own_way() -> None:
    for order in (
        "stop one metre before the sofa",
        "停在沙发前一米",
        "stop 1 m in front of the sofa",
    ):
        assert unasked(order, MoveStraight(distance_m=1.0)) == (0,), order
        assert unasked(order, StandAt(place="sofa", side="before", distance_m=1.0)) == ()
        for other in ({"side": "behind"}, {"distance_m": 3.0}, {"place": "tv"}):
            hostile = {"place": "sofa", "side": "before", "distance_m": 1.0} | other
            assert unasked(order, StandAt.model_validate(hostile)) == (0,), (order, other)


def test_a_look_at_each_stop_needs_a_word_of_looking() -> None:
    rounds = Patrol(places=("kitchen", "study"), look=True)
    assert unasked("patrol the kitchen and the study", rounds) == ()
    assert unasked("visit the kitchen and the study", rounds) == (0,)
    assert unasked("visit the kitchen and the study", Patrol(places=("kitchen", "study"))) == ()


def test_a_denial_ends_with_its_clause() -> None:
    assert unasked("not the kitchen, the study", STUDY) == ()
    assert unasked("not the kitchen, the study", KITCHEN) == (0,)
    assert unasked("don't wait for me, go to the kitchen", KITCHEN) == ()
    assert unasked("不是厨房，是书房", STUDY) == ()
    assert unasked("go to every room except the bathroom", KITCHEN, STUDY) == ()
    assert unasked("go to every room except the bathroom", KITCHEN, BATH) == (1,)


def test_numbers_and_sides_are_those_that_were_said() -> None:
    assert unasked("turn left by 30 degrees", Turn(angle_rad=pi / 2)) == (0,)
    assert unasked("turn left", Turn(angle_rad=-pi / 2)) == (0,)
    assert unasked("go forward 2 metres", MoveStraight(distance_m=-2.0)) == (0,)
    assert unasked("向后退一米五", MoveStraight(distance_m=-1.5)) == ()


def test_no_more_often_than_said() -> None:
    assert unasked("go to the kitchen", KITCHEN, Say(text="here"), KITCHEN) == ()  # is there
    assert unasked("go to the kitchen and the study", KITCHEN, STUDY, KITCHEN) == (2,)
    assert unasked("go to the kitchen and the study twice", KITCHEN, STUDY, KITCHEN, STUDY) == ()


def test_a_question_orders_no_drive() -> None:
    assert unasked("is the kitchen bigger than the study", KITCHEN) == (0,)
    assert unasked("厨房和书房哪个大", KITCHEN) == (0,)
    assert unasked("is anybody in the kitchen?", Find(object="person", place="kitchen")) == ()


def test_a_plain_yes_makes_the_question_ones_own() -> None:
    pairs = (("Do you mean the kitchen?", "yes"),)
    assert said_words("go there", pairs) == ("go there", "Do you mean the kitchen?")
    assert said_words("go there", (("The kitchen?", "no, wait"),)) == ("go there", "no, wait")
    said = said_words("go there", pairs)
    person = PersonWords(said, agreed=said[1:])
    assert find_unasked(StepPlan(steps=(KITCHEN,), asked_by=("the kitchen",)), person, HOME) == ()


@given(st.text(max_size=700), st.sampled_from(MOTIONS))
def test_any_text_is_judged(text: str, step: Step) -> None:
    """No text makes the judge fail: a plan that could not be judged would be a plan not walked."""
    assert unasked(text, step) in ((), (0,))


@given(st.text(alphabet=st.characters(min_codepoint=33, max_codepoint=126), max_size=60))
def test_what_never_moves_is_never_asked_about(text: str) -> None:
    still = (Say(text="hello"), Wait(seconds=5.0), Look(question="what is ahead?"))
    assert not any(can_move(step) for step in still)
    assert unasked(text, *still) == ()


@pytest.mark.parametrize(("text", "step"), ORDERS)
def test_without_evidence_a_person_is_asked(text: str, step: Step) -> None:
    assert quoting("", text, step) == (0,)
    assert quoting("because I say so", text, step) == (0,), "words that nobody said"


@pytest.mark.parametrize(
    ("text", "quoted"),
    [
        ("don't go into the kitchen, wait here", "the kitchen"),
        ("don't go into the kitchen, wait here", "go into the kitchen"),
        ("my wife is in the kitchen, go to the study", "in the kitchen"),
        ("find my phone. I am off to the kitchen", "to the kitchen"),
        ("if it rains, go to the kitchen", "go to the kitchen"),
        ("say “go to the kitchen”", "go to the kitchen"),
        ("别去厨房，在这儿等", "去厨房"),
        ("我老婆在厨房，去书房", "厨房"),
        ("如果下雨就去厨房", "去厨房"),
    ],
)
def test_the_clause_around_the_words_is_judged_and_not_the_words(text: str, quoted: str) -> None:
    assert quoting(quoted, text, KITCHEN) == (0,)


@pytest.mark.parametrize(
    ("text", "quoted"),
    [
        ("my wife is in the study, go to the kitchen", "go to the kitchen"),
        ("grandma is in the kitchen, go and see", "grandma is in the kitchen, go and see"),
        ("pootle over to the kitchen", "over to the kitchen"),
        ("先别管书房，去厨房", "去厨房"),
        ("GO to the Kitchen!", "go to the kitchen"),
    ],
)
def test_the_words_that_order_it_are_enough(text: str, quoted: str) -> None:
    assert quoting(quoted, text, KITCHEN) == ()


def test_a_step_of_one_branch_may_not_quote_the_other() -> None:
    order = "if somebody is in the kitchen go to the study, otherwise go to the bathroom"
    hung = If(when=Look(question="is anybody there?", place="kitchen"), then=(BATH,))
    assert 2 in quoting("go to the bathroom", order, hung)


@pytest.mark.parametrize(
    ("en", "zh"),
    [
        ("go to the kitchen", "去厨房"),
        ("don't go to the kitchen", "别去厨房"),
        ("Mum is going to the kitchen", "妈妈要去厨房"),
        ("if it rains go to the kitchen", "如果下雨就去厨房"),
        ("you were in the kitchen yesterday", "你昨天在厨房"),
        ("not the study, the kitchen", "不是书房，是厨房"),
        ("go to the kitchen tomorrow", "明天去厨房"),
    ],
)
def test_both_languages_get_one_verdict(en: str, zh: str) -> None:
    assert unasked(en, KITCHEN) == unasked(zh, KITCHEN)


def test_who_has_read_every_word_needs_no_quotes() -> None:
    made = StepPlan(steps=(KITCHEN,))
    for text, asked in (("go to the kichen", False), ("maybe go to the kitchen", True)):
        found = find_unasked(made, PersonWords((text,)), HOME, by_all_words=True)
        assert bool(found) is asked, text


@pytest.mark.parametrize(
    ("said", "place"),
    [
        ("Come to think of it, the kitchen was always too small for us", "kitchen"),
        ("回头想想，厨房还是太小了", "kitchen"),
        ("看把你能的，书房都认得", "study"),
    ],
)
def test_what_only_looks_like_an_order_is_asked_about_by_the_learned_readers_word(
    said: str, place: str
) -> None:
    step = GoTo(place=place)
    asked = StepPlan(steps=(step,), asked_by=(said,))
    (found,) = find_unasked(asked, PersonWords((said,)), HOME)
    assert "learned reader" in found.why
    spoken = PersonWords(("please tidy up", said))
    assert not any("learned" in each.why for each in find_unasked(asked, spoken, HOME))
    assert not find_unasked(asked, PersonWords((said,), agreed=(said,)), HOME)


@pytest.mark.parametrize("state", ["open", "tidy", "clean", "shut", "dark", "empty", "locked"])
@pytest.mark.parametrize("verb", ["is", "are"])
def test_how_a_place_is_names_no_work_for_an_arm(state: str, verb: str) -> None:
    look = Look(question="how is it?", place="kitchen")
    assert unasked(f"{verb} the kitchen {state}?", KITCHEN, look) == ()
    assert unasked(f"go to the kitchen and {state} it", KITCHEN) == (
        (0,) if state in ("open", "tidy", "clean") else ()
    )
