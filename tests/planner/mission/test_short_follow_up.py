"""A few words make one thing of the newest order, in one role, or nothing."""

from __future__ import annotations

import pytest

from planner.mission.place_words import names_of
from planner.mission.short_follow_up import ShortFollowUp, read_short_follow_up
from planner.mission.state import MissionState
from planner.plan import Find, GoTo, Turn
from tests.planner.mission.leaning import FACTS, newest, order_under_way

SEARCH = order_under_way("look for a cup", Find(object="cup"))
TURN = order_under_way("turn left", Turn(angle_rad=1.0))


@pytest.mark.parametrize(
    ("book", "said", "wanted"),
    [
        (SEARCH, "the study", ShortFollowUp("look for the cup in the study", ends=True)),
        (SEARCH, "and bottles?", ShortFollowUp("look for the bottles", joins=True)),
        (SEARCH, "look again", ShortFollowUp("look for a cup")),
        (TURN, "a bit more", ShortFollowUp("turn left by 30 degrees")),
        (TURN, "the other way", ShortFollowUp("turn right by 57 degrees", ends=True)),
    ],
)
def test_the_role_follows_from_what_is_made(
    book: MissionState, said: str, wanted: ShortFollowUp
) -> None:
    assert read_short_follow_up(said, newest(book), FACTS, names_of(FACTS), None) == wanted


@pytest.mark.parametrize("said", ["", "hello", "go to the study", "stop", "a bit more", "again"])
def test_of_other_words_nothing_is_made(said: str) -> None:
    last = newest(order_under_way("go to the kitchen", GoTo(place="kitchen")))
    assert read_short_follow_up(said, last, FACTS, names_of(FACTS), None) is None
