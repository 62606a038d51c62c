"""Hold that a place which is only spoken of sends nobody there, and that orders are left alone."""

from __future__ import annotations

import pytest

from planner.language.motion_guard import PersonWords, find_unasked
from planner.language.motion_guard.mentioned_names import places_named
from planner.plan import GoTo, Patrol, StepPlan
from pons.evals.world import site_world
from pons_assets import DEFAULT_SITE

HOME = site_world(DEFAULT_SITE).vocabulary


def is_asked(*words: str) -> bool:
    """Return whether a drive to the first place that is named would wait for a yes."""
    place = places_named(" ".join(words), HOME)[0]
    found = {
        bool(find_unasked(StepPlan(steps=(step,), asked_by=(quoted,)), PersonWords(words), HOME))
        for step in (GoTo(place=place), Patrol(places=(place,)))
        for quoted in words
    }
    return found == {True}


@pytest.mark.parametrize(
    "text",
    [
        "the study smells of coffee",
        "the kitchen is lovely",
        "my keys are in the study",
        "there is a spider in the bathroom",
        "somebody left the light on in the kitchen",
        "I have to work in the study",
        "dinner is served in the kitchen",
        "书房里有咖啡味",
        "厨房真好看",
        "我刚才在书房开会",
        "客厅的沙发是新买的",
        "我在书房",
        "maybe go to the kitchen",
        "shall we go to the kitchen",
        "Alexa, go to the kitchen",
        "kids, into the bathroom and brush your teeth",
        "my sister went out and left the bedroom",
        "if I were you I'd go to the kitchen",
        "tell Mum the cat is in the kitchen",
        "go to your bedroom, Tommy",
        "go to the kitchen or the study",
        "go to the kitchen and bring me the cup",
        "孩子们，去卧室",
        "天猫精灵，去厨房",
        "老公你去看看厨房",
        "要不是膝盖疼，我就去厨房了",
        "转告小红我去了厨房",
        "去厨房还是书房",
        "去厨房拿杯子给我",
    ],
)
def test_a_statement_orders_no_drive(text: str) -> None:
    """A real model planned `go_to study` for the first, and it was walked."""
    assert is_asked(text)


@pytest.mark.parametrize(
    "words",
    [
        ("kitchen",),
        ("the kitchen, please",),
        ("厨房吧",),
        ("to the study",),
        ("come over", "the kitchen"),
        ("scurry to the kitchen",),
        ("you are needed in the kitchen",),
        ("I want you in the bedroom",),
        ("去厨房",),
        ("来厨房一下",),
    ],
)
def test_an_order_and_a_bare_name_still_are(words: tuple[str, ...]) -> None:
    assert not is_asked(*words)
