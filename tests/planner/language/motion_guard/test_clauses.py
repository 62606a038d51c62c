"""Hold how a sentence falls into clauses, and what each of them does."""

from __future__ import annotations

import sys
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.language.motion_guard.clause_moods import ClauseMood
from planner.language.motion_guard.clauses import denied_places, read_clauses
from planner.language.motion_guard.mentioned_names import plain
from tests.planner.brain.conftest import HOME

ORDER, DENIED, FACT, UPON = (
    ClauseMood.ORDER,
    ClauseMood.DENIED,
    ClauseMood.FACT,
    ClauseMood.CONDITION,
)


def moods(text: str) -> list[ClauseMood]:
    return [each.mood for each in read_clauses(text, HOME) if each.mood is not ClauseMood.NOTHING]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("go to the kitchen", [ORDER]),
        ("don't go to the kitchen, go to the study", [DENIED, ORDER]),
        ("don't go to the kitchen and look around", [DENIED, DENIED]),
        ("go to every room except the study", [ORDER, DENIED]),
        ("go to the kitchen, no, I meant the bedroom", [DENIED, ClauseMood.DENIED, ORDER]),
        ("if nobody is in the kitchen go to the study", [UPON, ORDER]),
        ("wait in the hallway", [ORDER]),
        ("settle down in the study", [ORDER]),
        ("if you can't, wait in the hallway instead", [UPON, ORDER]),
        ("hold on, go on to the study", [ORDER]),
        ("grandma is in the bedroom, go and see", [FACT, ORDER, ORDER]),
        ("别去厨房，去书房", [DENIED, ORDER]),
        ("去厨房，不对，我是说卧室", [DENIED, DENIED, ORDER]),
        ("有人来了就去书房", [UPON, ORDER]),
        ("去完书房就回家", [ORDER, ORDER]),
        ("奶奶在卧室，去看看", [FACT, ORDER]),
    ],
)
def test_each_clause_does_one_thing(text: str, expected: list[ClauseMood]) -> None:
    assert moods(text) == expected


@pytest.mark.parametrize(
    "text",
    [
        "if the door is open, go to the study",
        "go to the study if the door is open",
        "go to the study tomorrow",
        "wait until the bell rings, then go to the study",
        "如果门开着就去书房",
        "等洗衣机洗完了再去书房",
    ],
)
def test_what_is_not_for_now_hangs(text: str) -> None:
    orders = [each for each in read_clauses(text, HOME) if each.mood is ORDER]
    assert orders[-1].hung


@pytest.mark.parametrize(
    "text",
    ["see if the door is open", "when you are done go to the study", "去看看门开着没有"],
)
def test_what_only_asks_or_follows_does_not(text: str) -> None:
    assert not any(each.hung for each in read_clauses(text, HOME))


@pytest.mark.parametrize(
    "text",
    ["say: go to the kitchen", "shout “go to the kitchen”", "你说：去厨房", "喊“去厨房”"],
)
def test_what_is_said_to_somebody_is_no_order(text: str) -> None:
    orders = [each for each in read_clauses(text, HOME) if each.mood is ORDER]
    assert all("kitchen" not in each.text and "厨房" not in each.text for each in orders)


@given(st.text(max_size=500))
def test_any_text_is_read_and_every_clause_stands_in_it(text: str) -> None:
    said, at = plain(text), 0
    for each in read_clauses(text, HOME):
        assert at <= each.start < each.end <= len(said)
        at = each.end


@pytest.mark.parametrize(
    ("text", "denied"),
    [
        ("mum is in the bathroom, don't go there", {"bathroom"}),
        ("妈妈在卫生间，别进去", {"bathroom"}),
        ("go to the study, not the kitchen", {"kitchen"}),
        ("the kitchen, no, don't go in there", {"kitchen"}),
        ("look at me... and the kitchen, no, stay out of there", {"kitchen"}),
        ("厨房，别进去，回来", {"kitchen"}),
        ("mum is in the bathroom. go to the study, don't wait there", set()),
        ("go to the study but touch nothing there", set()),
        ("I can't point, but go to the study", set()),
    ],
)
def test_a_denial_may_lean_on_the_place_named_last(text: str, denied: set[str]) -> None:
    assert denied_places(text, HOME) == denied


@pytest.mark.parametrize(
    "unit", ["‘，", "灶间 ", "0，é，", "kitchen, ", "不要去厨房，", "tell him ", "no, the study, "]
)
def test_four_times_as_many_clauses_cost_at_most_five_times_the_calls(unit: str) -> None:
    few = 360 // len(unit) // 4
    short = calls_within(lambda: read_clauses(unit * few, HOME))
    long = calls_within(lambda: read_clauses(unit * (4 * few), HOME))
    assert long <= 5 * short, "linear; quadratic would be sixteen times"


def calls_within(work: Callable[[], object]) -> int:
    """Return how many calls a piece of work makes, generators and built-in functions among them."""
    count = 0

    def hear(_frame: object, event: str, _arg: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(hear)
    try:
        work()
    finally:
        sys.setprofile(before)
    return count
