"""Write a Chinese sentence with a condition in the one order of words that its forms read.

Pure text to text, on a normalised sentence. 书房要是没人你就去 is 如果书房没人,就去; "unless" is the
contrary condition. Law: no word goes that could change whom, where or whether; a condition that is
not plainly about who or what is somewhere is left as it was said, and is then refused as such.
"""

from __future__ import annotations

import re

_IF = r"(?:如果|要是|假如|假若|倘若|若是|万一)"
_ELSE = r"(?:否则的?话?|不然的?话?|要不然的?话?)"
_SOON = r"(?:赶紧|赶快|马上|立刻|立即|第一时间)"
_ENDS = r"(?=[,就]|的话|$)"
_BY_VERB = r"(?![去到回看瞧找跟问等说走转停叫告让喊请再先然把别不没有你您他她它我])"
"""No order begins so: what stands before "if" is then what the condition is about."""

_ROWS = tuple(
    (re.compile(pattern), plain)
    for pattern, plain in (
        (rf"^(?P<t>{_BY_VERB}[^,;。有没]{{1,10}}?){_IF}(?=[^,])", r"如果\g<t>"),
        (rf"^(?P<c>{_IF}[^,;。]{{1,20}}?)[你您]就", r"\g<c>,就"),
        (rf"(?<=[,就])[你您]?{_SOON}地?(?=[去到回来等说告叫问通提])", ""),
        (rf"^(?P<c>{_IF}[^,;。有]*?)(?:都|还|又)?还(?=有|在[^,。着]*?{_ENDS})", r"\g<c>"),
        (rf"^(?P<c>{_IF}[^,;。]*?(?:没有?|有)人)(?:坐|站|待|呆)?(?:着|在(?:那里|那儿|那边|里面?)?)?{_ENDS}", r"\g<c>"),
        (
            rf"^(?P<c>{_IF}[^,;。有]*?)(?P<d>没有?|不)?(?:坐|站|待|呆)(?P<a>在[^,;。就着了过]{{1,10}}?)(?:那里|那儿)?{_ENDS}",
            lambda found: f"{found['c']}{'不' if found['d'] else ''}{found['a']}",
        ),
        (rf"^{_IF}(?P<h>没有?|有)人(?:坐|站|待|呆)?在(?P<p>[^,;。就着了过]{{1,10}}?){_ENDS}", r"如果\g<p>\g<h>人"),
        (r"(?<=,就)(?:过去|进去)(?:一下|一趟)?(?=,|$|[看瞧找等])", "去那里"),
        (
            r"(?<=,就)(?P<p>(?![去到回在上])[^,;。看找]{1,6}?)(?:那边|那儿|那里|里面?)?(?:也|再)去?(?P<v>[看找][^,;。]{0,2})",
            r"去\g<p>\g<v>",
        ),
        (r"(?<=回来)(?:叫|喊)我(?:一声|一下)?(?=$|[,;。])", "告诉我"),
    )
)  # fmt: skip

_UNLESS = (
    re.compile(rf"^除非(?P<c>[^,;。]+),{_ELSE}(?:[你您])?(?:就|便)?(?P<o>.+)$"),
    re.compile(r"^(?P<o>[^,;。]+),除非(?P<c>[^,;。]+)$"),
)
_ONLY_IF = re.compile(
    r"^(?:除非|只有)(?P<c>[^,;。才]+?)(?:的时候|时)?,?(?:[你您])?才(?:能|可以)?(?P<o>[^,;。]+)$"
)
_HAS = re.compile(r"(?P<where>[^有没在不]*)(?P<has>没有|没|有)(?P<thing>[^有没在不着了过]+)")
_IS_AT = re.compile(
    r"(?P<who>[^有没在不]{1,10}?)(?P<at>不在|没在|在)(?P<where>[^有没在不着了过]{1,10})"
)


def plain_conditions(said: str) -> str:
    """Return a sentence whose condition stands first, without "still" and "at once"."""
    plain = _without_unless(said)
    for pattern, words in _ROWS:
        plain = pattern.sub(words, plain)
    return plain


def _without_unless(said: str) -> str:
    """Return "unless" as the contrary condition, where that can be told by its words."""
    only = _ONLY_IF.fullmatch(said)
    if only is not None:
        return f"如果{only['c'].strip()},就{only['o']}"
    found = next((hit for each in _UNLESS if (hit := each.fullmatch(said))), None)
    contrary = _contrary(found["c"]) if found is not None else None
    return said if found is None or contrary is None else f"如果{contrary},就{found['o']}"


def _contrary(condition: str) -> str | None:
    """Return a condition that holds exactly where this one does not; None where that is unsure."""
    has = _HAS.fullmatch(condition)
    if has is not None:
        return f"{has['where']}{'没有' if has['has'] == '有' else '有'}{has['thing']}"
    at = _IS_AT.fullmatch(condition)
    if at is not None:
        return f"{at['who']}{'不在' if at['at'] == '在' else '在'}{at['where']}"
    return None
