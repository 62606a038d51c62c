"""Label a vision model's reading of pictures: its source, and the pictures shown. Pure.

Law: the words stand beside what the detector saw and never in its place; a yes of either is not
taken back by a no of the other, still less by one about another direction.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.catalogue import build, raw, say
from planner.mission.skills.directions import direction, goes_round, list_directions
from planner.plan import Bilingual

if TYPE_CHECKING:
    from planner.mission.skills.perception import ImageAnswer

_ENDS = (".", "!", "?", "…", "”", "。", "！", "？")


def reading(
    answer: ImageAnswer, detected: bool | None, faced: tuple[float, ...], views: int, now: Bilingual
) -> Bilingual | None:
    """Return a model's words about pictures with their label; None where it has none.

    Args:
        answer: what came of the question.
        detected: whether the detector saw what was asked for; None: open, or it can't tell.
        faced: the directions of this look, from how the robot stood when it began [rad].
        views: in how many directions one looks for a whole turn.
        now: the direction of the newest picture.
    """
    if answer.text is None:
        return None
    shown = _name_pictures(answer.shown, faced, views, now)
    words = _end_sentence(answer.text)
    lead = _lead(answer.seen, detected, shown)
    return say("image.reading", lead=lead, words=words)


def _lead(seen: bool | None, detected: bool | None, shown: Bilingual) -> Bilingual:
    if seen is None or seen is detected:
        return say("image.adds", shown=shown)  # fmt: skip
    if not seen:
        return say("image.says_no", shown=shown)
    return say("image.but_says_yes" if detected is False else "image.says_yes", shown=shown)


def _name_pictures(count: int, faced: tuple[float, ...], views: int, now: Bilingual) -> Bilingual:
    """Say which pictures the model was shown: of each direction, or the newest alone."""
    if count < 2 or count != len(faced):
        alone = len(faced) > 1
        return say("image.only_picture" if alone else "image.picture", now=now)
    if goes_round(faced, views):
        return say("image.all_directions")
    names = list_directions(tuple(map(direction, faced)))
    return say("image.pictures", names=names)


def _end_sentence(text: Bilingual) -> Bilingual:
    """Return a text with a full stop behind it, where nothing ends it."""

    def end_text(language: str) -> str:
        own = text.of(language)
        return own if own.endswith(_ENDS) else own + raw("joint.full_stop", language)

    return build(end_text)
