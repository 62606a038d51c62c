"""Laws of the names in a sentence: "the door" is the only place of the site that is a door."""

from __future__ import annotations

import re

import pytest

from planner.language.grammar.context import Context
from planner.language.grammar.lexicon import MARK, lexicon_of
from planner.language.grammar.parser import plan
from planner.plan import EVERY_KIND, Bilingual, Entry, StepPlan, Vocabulary, places_of
from pons.evals.suites import HOME_SITE
from pons.evals.world import site_world

HOME = site_world(HOME_SITE).vocabulary
BACK = Entry(id="back_door", kind="place", name=Bilingual(en="back door", zh="后门"), aliases=())
CONTEXT = Context(room="bedroom", runnable=frozenset(EVERY_KIND))
SAID = (
    "check the door", "is the door open", "go to the door", "看看门关了没有", "去门那儿",
    "检查一下门锁好没",
)  # fmt: skip


def driven_to(text: str, vocabulary: Vocabulary) -> set[str]:
    made = plan(text, vocabulary, CONTEXT)
    steps = made.steps if isinstance(made, StepPlan) else ()
    return {place for step in steps for place in places_of(step)}


@pytest.mark.parametrize("text", SAID[:5])
def test_the_door_is_the_front_door_where_no_other_place_is_one(text: str) -> None:
    assert driven_to(text, HOME) == {"front_door"}


@pytest.mark.parametrize("text", SAID)
def test_with_two_doors_nothing_is_marked(text: str) -> None:
    both = Vocabulary(entries=(*HOME.entries, BACK))
    assert lexicon_of(both).mark(text).text == text
    assert "front_door" not in driven_to(text, both)


@pytest.mark.parametrize(
    "text",
    [
        "close the door", "open the door", "knock on the door", "ram the door",
        "the door of the fridge", "the door to the cellar", "a door", "the bathroom door",
        "get through the door",
        "看看部门", "关门", "开门", "房门", "看看柜门", "去锁门",
    ],
)  # fmt: skip
def test_another_door_and_what_is_done_to_one_are_no_place(text: str) -> None:
    marked = lexicon_of(HOME).mark(text)
    assert all("front_door" not in marked.mention(m).ids for m in re.findall(MARK, marked.text))
    assert "front_door" not in driven_to(text, HOME)


def test_what_is_marked_is_written_as_it_was_said() -> None:
    marked = lexicon_of(HOME).mark("wait at the door, then go to the kitchen")
    assert marked.restore(marked.text) == "wait at the door, then go to the kitchen"
    assert len(re.findall(MARK, marked.text)) == 2
