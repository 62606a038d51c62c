"""Say whom a pronoun fits, and which one thing an order speaks of. Pure."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.motion_guard.mentioned_names import plain
from planner.plan import GoalState

if TYPE_CHECKING:
    from planner.mission.state import Mission

ORDERS_BACK = 3
"""Orders before the newest one in which a person may have been spoken of."""
_HER = re.compile(
    r"(?:mom|mum|mommy|mummy|mother|grandma|grandmother|granny|nana|nan|gran|mama|wife|daughter"
    r"|sister|aunt|auntie)$"
    r"|妈|奶奶|外婆|姥姥|姐|妹|阿姨|老婆|妻|女",
    re.IGNORECASE,
)
_HIM = re.compile(
    r"(?:dad|daddy|father|grandpa|grandfather|grand?dad|gramps|papa|husband|son|brother|uncle)$"
    r"|爸|爷爷|外公|姥爷|哥|弟|叔|老公|丈夫|儿子|先生",
    re.IGNORECASE,
)
_SOUGHT = frozenset({"find", "count", "go_to_object", "recall"})


def fits(pronoun: str, person: str) -> bool:
    """Tell whether a pronoun can mean a person of this name."""
    she, he = _HER.search(person) is not None, _HIM.search(person) is not None
    if pronoun.lower() in ("him", "he", "他"):
        return not she or he
    return not he or she if pronoun.lower() in ("her", "she", "她") else True


def _was_only_proposed(last: Mission) -> bool:
    """Tell whether a plan was laid before a person, and nothing of it was begun."""
    waits = last.state in (GoalState.AWAITING_CONFIRMATION, GoalState.CANCELLED)
    return waits and not last.has_begun


def thing_of(last: Mission) -> str | None:
    """Return the one thing that an order speaks of, in its own words."""
    things = {step.object for step in last.steps if step.kind in _SOUGHT and step.object}
    thing = things.pop() if len(things) == 1 else None
    if thing is None:
        return None
    if _was_only_proposed(last) and thing not in plain(last.order_text):
        return None
    return re.sub(r"^(?:the|my|our|your|an?) ", "", thing)
