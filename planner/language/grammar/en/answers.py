"""Own the English words of orders that hang on what somebody answers."""

from __future__ import annotations

import re

_WHO = r"(?:he|she|they|i|(?:my |the )?[a-z]+)"
_THEY = r"(?:he|she|they|i)"
_AUX = r"(?:does|do|is|are|am|would|has|have|can|will)"
_LIKES = r"(?:wants?|needs?|(?:would )?likes?|fancies|fancy)(?: to| some| one| it| any| that)*"
_DONE = (
    r"(?=[,;.]| (?:then|go|come|drive|tell|say|ask|look|find|wait|turn|let|return|please|just)\b)"
)
_YES = (
    r"if (?:so|yes|it is (?:a )?yes|the answer is (?:a )?yes"
    rf"|{_WHO} (?:says?|said|answers?|replies) (?:yes|so|yeah|ok|okay)(?: please)?"
    rf"|{_THEY} {_AUX}|{_THEY} (?P<echo>%s)){_DONE}"
)
_NO = (
    r"if (?:not|no|it is (?:a )?no|the answer is (?:a )?no"
    rf"|{_WHO} (?:says?|said|answers?|replies) no(?: thanks?(?: you)?)?"
    rf"|{_THEY} {_AUX} not(?: (?P<echo>%s))?){_DONE}"
)
_ASK = r"(?P<ask>(?:.*? )?ask .+? (?:if|whether) .+?)"
_THEN = r"[,;.]? (?:(?:and|then|but|and then) )?"
_ORDER = r"(?:[,;.]| then)* (?P<then>.+?)"
_ELSE = r"(?:[,;.]? (?:and |but )?(?:otherwise|or else|else|%s)(?:[,;.]| then)* (?P<else>.+))?"


def _form(first: str, second: str) -> re.Pattern[str]:
    later = second.replace("(?P<echo>", "(?:") % _LIKES
    return re.compile(_ASK + _THEN + first % _LIKES + _ORDER + _ELSE % later)


def _behind(condition: str) -> re.Pattern[str]:
    """Return the form of an order whose condition stands behind it."""
    last = condition.replace(_DONE, "$")
    return re.compile(
        _ASK
        + r"(?:[,;.]? and|[,;.]) (?:then )?(?P<then>(?:(?! if ).)+?),? (?P<else>(?!))?"
        + last % _LIKES
    )


ANSWERS = (
    (True, _form(_YES, _NO)),
    (False, _form(_NO, _YES)),
    (True, _behind(_YES)),
    (False, _behind(_NO)),
)
OPEN_QUESTION = re.compile(
    r"(?:^|, )(?:what|where|when|who|whom|whose|how|why|which)\b|\bor\b", re.IGNORECASE
)
