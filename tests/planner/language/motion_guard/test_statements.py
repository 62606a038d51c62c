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
    plans = (StepPlan(steps=(GoTo(place=place),)), StepPlan(steps=(Patrol(places=(place,)),)))
    found = {bool(find_unasked(made, PersonWords(words, "hallway"), HOME)) for made in plans}
    assert len(found) == 1
    return found.pop()


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
    ],
)
def test_a_statement_orders_no_drive(text: str) -> None:
    """A real model planned `go_to study` for the first, and the guard let it pass."""
    assert is_asked(text)


@pytest.mark.parametrize(
    "words",
    [
        ("kitchen",),
        ("the kitchen, please",),
        ("厨房吧",),
        ("to the study",),
        ("clean up", "the kitchen"),
        ("scurry to the kitchen",),
        ("you are needed in the kitchen",),
        ("I want you in the bedroom",),
        ("去厨房",),
        ("来厨房一下",),
    ],
)
def test_an_order_and_a_bare_name_still_are(words: tuple[str, ...]) -> None:
    place = places_named(" ".join(words), HOME)[0]
    made = StepPlan(steps=(GoTo(place=place),))
    assert not find_unasked(made, PersonWords(words, "hallway"), HOME)
