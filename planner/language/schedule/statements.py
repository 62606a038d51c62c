"""Tell a statement of how things stand from an order: a time in it is no time of the order.

"The doctor's at nine", "it's nearly noon", 九点我要开会 say when something else is. Pure, on folded text.
"""

from __future__ import annotations

import re

_HAPPENS = (
    r"(?:is|are|was|were|has|have|had|will|comes?|came|starts?|begins?|ends?|leaves?|left|arrives?"
    r"|opens?|closes?|finish(?:es)?|hurts?|visits?|rings?)"
)
_WHO = (
    r"(?:he|she|it|they|that|this|there|somebody|someone|everybody|everyone|nobody"
    r"|mum|mom|dad|grandma|grandpa|nana)"
)
_OURS = r"(?:my|our|the|his|her|their) (?:[a-z]+ ){0,2}?[a-z]+"
_BESIDE = (
    r"(?: (?:at|on|in|due|here|back|home|over|up|nearly|almost|already|about|only|just|not|always"
    r"|usually|[a-z]+ing)\b.*)?"
)
_ORDERS = (
    r"(?!.*\byou\b|.*\b(?:is|are|has|have|had|need|needs) to be\b|it(?:'s| is) (?:\w+ )?time to\b)"
)
_STATES = (
    r"(?:i'm|we're|they're|i've|we've|they've|i'll be|we'll be"
    r"|(?:i|we) (?:am|are|was|were|have|had|will be|need to|must (?:be|go|leave)|feel|felt|leave"
    r"|start"
    r"|begin|finish|eat|expect|got)"
    rf"|{_WHO}(?:'s|'ll| {_HAPPENS})|{_OURS} {_HAPPENS}|there (?:is|are))\b"
)
_OPENS = rf"{_ORDERS}(?:(?:well|anyway|[a-z]+ly)[ ,]+)?"
_STATEMENT = re.compile(rf"{_OPENS}{_STATES}")
_OF_OURS = re.compile(rf"{_OPENS}{_OURS}'s{_BESIDE}$")
"""Without a mark before it, "the doctor's" is as well a place."""
_MARKS = re.compile(r"[,;:!.]+ *(?:(?:and|but|so|because|since|as|for) )?|\s[-–—]+\s|—+")
_WORDS = re.compile(r"(?<= )(?:and|but|because|'?cause|cos|since|as|please) ")
_TOLD = re.compile(
    r".*\b(?:(?:tell|inform|warn|remind) (?:(?:my|our|the|your) )?(?!(?:me|us|what|if|whether|about"
    r"|to)\b)[a-z]+"
    r"(?: (?:in|at|on|by) (?:the |my |our )?[a-z]+(?: room)?)?"
    r"|let (?:(?:my|our|the|your) )?(?!(?:me|us)\b)[a-z]+(?: [a-z]+)? know|say|announce|shout)"
    r",? (?:that )?(?!(?:hello|hi|bye|good|what|if|whether|to|how|where|when|why|who|it's time)\b)"
    r"(?:(?:i|we|you|he|she|it|they|there|that|this)(?:'(?:m|s|re|ll|ve|d)| [a-z]+)"
    r"|(?:(?:the|my|our|his|her|their|a|an) )?[a-z]+(?: [a-z]+)?"
    rf"(?:'(?:s|ll)| (?:{_HAPPENS[3:-1]}|can|must|should|needs?|goes|won't|isn't|aren't)))"
    r"(?: [a-z' ]+)?"
    r"|.*\bask (?:(?:my|our|the|your) )?(?!(?:me|us)\b)[a-z]+(?: (?:in|at|on"
    r"|by) (?:the )?[a-z]+(?: room)?)?"
    r",? (?:if|whether|what|when|where|which|how|who) [^,;]+",
)
"""Ends in words for somebody that say how things stand: "tell them dinner's ready"."""
_SPEAKS = re.compile(r"\b(?:tell|say|ask|announce|shout|call out|inform|repeat|warn)\b")
_ZH_WHO = r"(?:我们?|咱们?|客人们?|医生|大夫)"
_ZH_STATEMENT = re.compile(
    r"(?:就|都|快)?(?:到)?[了啦][,啊呀]"
    rf"|(?:就|都)?{_ZH_WHO}(?!.{{0,2}}(?:要|想|叫|让|请|希望|需要|想让|想要)你)[^,你]+,"
    r"|(?:就|都)?(?:要|得|有)?(?:个|一个)?(?:开会|上课|上班|上场|出门|直播|考试|面试|会议|复诊)[^,你]{0,4},"
)
_ZH_TWO_TIMES = re.compile(
    r"(?:就|都|得|要)*我们?[^,你叫提]{1,8},.*[\d一二三四五六七八九十两](?:点|:\d)"
)
"""明早六点我出车，五点半叫我: the first time is of the statement."""
_ZH_RECALLS = re.compile(r"提醒|[叫喊]醒?我")


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
    if reminds or _SPEAKS.search(words) is not None:  # it may be part of what is to be said
        return False
    weak = [found.end() for found in _WORDS.finditer(words)]
    return any(_STATEMENT.match(words, at) is not None for at in weak if at > strong)


