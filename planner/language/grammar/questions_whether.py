"""Take the "if" out of questions that looking or asking answers, and "until" out of a wait."""

from __future__ import annotations

import re

from planner.language.grammar.lexicon import MARK, NAME

_WHETHER = re.compile(
    r"\b(tell (?:me|us)|check(?:ing)?|see(?:ing)?|look(?:ing)?|find(?:ing)? out|report"
    r"|let (?:me|us) know"
    rf"|ask(?: (?:him|her|them|(?:every|any|some)(?:one|body)|{NAME}|(?:(?:the|my|our|a) )?[a-z]+)"
    rf"(?: (?:in|at|on|by|near) (?:the )?(?:{MARK}|[a-z]+(?: room)?))?)?) (?:if|whether)\b"
    r"|(?<=[看查认下])(?:一下|看)?(?:是否|是不是|有没有)"
)


_WHEN_THEY = re.compile(
    rf"(\bask (?:him|her|them|{NAME}|(?:(?:the|my|our) )[a-z]+)"
    rf"(?: (?:in|at|on|by|near) (?:the )?(?:{MARK}|[a-z]+(?: room)?))?) when"
    r"(?= (?:he|she|they)(?:'s| is|'re| are|'ll| will| can| wants?| needs?| has| have)\b"
    r"(?! (?:back|here|there|home|in|up|awake|done|ready)\b)"
    r"(?![^,.;!?]*\b(?:if|whether|what|how|where|who|why|to)\b)[^,.;!?]*(?:[.!?]|$| and ))"
)
"""What is asked of somebody: "ask him when he's free"; before a question it is when to ask."""


_WHOEVER = re.compile(r"(?:(?<=\btell )|(?<=\bask ))whoever(?: is|'s)(?= (?:in|at|on|by|near)\b)")
"""Whoever is there is told or asked: no condition."""

_A_NOT_A = re.compile(r"((?:看|查|确认|问)[^,。;!?]*?)([^,。;!?])不\2")
"""看看她在不在: to be looked at, no negation."""

_WAITS = re.compile(
    r"\b(?P<stay>(?:wait|stay|stand|hold on)(?: (?:right )?here| there| still)*) (?:until|till)"
    r"(?= (?:it is )?(?:\d|half past)| i say [a-z]+\b| (?:some|any)(?:body|one)\b"
    r"| (?:a )?(?:person|visitor|guest|people)\b)"
    r"|(?:等[待着候]?[,，]?(?:直?到)?(?:看到|看见|见到)?(?:有人|有?客人)(?:出现|过来|进来|来)?了?(?:[之以]?后)?"
    r"|等到?(?:早上|上午|中午|下午|晚上|今晚)?(?:\d{1,2}[:：]\d\d|[零一二三四五六七八九十两\d]+点(?:钟|半)?)"
    r"|等到?我说)"
)
"""Who, which word and which hour can be waited for is no condition."""

_DONE_OR_NOT = re.compile(
    r"((?:看|查|确认|问)[^,。;!?]*?(?:[着了完好过]|回来|回家|到家|起床|起来))没有?(?=[,。;!?]|$)"
)
"""看看电视开着没有, 看看门关了没: likewise."""

_ASKS_THEM = re.compile(r"(问[^,。;!?]{0,12}?)(?:要不要|想不想|是不是|是否|能不能|有没有|需不需要)")
"""问问妈妈要不要喝茶: asked of somebody, no condition."""


def asks_whether(text: str) -> str:
    """Return the text without the "if" of a question that looking answers: no condition."""
    plain = _DONE_OR_NOT.sub(r"\1", _A_NOT_A.sub(r"\1\2", _ASKS_THEM.sub(r"\1要", text)))
    plain = _WHOEVER.sub("them", _WHEN_THEY.sub(r"\1", plain))
    waits = _WAITS.sub(lambda found: found["stay"] or "站", plain)
    return _WHETHER.sub(lambda found: found[1] or "有", waits)
