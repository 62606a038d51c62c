"""Say what is looked at again or besides: "count again", "and bottles?", "what colour is it?".

Pure. Laws: the newest order looks for, counts or looks at something; another thing in its place is
one whose name is known, and is looked for where that order looked, if it names one place; what is
in doubt stays as it was said. What comes of it is an order like any other.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.motion_guard.mentioned_names import find_places, plain
from planner.language.object_names import resolve
from planner.mission.whereabouts import sought_thing

if TYPE_CHECKING:
    from planner.mission.state import Mission
    from planner.plan import StepRecord, Vocabulary
    from planner.site.site_view import SiteView

MAX_READ = 80
_ENDS = " .!,;:。~…，；！?？"
LOOKS = frozenset({"count", "find", "look"})
_NO_REASON = (
    r"(?:go|come|drive|turn|move|look|find|search|check|count|follow|wait|say|tell|ask|try|bring"
    r"|stop|if|unless|until|till|when|while|or|instead|please|then|not)"
)
_SAID_OF = (
    r"(?:i|we|you|he|she|it|they|there|that|this|one|somebody|someone|nobody|no one"
    r"|(?:the|my|our|his|her) [a-z]+|[a-z]+(?='))"
)
_REASON = rf"(?:because |since )?(?!.*\b{_NO_REASON}\b){_SAID_OF}(?:'[a-z]+)? [a-z' ]{{2,60}}"
"""One English clause without a comma; "n't" may stand in it, a denied order may not."""
_NO_REASON_ZH = (
    r"(?:如果|要是|假如|的话|除非|别|不要|不用|停|去(?![了过])|回来|过来|到(?![了过处])|改|换|先"
    r"|而是|还是|吗|告诉|帮我|请)"
)
_REASON_ZH = (
    rf"(?!.*{_NO_REASON_ZH})(?:我|你|[他她它]们?|应该|好像|肯定|可能|刚才|刚刚|都|已经|还有|不止|怎么"
    r"|漏|少|大家|客人|奶奶|爷爷|妈妈?|爸爸?)[^,。;!?]{1,16}"
)
"""One Chinese clause."""
_OPEN = (
    r"(?:(?:ok|okay|well|um+|uh+|oh|ah|hm+|right|really|no|wait|hang on|please|robot|pons|thanks"
    r"|great|good|now|actually|and|also|then|hey|while you(?:'re| are) (?:there|at it)"
    r"|can you|could you|would you|will you)[ ,.!?;]+)*"
)
_CLOSE = (
    r"(?:[ ,]+(?:please|thanks|thank you|then|now|for me|to be sure|just to be sure|will you"
    r"|would you|could you|mate|love))*"
)
_DOUBT = (
    r"(?:(?:are you (?:really |quite |absolutely )?sure(?: about (?:that|it))?|you sure"
    r"|is that (?:right|all)"
    r"|that can't be(?: right)?|that(?:'s| is) not (?:right|enough|all)|that doesn't (?:sound"
    r"|seem) right"
    r"|i (?:don't|do not) (?:think|believe) (?:so|that|it)|there (?:must"
    r"|should) be more)[ ,.!?;]+)*"
)
_ONCE_MORE = r"(?:again|once more|one more time|a second time|another time)"
_THEM = r"(?: (?:it|that|this|them|those|these|there|in there|over there|for (?:it|them)))?"
_AGAIN = re.compile(
    rf"{_OPEN}{_DOUBT}{_OPEN}(?:(?:go (?:and |back and )?|just )?(?P<verb>count|look|check|search"
    rf"|try)"
    rf"{_THEM}(?: properly| carefully)? {_ONCE_MORE}|(?P<recount>recount){_THEM}"
    rf"|double[- ]check{_THEM}"
    rf"|(?:have|take) another (?:look|go|count)(?: (?:there|in there|over there))?)"
    r"(?:[ ,.!;]+(?:there (?:must|should) be more"
    r"|(?:i (?:think|believe|bet|reckon|guess) )?you(?:'ve| have)? missed"
    rf" (?:one|some|something|somebody|(?:a|an|the|my) [a-z]+(?: [a-z]+)?)))?{_CLOSE}"
    rf"(?:[,.;!]+ {_REASON})?"
)
_DOUBT_ZH = (
    r"(?:(?:你?(?:真的?)?确定吗?|真的吗?|是吗|不会吧|不对吧?|不可能吧?|不止吧|你?没(?:搞|看|数"
    r"|弄)错吧"
    r"|好像不对)[,?!。]*)*"
)
_AGAIN_ZH = re.compile(
    rf"(?:{_REASON_ZH},)?(?:[嗯哦啊哎诶]|那|麻烦|请|,)*{_DOUBT_ZH}(?:你)?(?:刚才|刚刚)?(?:的)?(?:那边|那里|那儿"
    rf"|那个房间|那间|同样的地方)?(?:你)?"
    r"(?:(?:再|重新|重)(?:去|好好|仔细)?(?P<verb>数|看|找|检查|清点)(?:一|上)?(?:遍|次|下|回"
    r"|[数看找](?:看)?)"
    r"|(?:再|重新|重)(?:好好|仔细)?(?P<verb2>数数|看看|找找))"
    r"(?:看|吧|啊|呀|呗|嘛)*"
    r"(?:,(?:应该|好像|肯定|可能)?(?:不止|还有|不对|没那么[多少]|漏了)(?:这么?些"
    r"|这些|的)?(?:吧|啊|呀|了)*"
    rf"|,{_REASON_ZH})?"
)
_DET = r"(?:(?:the|any|some|a|an|my|our) )?"
_THING = rf"{_DET}[a-z][a-z -]{{1,24}}?"
_BESIDES = re.compile(
    rf"(?:{_OPEN})(?:(?:(?P<sees>see|check|look)(?: and see)? (?:if|whether) (?:there(?:'s| is"
    rf"| are)|you (?:can )?(?:see|find))"
    rf"|(?P<seeks>look for|find|search for)|(?P<counts>count|how many)) (?P<thing>{_THING})"
    rf"(?:[ ,]+(?:too|as well|also|in there|there"
    rf"|while you(?:'re| are) (?:there|at it)))*)"
    rf"{_CLOSE}"
)
_THING_TOO = re.compile(
    rf"(?:(?:ok|okay|well|um|uh|oh|right|and|also|what about|how about"
    rf"|plus)[ ,]+)+(?P<a>{_THING})(?:[ ,]+(?:too|as well|also))?"
    rf"|(?P<b>{_THING})[ ,]+(?:too|as well|also){_CLOSE}"
)
_BESIDES_MARK = re.compile(r"\b(?:also|too|as well|while you)\b|^(?:oh|and)\b")
_THING_ZH = r"[^,，。的了吗呢他她它我你在去到]{1,8}?"
_BESIDES_ZH = re.compile(
    rf"(?:[嗯哦啊哎诶那]|对了|,)*(?:顺便|顺带|也|还有|另外|再|还|同时)+(?:帮我|给我|你|也|再|要)*"
    rf"(?:(?P<sees>看看?|看一?下|瞧瞧)(?:有没有|有无|有几个)|(?P<counts>数一?[下数]|清点)"
    rf"|(?P<seeks>找一?[下找]|找))(?P<thing>{_THING_ZH})"
    r"(?:吧|啊|呀|哦)*"
)
_THING_TOO_ZH = re.compile(
    rf"(?:那|还有|,)*(?P<a>{_THING_ZH})呢|(?:还有|另外还有|加上)(?P<b>{_THING_ZH})(?:吧|也(?:要"
    rf"|是))?"
    rf"|(?P<c>{_THING_ZH})也(?:要)?(?:数|找|看)(?:一?下|一遍|看)?(?:吧)?"
)
_LOOKS_LIKE = re.compile(
    rf"{_OPEN}(?:(?P<a>what colou?r)(?: is| are|'s)?(?: (?:it|that|they))?"
    rf"|which colou?r(?: is (?:it|that))?"
    r"|what(?:'s| is) (?:its|the) colou?r|what does (?:it|that) look like)"
)
_LOOKS_LIKE_ZH = re.compile(
    r"(?:那|它|这|那个|这个|是|,)*(?:什么|啥|哪种|哪个)(?:颜)?色(?:的)?(?:呢|啊|呀)?|(?:那"
    r"|它)?(?:长)(?:得)?(?:什么|啥)样(?:子)?(?:的)?(?:呢|啊|呀)?"
)
_ONE = re.compile(
    r"(?P<head>(?:(?:please|ok|okay|right|well|then|now|robot|thanks|good"
    r"|great)[ ,.!]+)*(?:can you |could you )?"
    r"(?:go|drive|come|move|head|take me)(?: over| back| on)? to) the one (?P<where>(?:in|at|near"
    r"|by|on|next to) .+)",
    re.IGNORECASE,
)
_ONE_ZH = re.compile(
    r"(?P<head>(?:那|好|请|你|就|,)*(?:去|到))(?P<where>[^,的]{1,8}?)(?:的|里的|里面的)?那一?(?:个"
    r"|把|只|张|本|瓶|条)"
)


_LOUDER = (
    r"(?:(?:a )?(?:bit |little |lot |much )?(?:louder|more loudly|slower|more slowly|clearer))"
)
_SAY_AGAIN = re.compile(
    rf"{_OPEN}(?:(?:she|he|they|nobody|no one) (?:didn't|did not|couldn't|could not)"
    rf" (?:hear|understand|catch)(?: (?:you|it|that))*[ ,.;!]+)?(?:so |please )*"
    rf"(?:(?:say|tell (?:her|him|them)|repeat|shout|announce) (?:it|that|this)(?: to (?:her"
    rf"|him|them))?"
    rf"(?: (?:{_ONCE_MORE}|(?P<twice>twice|two times)(?: more)?))?"
    rf"(?:[ ,]*(?:but )?{_LOUDER})?|(?:{_ONCE_MORE}[ ,]*(?:but )?)?{_LOUDER})"
    rf"(?:[ ,.!;]+(?:(?:she|he|they|nobody|no one)\b[a-z' ]{{3,40}}|please))*"
)
_LOUD_ZH = r"(?:大声|声音大|慢)(?:一?点|些)?"
_SAY_AGAIN_ZH = re.compile(
    r"(?:[嗯哦啊哎诶]|请|麻烦|那|你|,)*(?:(?:[我他她]们?)?(?:没|听不)(?:听)?(?:到|见|清楚?),)?"
    rf"(?:{_LOUD_ZH}地?)?(?:再|重新?)(?:{_LOUD_ZH}地?)?(?:跟[他她]们?)?(?:说|讲|喊|播)(?:一"
    rf"|(?P<twice>[两二2]))?(?:遍|次|下)"
    rf"(?:吧|啊|呀)*(?:,?{_LOUD_ZH})?"
    r"(?:,?[他她]们?(?:没听(?:到|见|清)|耳朵不好|听不(?:到|见|清)))?(?:吧|啊|呀|了|呗)*"
)


def say_again(text: str, last: Mission) -> str | None:
    """Return the order to say the last words once more that "say it again, louder" is."""
    said = plain(text).strip(_ENDS)
    chinese = has_chinese(said)
    bare = "".join(said.split()).replace("，", ",") if chinese else said
    step = last.steps[-1] if last.steps else None
    words = step.text if step is not None and step.kind == "say" else None
    found = (_SAY_AGAIN_ZH if chinese else _SAY_AGAIN).fullmatch(bare[:MAX_READ])
    if words is None or found is None or any(quote in words for quote in _QUOTES):
        return None
    once = f"说“{words}”" if chinese else f'say "{words}"'
    if not found["twice"]:
        return once
    return f"{once}，再{once}" if chinese else f"{once} and then {once}"


_QUOTES = '"“”'


def renew_look(
    text: str, last: Mission, facts: SiteView, names: Vocabulary
) -> tuple[str, bool] | None:
    """Return the look that a person asks for, and whether it joins what runs; None: another thing.

    Args:
        text: as it was said.
        last: the newest order.
        facts: the site.
        names: of its places.
    """
    said = plain(text).strip(_ENDS)
    chinese = has_chinese(said)
    bare = "".join(said.split()).replace("，", ",") if chinese else said
    step = next((step for step in reversed(last.steps) if step.kind in LOOKS), None)
    if step is None or not 0 < len(bare) <= MAX_READ:
        return None
    again = (_AGAIN_ZH if chinese else _AGAIN).fullmatch(bare)
    if again is not None:
        counts = (again["verb"] in ("count", "数", "清点")) or "recount" in bare or "数数" in bare
        looked = any(each.kind == "count" for each in last.steps) or not counts
        return (last.order_text, False) if looked else None
    if chinese is not has_chinese(last.order_text):
        return None
    besides = _look_besides(bare, last, step, facts, names, chinese=chinese)
    if besides is not None:
        return besides, True
    told = _tell_of_thing(text, bare, last, chinese=chinese)
    return (told, False) if told is not None else None


def _look_besides(
    bare: str,
    last: Mission,
    step: StepRecord,
    facts: SiteView,
    names: Vocabulary,
    *,
    chinese: bool,
) -> str | None:
    """Return the same look for another thing, where the order before looked."""
    found = (_BESIDES_ZH if chinese else _BESIDES).fullmatch(bare)
    kind, thing = step.kind, ""
    if found is not None and (chinese or _BESIDES_MARK.search(bare)):
        kind = "look" if found["sees"] else "count" if found["counts"] else "find"
        thing = found["thing"]
    else:
        found = (_THING_TOO_ZH if chinese else _THING_TOO).fullmatch(bare)
        thing = next((text for text in found.groups() if text), "") if found is not None else ""
    seen = resolve(thing) if thing else None
    if seen is None or find_places(thing, names):
        return None
    places = {each.id for each in find_places(last.order_text, names)}
    if len(places) > 1:
        return None
    place = facts.targets[places.pop()] if places else None
    if chinese:
        at = f"去{place.name.zh}" if place is not None else ""
        verb = {"count": "数一下", "find": "找"}.get(kind, "看看有没有")
        return f"{at}{verb}{thing}"
    noun = re.sub(r"^(?:the|any|some|an?|my|our) ", "", thing)
    at = f" {'in' if place.room else 'near'} the {place.name.en}" if place is not None else ""
    if kind == "count":
        return f"count the {noun}{at}"
    return f"look for the {noun}{at}" if kind == "find" else f"see if there is {_a(noun)}{at}"


def _a(noun: str) -> str:
    return f"any {noun}" if noun.endswith("s") else f"a{'n' if noun[0] in 'aeiou' else ''} {noun}"


def _tell_of_thing(text: str, bare: str, last: Mission, *, chinese: bool) -> str | None:
    """Return a sentence about "it" or "the one" with the thing that was sought in its place."""
    thing = sought_thing(last)
    if thing is None or has_chinese(thing) is not chinese:
        return None
    like = (_LOOKS_LIKE_ZH if chinese else _LOOKS_LIKE).fullmatch(bare)
    if like is not None and chinese:
        return f"看看{thing}是什么颜色的" if "色" in bare else f"看看{thing}是什么样子的"
    if like is not None:
        return (
            f"what colour is the {thing}" if "colo" in bare else f"what does the {thing} look like"
        )
    one = (_ONE_ZH if chinese else _ONE).fullmatch(bare)
    if one is None:
        return None
    if chinese:
        return f"{one['head']}{one['where']}的{thing}那里"
    return f"{one['head']} the {thing} {one['where']}"
