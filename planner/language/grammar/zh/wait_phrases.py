"""Write a Chinese wait for somebody at a place in the words of order that its forms read.

Pure text to text, on a normalised sentence. 在门口等着,有人来了就跟他说… is to go there, to wait until
somebody comes, and to say so. Law: no eye tells who is who. For one who is waited for by name
anybody counts, and only words are said then, behind the name; any other order upon them stays
unread.
"""

from __future__ import annotations

import re

from planner.language.grammar.quotes import QUOTE
from planner.language.person_names import is_given_name

_LEAD = r"(?:请|麻烦|帮我|你|您|先|就)*"
_STAYS = r"(?:等着|守着|待着|呆着|候着|站着|等候|等待|等|守)"
_COMES = r"(?:回来|回家|回到家|到家|来到|进来|进门|进屋|过来|来|出现|到|经过|路过)"
_WHEN = r"(?:的话|的时候|以后|之后|时|后)?"
_THEN = r",?(?:你|就|再|然后|便|马上|赶紧|立刻)*"
_WHO = r"[^,;。等守就来回到出进过路看]{1,5}?"
_WAIT = re.compile(
    rf"^{_LEAD}(?:(?:在|去|到)(?P<p>[^,;。等守待]{{1,8}}?)(?:那里|那儿|那边)?去?{_STAYS}(?P<n>{_WHO})??|(?:等|守|待|呆|站|候)在(?P<at>[^,;。等守待]{{1,8}}?))"
    rf"(?:,?(?:等到?|直到|到|如果|要是|一旦|只要|一)*(?:(?:看到|看见|见到)(?P<s>{_WHO})|(?P<w>{_WHO})?一?{_COMES})了?{_WHEN}"
    rf"(?:{_THEN}(?P<rest>.+))?)?$"
)
_UNTIL_TIME = re.compile(
    rf"^{_LEAD}(?:(?:在|去|到)(?P<p>[^,;。等守待看]{{1,8}}?)(?:那里|那儿|那边)?去?(?:{_STAYS}|待|呆|留)|(?:等|守|待|呆|站|候|留)在(?P<at>[^,;。等守待到看]{{1,8}}?)(?:那里|那儿|那边)?)"
    r",?(?:一直|直)?到(?P<t>(?:早上|上午|中午|下午|晚上|今晚)?[零一二三四五六七八九十两\d]{1,3}(?:[:]\d\d|点(?:钟|半|[零一二三四五六七八九十]+分?)?))(?P<rest>(?:,.+|再.+|就.+)?)$"
)
_ANYBODY = re.compile(r"(?:有|来|个)?(?:人|客人|访客|快递员?|外卖员?|送货的|师傅)们?")
_HE = re.compile(r"[他她]们?")
_TELLS = re.compile(
    r"(?:(?:告诉|提醒|通知)[他她]们?|[跟和给对向][他她]们?(?:说|讲))(?:一声|一下|声)?[,:]?(?P<x>[^,;。]+)(?P<tail>.*)"
)
_SAYS = re.compile(r"(?:说|喊)(?:一声|一句|一下|声)?[,:]?(?P<x>[^,;。]+)(?P<tail>.*)")
_GREETS = re.compile(r"(?:[跟和给对向][他她]们?)?打(?:个|声|一声)?招呼(?P<tail>.*)")
_REPORTS = re.compile(
    r"(?:告诉|通知|叫|喊|[跟和给对向](?=我们?[说讲]))我们?(?:[说讲])?(?:一声|一下|声)?(?P<tail>(?:[,;。].*)?)"
)


def plain_waits(said: str) -> str:
    """Return a wait at a place as the way there, the wait and what is done then."""
    timed = _UNTIL_TIME.fullmatch(said)
    if timed is not None:
        return f"去{timed['p'] or timed['at']},等到{timed['t']}{timed['rest']}"
    found = _WAIT.fullmatch(said)
    if found is None:
        return said
    who = found["s"] or found["w"] or found["n"] or ""
    who = found["n"] or "" if _HE.fullmatch(who) else who
    place = found["p"] or found["at"]
    named = is_given_name(who)
    if (
        not who
        or not (named or _ANYBODY.fullmatch(who))
        or (found["n"] and found["n"] not in (who, "人"))
    ):
        return said
    if found["rest"] is None:
        return f"去{place},等到有人来"
    then = _write_deed(found["rest"], who if named else "")
    return said if then is None else f"去{place},等到有人来,{then}"


def _write_deed(rest: str, name: str) -> str | None:
    """Return what is done when somebody came; None where it is more than words for one by name."""
    report = _REPORTS.fullmatch(rest)
    if report is not None:
        return f"说“有人来了{f'，可能是{name}' if name else ''}”{report['tail']}"
    greets = _GREETS.fullmatch(rest)
    if greets is not None:
        return f"说“{f'{name}，' if name else ''}你好”{greets['tail']}"
    words = _TELLS.fullmatch(rest) or _SAYS.fullmatch(rest)
    if words is None:
        return None if name else rest
    said, tail = words["x"], words["tail"]
    if re.search(QUOTE, said):
        return f"说“{name}”,说{said}{tail}" if name else f"说{said}{tail}"
    return f"说“{name}，{said}”{tail}" if name and name not in said else f"说“{said}”{tail}"
