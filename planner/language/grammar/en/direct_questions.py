"""Write what somebody is to be asked as it is asked: "if she wants tea" is "do you want tea?".

Pure text to text. What fits none of the forms is asked as it was said.
"""

from __future__ import annotations

import re

_VERB_OF = {"has": "have", "does": "do", "goes": "go", "is": "be"}
_PAST = {
    "slept": "sleep", "went": "go", "ate": "eat", "took": "take", "saw": "see", "got": "get",
    "found": "find", "said": "say", "wanted": "want", "liked": "like", "left": "leave",
}  # fmt: skip
_HAS_DONE = re.compile(
    r"(?:is|has) (?P<what>(?:already |just |ever )?(?:taken|eaten|seen|had|been|found|fed|drunk"
    r"|brushed|washed|called|rung|heard|got|read|packed|done (?:his|her|their|the|it)"
    r"|finished (?:his|her|their|your|the))\b.*)"
)
"""What "he's taken" and "she has had" mean; "he's done" is "he is done"."""
_MINE = re.compile(
    r"(?:(?P<word>what|where|when|how|why|which [a-z]+|what [a-z]+|how [a-z]+) |(?:if|whether) )"
    r"(?P<who>i|we)(?: (?P<be>can|could|may|should|shall|must|am|are|have|had|was|were)"
    r"|(?P<cut>'m|'ve|'re))"
    r"(?P<rest> .+)",
    re.IGNORECASE,
)
"""What the speaker wants to know of themselves: "if I can have friends over"."""
_CUT = {"'m": "am", "'ve": "have", "'re": "are"}
_ASKED_OF_THEM = re.compile(
    r"(?:(?P<word>what|where|when|how|why|which [a-z]+|what [a-z]+|how [a-z]+) |(?:if|whether) )"
    r"(?P<who>he|she|they|any(?:one|body)|some(?:one|body)|every(?:one|body))"
    r"(?P<rest>(?: |'s |'d |'re ).+)"
)
_THEIRS = {"he": "his", "she": "her", "they": "their"}
_WHERE_IT_IS = re.compile(
    r"(?P<word>where|what|who|how|when)"
    r" (?P<what>(?:(?:the|my|our|your|his|her) )?(?!(?:he|she|they|it|you|i"
    r"|we)\b)[a-z]+(?: [a-z]+)?)"
    r" (?P<be>is|are|was|were)"
)
_MODAL = re.compile(
    r"(?P<modal>can|could|will|would|should|must|may|might|did|had|have got|has got) (?P<rest>.+)"
)


def ask_directly(question: str) -> str:
    """Return "if she wants tea" as it is asked: "do you want tea?"."""
    mine = _MINE.fullmatch(question)
    if mine is not None:
        word = f"{mine['word']} " if mine["word"] else ""
        who = "I" if mine["who"].lower() == "i" else "we"
        return f"{word}{mine['be'] or _CUT[mine['cut']]} {who}{mine['rest']}?"
    found = _ASKED_OF_THEM.fullmatch(question)
    if found is None:
        turned = _WHERE_IT_IS.fullmatch(question)
        return f"{turned['word']} {turned['be']} {turned['what']}?" if turned else question
    word = f"{found['word']} " if found["word"] else ""
    they = "you" if found["who"] in _THEIRS else found["who"].replace("some", "any")
    rest = found["rest"].replace("'d ", " would ", 1).replace("'s ", " is ", 1)
    rest = rest.replace("'re ", " are ", 1).strip()
    if found["who"] in _THEIRS:
        rest = re.sub(rf"\b{_THEIRS[found['who']]} (?=[a-z])", "your ", rest)
    modal = _MODAL.fullmatch(rest)
    if modal is not None:
        may, what = modal["modal"], modal["rest"]
        if may in ("have got", "has got"):
            may, what = "do", f"have {what}"
        return f"{word}{may} {they} {what}?"
    done = _HAS_DONE.fullmatch(rest)
    if done is not None:
        return f"{word}{'have' if they == 'you' else 'has'} {they} {done['what']}?"
    verb, _, more = rest.partition(" ")
    if verb in _PAST:
        return f"{word}did {they} {_PAST[verb]}{' ' if more else ''}{more}?"
    if verb in ("is", "are", "was", "were"):
        be = {"is": "are", "was": "were"}.get(verb, verb) if they == "you" else verb
        return f"{word}{be} {they}{' ' if more else ''}{more}?"
    base = _VERB_OF.get(verb, re.sub(r"(?<=[a-z]{2})(?<!s)s$", "", verb))
    do = "do" if they == "you" else "does"
    return f"{word}{do} {they} {base}{' ' if more else ''}{more}?"
