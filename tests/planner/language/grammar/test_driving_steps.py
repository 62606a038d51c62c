"""Orders to explore, read while a map is made; spins that are whole circles."""

from __future__ import annotations

from math import degrees

import pytest

from planner.language.grammar import Context, plan
from planner.plan import (
    EVERY_KIND,
    NEEDS_GROWING_MAP,
    RUNNABLE,
    Bilingual,
    Clarify,
    Code,
    Entry,
    Refuse,
    Repeat,
    StepPlan,
    Turn,
    Vocabulary,
)
from tests.planner.language.grammar.conftest import HOME, NOON, in_short

MAKING = RUNNABLE | NEEDS_GROWING_MAP
BEGUN = Vocabulary(
    entries=(Entry(id="home", kind="place", name=Bilingual(en="home", zh="家"), aliases=()),)
)
"""What a map that has just begun knows."""

ROAMING = (
    "explore",
    "explore the house",
    "explore my whole home",
    "please explore the flat by yourself",
    "explore everywhere",
    "go and explore the rest of the house",
)
"""Where the map is whole, these ask for places."""
ALONE = (
    "map the house by yourself",
    "make a map by yourself",
    "draw a map of the flat on your own",
    "探索",
    "探索一下房子",
    "机器人，探索一下房子吧",
    "去探索整个家",
    "自己去建图",
    "自动绘制地图",
)


@pytest.mark.parametrize("text", [*ROAMING, *ALONE, "map the house", "continue exploring"])
def test_while_a_map_is_made_it_is_an_order_to_explore(text: str) -> None:
    assert in_short(text, BEGUN, MAKING) == "explore"


@pytest.mark.parametrize("text", ROAMING)
def test_where_none_is_made_to_explore_means_what_it_did(text: str, home: Vocabulary) -> None:
    wandering = in_short("wander around", home, RUNNABLE)
    assert in_short(text, home, RUNNABLE) in (wandering, "clarify not_understood")
    assert in_short("explore the house", home, RUNNABLE) == wandering == "clarify incomplete"


@pytest.mark.parametrize("text", ALONE)
def test_an_order_that_means_nothing_else_says_how_to_begin(text: str, home: Vocabulary) -> None:
    made = plan(text, home, Context(runnable=RUNNABLE))
    assert isinstance(made, Refuse)
    assert made.code is Code.NOT_MAPPING
    assert "pons up --map" in made.reason.en
    assert "pons up --map" in made.reason.zh


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("explore the house and then go home", "explore return_home"),
        ("探索一下房子，然后回家", "explore return_home"),
        ("explore your feelings", "clarify incomplete"),
        ("wander around", "clarify incomplete"),
        ("don't map the house", "refuse negated"),
        ("stop exploring", "refuse stopped"),
        ("停止探索", "refuse stopped"),
    ],
)
def test_only_these_words_and_all_of_them(text: str, said: str) -> None:
    assert in_short(text, BEGUN, MAKING) == said


def test_a_room_is_explored_by_looking_as_ever(home: Vocabulary) -> None:
    assert in_short("explore the kitchen", home) == "kitchen look=explore the kitchen@kitchen"


def test_the_order_on_a_button_reads_back_as_itself(home: Vocabulary) -> None:
    made = plan("explore the house, then pick up the cup", home, Context(runnable=MAKING))
    assert isinstance(made, Clarify)
    for option in made.options:
        for text in (option.label.en, option.label.zh):
            again = plan(text, home, Context(runnable=MAKING))
            assert isinstance(again, StepPlan), text
            assert again.steps[0].kind == "explore"


@pytest.mark.parametrize(
    ("text", "degrees_told"),
    [
        ("spin around", [360]),
        ("spin round twice", [360]),
        ("原地转两圈", [360, 360]),
        ("转三圈", [360, 360, 360]),
    ],
)
def test_a_spin_is_whole(text: str, degrees_told: list[int]) -> None:
    made = plan(text, HOME, Context(room="study", runnable=EVERY_KIND, now=NOON))
    assert isinstance(made, StepPlan)
    steps = made.steps
    if isinstance(steps[0], Repeat):
        assert steps[0].times == 2
        steps = steps[0].steps
    turned = [round(degrees(step.angle_rad)) for step in steps if isinstance(step, Turn)]
    assert turned == degrees_told


@pytest.mark.parametrize("words", ["we all love Nan", "good luck"])
def test_names_are_said_as_they_are_written(words: str) -> None:
    made = plan(f"say {words}", HOME)
    assert isinstance(made, StepPlan)
    assert [getattr(step, "text", None) for step in made.steps][-1] == words
