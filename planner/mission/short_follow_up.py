"""Read what leans on the newest order in a few words, and say what becomes of that order. Pure.

One door for its readers: places that answer or narrow, motions that are adjusted, looks that are
repeated. Law: of what they don't read, nothing is made.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from planner.mission.added_words import add_to_words, correct_words
from planner.mission.adjusted_motion import adjust_motion, turn_other_way
from planner.mission.corrected_whereabouts import correct_whereabouts
from planner.mission.renewed_look import renew_look, say_again
from planner.mission.whereabouts import answer_whereabouts

if TYPE_CHECKING:
    from planner.mission.state import Mission
    from planner.plan import Vocabulary
    from planner.site.site_view import SiteView
    from wire import Pose2


@dataclass(frozen=True, slots=True)
class ShortFollowUp:
    """Hold an order in words that lean on nothing, and its role beside the order before it."""

    order: str
    ends: bool = False
    """It comes in place of the order before, where that has not ended."""
    joins: bool = False
    """It is done right after the order before."""


def read_short_follow_up(
    text: str, last: Mission, facts: SiteView, names: Vocabulary, here: Pose2 | None
) -> ShortFollowUp | None:
    """Return what a person's few words make of the newest order; None: they make nothing of it.

    Args:
        text: as it was said.
        last: the newest order.
        facts: the site.
        names: of its places.
        here: where the robot stands in ``map``, where that is known.
    """
    placed = correct_whereabouts(text, last, facts)
    placed = placed or answer_whereabouts(text, last, facts, names)
    if placed is not None:
        return ShortFollowUp(placed, ends=True)
    turned = turn_other_way(text, last, here)
    if turned is not None:
        return ShortFollowUp(turned, ends=True)
    moved = adjust_motion(text, last)
    if moved is not None:
        return ShortFollowUp(moved)
    meant = correct_words(text, last)
    if meant is not None:
        return ShortFollowUp(meant, ends=True)
    added = add_to_words(text, last)
    if added is not None:
        return ShortFollowUp(added, joins=True)
    spoken = say_again(text, last)
    if spoken is not None:
        return ShortFollowUp(spoken)
    looked = renew_look(text, last, facts, names)
    return ShortFollowUp(looked[0], joins=looked[1]) if looked is not None else None
