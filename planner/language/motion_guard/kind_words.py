"""Find the words that a kind of step needs: looking, following, going near, and the thing itself.

Stricter than `step_words`, which judges a plan by the whole sentence: here only what is ordered is
read, and a person, too, must be spoken of.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.motion_guard.mentioned_names import find_places, thing_named
from planner.language.motion_guard.step_words import unnamed_part
from planner.plan import Look, MoveStraight, Patrol, StandAt

if TYPE_CHECKING:
    from planner.plan import ClockTime, Step, Vocabulary

_GAP = " | "
ROUNDS = re.compile(r"\bpatrol|\brounds?\b|\btour\b|巡")
_FOLLOWS = re.compile(
    r"\bfollow|\b(?:go|goes|come|walk|drive|run|stay|keep) (?:along )?(?:after|behind|with)\b"
    r"|\b(?:track|trail|chase|tag along)\b|随|尾"
    r"|跟(?!.{1,8}?(?:说|讲|聊|打.{0,2}招呼|告诉|道|问))"
)
_SEES = re.compile(
    r"\?|\b(?:look\w*|see|watch|check\w*|inspect\w*|what|who|where|is|are|any|find|describe"
    r"|around|show)\b"
    r"|[看瞧查找吗呢]|什么|谁|有没有|哪"
)
_SEES_ROUND = re.compile(
    r"\b(?:look\w*|see|seen|watch|check\w*|inspect\w*|around|there|describe)\b|\bany(?:one|body)\b"
    r"|[看瞧]|环顾|周围|四周|附近|有没有|有什么|有谁"
)
_WATCHES = re.compile(rf"{ROUNDS.pattern}|{_SEES.pattern}")
_NEARS = re.compile(
    r"\b(?:go|goes|approach|up to|walk|drive|come|near|next to|closer|meet|greet|tell|ask|say|bring"
    r"|guide|lead|take|deliver|move|head|to|follow|join|visit|reach|welcome|introduce)\b"
    r"|靠近|走|去|到|过|开|近|面前|跟前|旁|边|给|问|告诉|招呼|跟|找|接|带"
)
_SIDE_AFTER = re.compile(r"的?(?:正?前[面方]?|后[面方]?|背后)")
_SIDE_BEFORE = re.compile(
    r"(?:in front of|before|behind|(?:front|back) of|away from) (?:(?:the|my|our|your) )?$"
)


def unsaid_kind(step: Step | ClockTime, said: str, things: str, vocabulary: Vocabulary) -> str:
    """Return what no word asks for of the kind of step, or of the thing that it is about.

    Args:
        step: what would be done.
        said: what is ordered.
        things: what is spoken of beside it, where a thing may be named.
        vocabulary: the places whose sides are no way of the robot's own.
    """
    if isinstance(step, Look):
        looks = _SEES if step.place is not None else _SEES_ROUND
        return "" if looks.search(said) else "no word of looking"
    if isinstance(step, Patrol) and step.look and not _WATCHES.search(said):
        return "no word of looking on the way"
    label = getattr(step, "object", None)
    if label is None or isinstance(step, StandAt):
        bare = _without_sides(said, vocabulary) if isinstance(step, MoveStraight) else said
        return unnamed_part(step, bare)
    if not thing_named(label, things):
        return f"{label!r} is not named"
    if step.kind == "go_to_object" and not _NEARS.search(things):
        return "no word of going there"
    follows = step.kind != "follow" or _FOLLOWS.search(said)
    return "" if follows else "no word of following"


def _without_sides(said: str, vocabulary: Vocabulary) -> str:
    """Cut the sides of places: "before the sofa", 沙发前 say nothing of the robot's own way."""
    for place in reversed(find_places(said, vocabulary)):
        after = _SIDE_AFTER.match(said, place.end)
        before = _SIDE_BEFORE.search(said, 0, place.start)
        start = before.start() if before is not None else place.start
        end = after.end() if after is not None else place.end
        said = f"{said[:start]}{_GAP}{said[end:]}"
    return said