_N = r"(?:an?|one|two|three|four|five|six|seven|eight|nine|ten|eleven|twelve|fifteen|twenty|thirty|\d+)"
_TIME_WITHIN = re.compile(
    r"(?P<verb>(?:(?:please|can you|could you|would you|will you) )*(?:(?:tell|inform|remind|warn)"
    r" (?:(?:my|our|the) )?(?!(?:me|us)\b)[a-z]+|let (?:(?:my|our|the) )?(?!(?:me|us)\b)[a-z]+ know"
    r"|say|announce)) "
    rf"(?P<t>in (?:about )?(?:{_N}|half an) (?:seconds?|minutes?|mins?|hours?)"
    rf"|at (?:(?:half|quarter|a quarter|five|ten|twenty) (?:past"
    rf"|to) )?{_N}(?:[:.]\d\d)?(?: ?[ap]m| o'clock)?"
    r"(?: (?:today|tomorrow|tonight))?) (?P<w>that .+)",
    re.IGNORECASE,
)


def put_time_first(text: str) -> str:
    """Return "tell Emma at six that …" with its time in front, where it is the order's."""
    found = _TIME_WITHIN.fullmatch(text)
    return f"{found['t']} {found['verb']} {found['w']}" if found is not None else text


_LIMIT = re.compile(
    r"for (?:the (?:next|rest)|this|an?|one|two|three|four|five|six|seven|ten|\d+)\b[a-z ]{0,20}?(?:minutes?|hours?|days?|weeks?|months?|morning|afternoon|evening|night|day|week)\b"
    r"|(?:until|till|up to)\b|this (?:week|month)\b"
)
_LIMIT_BEHIND = re.compile(r".+ for the (?:next|rest of the|rest of this) [a-z0-9 ]{2,20}")


def is_limited(order: str) -> bool:
    """Tell whether an order says how long it is to be kept: no standing order ends by itself."""
    return _LIMIT.match(order) is not None or _LIMIT_BEHIND.fullmatch(order) is not None


_HAS_END = re.compile(r"\b(?:until|till)\b|直到|等到|为止")


def has_end(order: str) -> bool:
    """Tell whether an order says itself when it ends: kept "every five minutes" it never would."""
    return _HAS_END.search(order) is not None


_TO_AN_HOUR = re.compile(
    r"(?:(?<=[看瞧守待陪跟巡逻转走站盯玩坐着])|一直|直)到(?:了)?(?:今天|今晚|明天|明早)?(?:早上|上午|中午|下午|傍晚|晚上|夜里|半夜|凌晨)?"
    r"(?:[零一二三四五六七八九十两\d]{1,3}(?:点|:\d)|中午|半夜|天亮|天黑)"
)
"""No plan goes on until an hour; 等到九点 waits for it, and is none of these."""
_QUOTED = re.compile(r"[“\"「].*?[”\"」]")


def goes_on_until(order: str) -> bool:
    """Tell whether a Chinese deed goes on until an hour, not in words that are said."""
    return _TO_AN_HOUR.search(_QUOTED.sub("", order)) is not None


_FILLER = re.compile(
    r"(?:as well|too|also|instead|again|please|on second thoughts?|and|then|[ ,])+"
    r"|[也都再]+(?:要|得)?(?:提醒|叫|喊|说|讲|念|来|去|做|弄)(?:一?[下声])?(?:我们?|[他她]们?)?"
    r"(?:一?(?:次|遍|回|下))?[吧啊哈哦]?"
)


def is_filler(words: str) -> bool:
    """Return whether words beside a time order nothing: "and at nine as well" leans on another."""
    return _FILLER.fullmatch(words) is not None


def ends_in_told_words(words: str) -> bool:
    """Return whether English words before a time are words for somebody, whose time it then is."""
    return _TOLD.fullmatch(words) is not None


def begins_with_statement(words: str, *, chinese: bool) -> bool:
    """Return whether the words behind a time begin with a statement, whose time it then is."""
    if chinese:
        states = _ZH_STATEMENT.match(words) is not None and _ZH_RECALLS.search(words) is None
        return states or _ZH_TWO_TIMES.match(words) is not None
    return _STATEMENT.match(words) is not None
