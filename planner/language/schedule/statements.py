"""Tell a statement of how things stand from an order: a time in it is no time of the order.

"The doctor's at nine", "it's nearly noon", 九点我要开会 say when something else is. Pure, on folded
text. What is declined here is kept by nobody: the learned reader may lay it before the person.
"""

from __future__ import annotations

import re

_VERB = r"(?:is|are|was|were|has|have|had|will|comes?|came|starts?|begins?|ends?|leaves?|left|arrives?|opens?|closes?|hurts?|visits?)\b"
_WHO = r"(?:he|she|it|they|that|this|there|somebody|someone|everybody|mum|mom|dad|grandma|grandpa)"
_OURS = r"(?:my|our|the|his|her|their) (?:[a-z]+ ){0,2}?[a-z]+"
_ORDERS = (
    r"(?!.*\byou\b|.*\b(?:is|are|has|have|need|needs) to be\b|it(?:'s| is) (?:\w+ )?time to\b)"
)
_STATES = rf"(?:(?:i|we|they)(?:'\w+| (?:{_VERB}|am|need|must|feel|start|begin|leave|eat|got)\b)|{_WHO}(?:'s|'ll| {_VERB})|{_OURS} {_VERB})"
_STATEMENT = re.compile(rf"{_ORDERS}(?:(?:well|anyway|[a-z]+ly)[ ,]+)?{_STATES}")
_OF_OURS = re.compile(
    rf"{_ORDERS}{_OURS}'s(?: (?:due|here|back|home|over|[a-z]+ing)\b.*)?$|(?:[a-z]+ ){{1,2}}{_VERB}$"
)
"""Behind a mark; without one "the doctor's" is as well a place, and "see who is" an order."""
_MARKS = re.compile(r"[,;:!.]+ *(?:(?:and|but|so|because|since|as|for) )?|\s[-–—]+\s|—+")
_JOINTS = re.compile(r"(?<= )(?:and|but|because|'?cause|since|as|please) ")
_SPEAKS = r"\b(?:tell|inform|warn|remind|ask|say|announce|shout|let)\b"
_SOMEBODY = r"(?:(?:my|our|the|your) )?(?!(?:me|us|what|if|whether|about|to)\b)[a-z]+"
_TOLD = re.compile(
    rf".*\b(?:(?:tell|inform|warn|remind|let) {_SOMEBODY}(?: know)?(?: (?:in|at|on) (?:the )?[a-z]+)?|say|announce|shout),?(?: that)?"
    r" (?!(?:hello|good|if|whether|to|what|who|where|it's time)\b)(?:(?:i|we|you|he|she|it|they|there|that|this)(?:'\w+| [a-z]+)"
    rf"|(?:(?:the|my|our|his|her|their|an?) )?(?:[a-z]+ )?[a-z]+(?:'(?:s|ll)\b| (?:{_VERB}|can\b|must\b|should\b|needs?\b|goes\b)))[^,;]*"
    rf"|.*\bask {_SOMEBODY},? (?:if|whether|what|when|where|which|how|who)\b[^,;]*"
)
"""Ends in words for somebody that say how things stand: "tell them dinner's ready"."""
_ZH_STATEMENT = re.compile(
    r"[就都快]?到?[了啦][,啊呀]|[就都]?(?:我们?|咱们?|客人|医生|大夫)(?!.{0,2}(?:要|想|叫|让|请|希望)你)[^,你]+,"
    r"|[就都]?[要得有]?一?个?(?:开会|上课|上班|出门|考试|面试)[^,你]{0,4},"
)
_ZH_TWO_TIMES = re.compile(
    r"[就都得要]*我们?[^,你叫提]{1,8},.*[\d一二三四五六七八九十两](?:点|:\d)"
)
"""明早六点我出车，五点半叫我: the first time is of the statement."""
_ZH_RECALLS = re.compile(r"提醒|[叫喊]醒?我")
_LIMIT = re.compile(
    r"(?:until|till|up to)\b.*|(?:.+ )?for (?:the (?:next|rest)|this|an?|one|two|three|four|five|six|\d+)\b[a-z ]{0,20}?"
    r"(?:minute|hour|day|week|month|morning|afternoon|evening|night)s?"
)
_HAS_END = re.compile(r"\b(?:until|till)\b|直到|等到|为止")


def ends_in_statement(words: str, *, reminds: bool = False) -> bool:
    """Return whether English words before a time end in a statement, whose time it then is.

    Args:
        words: what stands before the time.
        reminds: a person is to be reminded of them: what they begin with is no statement.
    """
    marks = [found.end() for found in _MARKS.finditer(words)]
    strong = marks[-1] if marks else 0
    if (strong or not reminds) and _STATEMENT.match(words, strong) is not None:
        return True
    if strong and _OF_OURS.match(words, strong) is not None:
        return True
    if reminds or re.search(_SPEAKS, words) is not None:  # it may be what is to be said
        return False
    weak = [found.end() for found in _JOINTS.finditer(words)]
    return any(_STATEMENT.match(words, at) is not None for at in weak if at > strong)


def ends_in_told_words(words: str) -> bool:
    """Return whether English words before a time are words for somebody, whose time it then is."""
    return _TOLD.fullmatch(words) is not None


def begins_with_statement(words: str, *, chinese: bool) -> bool:
    """Return whether the words behind a time begin with a statement, whose time it then is."""
    if not chinese:
        return _STATEMENT.match(words) is not None
    states = _ZH_STATEMENT.match(words) is not None and _ZH_RECALLS.search(words) is None
    return states or _ZH_TWO_TIMES.match(words) is not None


def is_limited(order: str, *, is_interval: bool) -> bool:
    """Tell whether an order says how long it is to be kept: no standing order ends by itself.

    "Until" of what comes every so many minutes is when that ends; else it may be of the deed.
    """
    ends = is_interval and _HAS_END.search(order) is not None
    return ends or _LIMIT.fullmatch(order) is not None
