"""Read orders upon somebody's coming who is named, and upon what the robot can't notice.

"When the kids come home, tell them …": the robot can't tell one person from another, so it waits
for anybody and speaks the name. "If you see anybody in the hallway at night, let me know": where
somebody is seen, no event tells; the nearest one is offered. Pure.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from planner.language.person_names import is_given_name

KIN = (
    r"(?:(?:my|our|the|your) )?(?:kids?|children|child|boys?|girls?|family|guests?|visitors?|wife|husband"
    r"|partner|boyfriend|girlfriend|son|daughter|brother|sister|mother|father|parents?|mum|mom|mummy|mommy|dad|daddy"
    r"|nan|nana|gran|granny|grandma|grandpa|grandad|granddad|grandmother|grandfather|uncle|aunt|auntie|neighbou?rs?"
    r"|cleaner|postman|plumber|nurse|carer|babysitter|flatmate|roommate|friends?|lads?|twins|others|lodger)"
)
_WHO_EN = rf"(?P<who>{KIN}(?: (?:and|or) {KIN})?(?: [a-z]+)?|[a-z]+)"
COMES = (
    r"(?:(?:comes?|gets?|arrives?|walks?|returns?)(?: (?:back|home|in|inside|here|through the door|in the door"
    r"|to the door|over|round|around|from (?:work|school)|by))*|(?:is|are) (?:back|home|here|at the door)(?: from [a-z]+)?"
    r"|shows? up|turns? up)"
)
_EN = re.compile(
    rf"(?:when(?:ever)?|as soon as|every time|each time|once|the moment|(?:the )?next time) {_WHO_EN} {COMES}"
    r"(?: (?:today|tonight|later|again|this (?:morning|afternoon|evening)))?[, ]+(?:then |please |can you |could you )*"
    r"(?P<order>.+)"
)
_NOBODY_EN = re.compile(
    r"(?:it|that|this|there|something|anything|everything|somebody|someone|anybody|anyone|nobody|you|i|we|he|she|they"
    r"|dinner|lunch|food|rain|night|day|summer|winter|christmas|spring|time|work|school|music|one|people|the|a)"
)
_SPEAKS_EN = re.compile(
    r"(?:please |just )*(?:tell|let|remind) (?P<to>them|him|her|everybody|everyone|[a-z' ]{2,20}?)(?P<know> know)?"
    r"(?P<how> (?:that|to|not to|about)(?= )| (?=(?:there|i|we|you|he|she|it|the|my|our|his|her|their|dinner|lunch|tea|food|[a-z]+'s|[a-z]+ (?:is|are)))) ?"
    r"(?P<what>.+)"
)
_WISHES_EN = re.compile(
    r"(?:please |just )*wish (?:them|him|her|[a-z' ]{2,20}?) (?:a |an )?(?:very )?(?P<what>(?:happy|merry|good|nice|pleasant|lovely)\b.+)"
)
_OWN = {"them": "their", "him": "his", "her": "her"}
_SAYS_EN = re.compile(r"(?:please |just )*say (?P<what>.+)")
_KIN_ZH = (
    r"(?:我|我们|咱)?(?:家)?(?:的)?(?:孩子|小孩|小朋友|宝宝|客人|家人|爸爸?|妈妈?|老爸|老妈|爷爷|奶奶|阿公|阿婆|阿爷|阿嬷|外公|外婆|姥姥|姥爷"
    r"|老公|老婆|儿子|女儿|囡囡|哥哥?|姐姐?|弟弟?|妹妹?|叔叔|阿姨|保姆|室友|邻居|朋友|快递员?|[小老阿][一-龥])们?"
)
_ZH = re.compile(
    rf"(?:当|等|等到|只要|一旦|每次|每当|要是|下次)?(?P<who>{_KIN_ZH})(?P<at>一|们)?(?:放学|下班)?"
    r"(?:回来|回家|进门|进屋|进来|到家|来家里|来)(?P<end>了的时候|的时候|之后|以后|了|时|后)?,?(?:你?就|请|麻烦|帮我|你|都)*(?P<order>.+)"
)
_I_COME_ZH = re.compile(
    r"(?:(?P<lead>当|只要|一旦|每次|每当|每回))?我们?(?P<at>一)?(?:放学|下班)?(?:回来|回家|进家?门|进屋|进来|到家)"
    r"(?:了)?(?P<end>的时候|之后|以后|时)?,?(?:你?就|请|你|都|要|得)*(?P<order>(?:说|喊|[跟对和]我(?:说|讲)).+)"
)
"""Not with 等 before it: that is once, and the order of now."""
_TO_ME_ZH = re.compile(r"[跟对和]我(?:说|讲)(?:一声|一句|句|声)?[,:]?(?P<what>.+)")
_FINDS_OUT_ZH = re.compile(r"[吗呢?]|什么|谁|几|哪|怎么|多少|有没有|是不是|没有$")
_LEADS_ZH = re.compile(
    r"(?:当|等|等到|只要|一旦|每次|每当|要是|下次)|.*?(?:的时候|之后|以后|时,|后,|一回|一进|一到|就)"
)
_SPEAKS_ZH = re.compile(
    r"(?:告诉|提醒|通知|[跟和给对](?P<to2>[他她它]们?|大家)(?:说|讲)(?:一声|一下|声)?|叫)"
    r"(?P<to>[他她它]们?|大家)?(?:一声|一下)?[,:]?(?P<what>.+)"
)
_SPEAKS_WHO_ZH = re.compile(
    r"[跟和给对](?:[他她它]们?|大家)(?:说|讲)(?:一声|一下|声)?[,:]?(?P<what>.+)"
)
_TELL_ME_EN = (
    r"(?:please |then )*(?:let (?:me|us) know|tell (?:me|us)|call (?:me|us)|warn (?:me|us)|alert (?:me|us)|shout|give me a shout|notify me)"
    r"(?: (?:about it|at once|right away|straight ?away|immediately|please|asap))*"
)
_SEES_EN = re.compile(
    r"(?:when(?:ever)?|if(?: you)? ever|if|any ?time|every time|each time)(?: you)? (?:ever )?(?:see|spot|notice|detect)"
    r" (?P<what>(?:any|some)(?:body|one)|a person|people|a stranger|strangers?|somebody strange|(?:any|some)(?:body|one) [a-z ]+?)"
    r"(?P<at> (?:in|at|near|by|outside|on|around) (?:the |my |our )?[a-z ]+?)?"
    r"(?P<when> (?:at night|during the night|in the night|after dark|in the (?:morning|afternoon|evening)|while (?:i'm|i am|we're|we are) (?:out|away|asleep|sleeping)))?"
    rf"[, ]+(?P<do>{_TELL_ME_EN})"
)
_WATCHES_EN = re.compile(
    r"(?:whenever|every time|each time|any ?time|if you ever)"
    r" (?!(?:i|we)\b|you(?:'re| are)\b|you (?:like|want|can|have|get|feel|go|come|finish)\b)(?P<what>[^,]+?),? (?P<do>(?:please )?(?:tell|say|go|let|ask|remind|come|drive|check|warn|turn|follow)\b.+)"
)
_SPEAKS = re.compile(
    r"(?:please |just |also )*(?:say|tell|let|remind|ask|greet|welcome|announce|wish|warn)\b"
    r"|(?:说|告诉|提醒|通知|问|叫|喊|[跟和给对].{1,4}(?:说|讲|问))"
)
"""An order that moves nothing: a person who only may be the one is told in vain at worst."""
_TELL_ME_ZH = r"(?:就|你|请|马上|立刻|立即|赶紧|赶快|第一时间|要|得)*(?:跟|和|给)?我?(?:讲|说|告诉我?|通知我?|叫我?|喊我?|提醒我?)(?:一声|一下|说)?"
_SEES_ZH = re.compile(
    r"(?:要是|如果|一旦|万一|只要|假如|每次|什么时候)(?:你)?(?P<when>晚上|夜里|半夜|白天)?(?:看到|看见|发现|见到)(?P<when2>晚上|夜里|半夜|白天)?"
    rf"(?P<what>.{{0,8}}?(?:有人|陌生人|人|{_KIN_ZH}).{{0,12}}?),?(?P<now>就|马上|立刻|立即|赶紧|赶快|第一时间)+{_TELL_ME_ZH}"
)


_SEES_TO_TELL_ZH = re.compile(
    rf"(?:要是|如果|一旦|只要|每次)?(?:你)?(?:看到|看见|见到)(?:有人|人|{_KIN_ZH})[^,你]{{1,8}},?就(?:你|请)?"
    r"(?:[跟和对给][他她]们?(?:说|讲)|告诉[他她]们?|提醒[他她]们?)(?:一声)?[,:]?(?P<what>[^,]{2,20})"
)


@dataclass(frozen=True, slots=True)
class Arrival:
    """Hold who is waited for, and the order in words that name them."""

    who: str
    order: str


def read_arrival(folded: str, written: str, *, chinese: bool) -> Arrival | None:
    """Return whom a sentence waits for by name, and what is then to be done; None of any other."""
    found = (_ZH if chinese else _EN).fullmatch(folded)
    if found is None:
        return _read_my_coming(folded, written) if chinese else None
    who = written[slice(*found.span("who"))].strip()
    order = written[slice(*found.span("order"))].strip()
    if _SPEAKS.match(order.lower()) is None:
        return None
    if chinese:
        return Arrival(who, _speak_chinese(who, order)) if _LEADS_ZH.match(folded) else None
    named = re.fullmatch(KIN + r"(?: (?:and|or) .+)?|.* .*", found["who"]) is not None
    if not named and (
        _NOBODY_EN.fullmatch(found["who"]) or not (who[:1].isupper() or is_given_name(who))
    ):
        return None
    return Arrival(who, speak_to(who, order))


def _read_my_coming(folded: str, written: str) -> Arrival | None:
    """Read 我一进门就说…: whoever comes is meant, as nobody is told from others."""
    found = _I_COME_ZH.fullmatch(folded)
    if found is None or not (found["lead"] or found["at"] or found["end"]):
        return None
    order = written[slice(*found.span("order"))].strip()
    to_me = _TO_ME_ZH.fullmatch(order)
    words = to_me["what"] if to_me is not None else order
    quoted = re.search('[“"「]', words) is not None
    if not quoted and (_FINDS_OUT_ZH.search(words) or "," in words):
        return None
    return Arrival("您", order if to_me is None else _say_words(words, quoted=quoted))


def _say_words(words: str, *, quoted: bool) -> str:
    """Return the order to say words, which may stand in quotes already."""
    return f"说{words}" if quoted else f"说“{words}”"


def speak_to(who: str, order: str) -> str:
    """Return the words to say to somebody who comes, under their name where it is known."""
    wish = _WISHES_EN.fullmatch(order.lower())
    found = _SPEAKS_EN.fullmatch(order.lower())
    name = re.sub(r"^(?:the|my|our|your) ", "", who)
    name = name[:1].upper() + name[1:]
    if wish is not None:
        return _say(name, order[slice(*wish.span("what"))].strip(" .!"))
    if found is None or found["to"] in ("me", "us") or '"' in order:
        return order
    words = order[slice(*found.span("what"))].strip(" .!")
    how = (found["how"] or "").strip()
    if how in ("to", "not to"):
        words = (
            re.sub(rf"\b{_OWN[found['to']]} (?=[a-z])", "your ", words)
            if found["to"] in _OWN
            else words
        )
        words = f"please {'do not ' if how == 'not to' else ''}{words}"
    elif how == "about":
        words = f"remember {words}"
    return _say(name, words)


def _say(name: str, words: str) -> str:
    said = f"{name}, {words}" if name else f"{words[:1].upper()}{words[1:]}"
    return f'say "{said}"'


def _speak_chinese(who: str, order: str) -> str:
    found = _SPEAKS_WHO_ZH.fullmatch(order)
    if found is None:
        other = _SPEAKS_ZH.fullmatch(order)
        found = other if other is not None and (other["to"] or other["to2"]) else None
    if found is None or "“" in order or '"' in order:
        return order
    name = re.sub(r"^(?:我们?|咱)(?:家)?的?", "", who) or who
    return f"说“{name}，{found['what'].strip('。!！')}”"


def offer_event(folded: str, *, chinese: bool) -> str | None:
    """Return the sentence that comes nearest to an event that nobody can notice.

    None of a sentence that waits for no such event; empty where none comes near.
    """
    if chinese:
        told = _SEES_TO_TELL_ZH.fullmatch(folded)
        if told is not None:
            return f"看到人的时候，说{told['what']}"
        seen = _SEES_ZH.fullmatch(folded)
        if seen is None:
            return None
        when = seen["when"] or seen["when2"] or ""
        return f"{'晚上' if when in ('晚上', '夜里', '半夜') else ''}看到人的时候，说我看到有人了"
    sees = _SEES_EN.fullmatch(folded)
    if sees is not None:
        if not sees["at"] and not folded.startswith("if"):
            return None  # "whenever you see somebody, tell me": an event
        begins = folded.startswith("if ") and not folded.startswith(("if you ever", "if ever"))
        if begins and not sees["when"]:
            return None  # "if you see anybody in the kitchen, tell me": a look now
        night = sees["when"] is not None and re.search(r"night|dark|asleep|sleep", sees["when"])
        return f"when you see somebody{' at night' if night else ''}, say I see somebody"
    return "" if _WATCHES_EN.fullmatch(folded) is not None else None
