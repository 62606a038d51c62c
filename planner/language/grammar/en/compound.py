"""Own the English words of orders that hang on something."""

from __future__ import annotations

import re

from planner.language.grammar.compound_forms import CompoundForms
from planner.language.grammar.en.answers import ANSWERS, OPEN_QUESTION
from planner.language.grammar.en.conditions import PERSON, read_condition, read_memory
from planner.language.numbers import EN_DURATION, times

_NOT = r"(?:can not|cannot|could not|do not|does not|are not able to|is not)"
_YOU = r"(?:you|it|that|this|the way|the door|there)"
_FAILS = (
    rf"(?:{_YOU} {_NOT}(?: (?:get|(?:go|drive)(?= there| in)|reach|enter|make|find|see|work"
    r"|possible|there|in|it|that|him|her|them|anything|a way|the (?:way|room)|out))*"
    r"|(?:it|that|this|the (?:way|door|room)) (?:fails|is (?:blocked|closed|shut|locked))"
    r"|there is no way(?: there| in)?)"
)
_OTHERWISE = (
    r"(?:[,;.]? ?(?:and |but )?(?:otherwise|or else|else|if not|if no)(?:,| then)?(?: just)? )"
)
_IF = r"(?:if|in case)"
_IF_NOT = r"(?:if|in case|(?P<unless>unless))"
_VERBS = (
    r"(?:please|go|come|drive|return|turn|look|say|tell|wait|find|follow|move|head|patrol|count|stay"
    r"|search|check|visit|ask|let|try|greet|welcome|charge|recharge|dock|remind|inform|notify|warn|report"
    r"|just|announce|stand|meet|drop|wake|give|bring|play|do)"
)
_NOT_BEGUN = r"(?<!\bgo)(?<!\bcome)(?<! and)(?<!\bplease)(?<!\bjust)"
"""An order that has begun before: "go and tell …"."""
_NO_QUESTION = (
    r"(?!.*\b(?:(?:check|see|look|find out|tell|know|ask|report|wonder)(?: \w+)?|say) if\b)"
)
"""“See if somebody is there” asks, and hangs nothing on it."""


def _count(words: str) -> int | None:
    return times(words) if words else None


_HOURS = {
    word: hour
    for hour, word in enumerate(
        ("twelve", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten",
         "eleven")
    )
}  # fmt: skip


def _time(words: str) -> str | None:
    found = re.fullmatch(
        r"(?P<half>half past )?(?P<hour>\d{1,2}|[a-z]+)(?::(?P<minute>\d\d))?(?: ?o'?clock)?"
        r"(?: ?(?P<noon>[ap])\.?m\.?)?",
        words,
    )
    if found is None:
        return None
    hour = int(found["hour"]) if found["hour"].isdigit() else _HOURS.get(found["hour"])
    minute = 30 if found["half"] else int(found["minute"] or 0)
    if hour is None or not (hour <= 23 and minute <= 59):
        return None
    if found["noon"] and hour <= 12:
        hour = hour % 12 + (12 if found["noon"] == "p" else 0)
    elif not found["minute"] or found["half"]:
        return None  # "seven" alone: in the morning or in the evening?
    return f"{hour:02d}:{minute:02d}"


_GO_ON = r"(?:[,;.]? ?(?:and then|then|and|,) ?(?P<rest>.+))?"
_FIRST = r"(?:(?P<before>.+?)(?:,| and then|, then| and|;|\.) )"
_BEFORE = rf"{_FIRST}?"
_STAY = r"(?:please )?(?:wait|stay|stand|hold on)(?: here| there| still| right here)*"

_AT = r"(?: (?:in|at|by|near|next to|beside|inside) (?P<at>(?:the|my|our) [a-z]+(?: [a-z]+)??))?"
_COMES = (
    r"(?:(?:comes?|gets?|arrives?|walks?|returns?|drops?|pops?)(?: (?:in|by|along|over|home|here"
    r"|there|back|inside|round|to the door|through the door|from (?:work|school)))*"
    r"|(?:is|are) (?:there|here|back|home|in)|appears?|(?:shows?|turns?) up|enters?)"
)
_TO_COME = rf"(?: to {_COMES})?"
_ONE = (
    r"(?!(?:i|you|he|she|it|they|we|that|this|there|something|anything|nothing|nobody|me|us|him|her"
    r"|them|the (?:end|time|day|morning|evening))\b)(?:(?:my|our|the) )?[a-z]+(?: [a-z]+)??"
)
_FOLK = re.compile(
    r"(?:kids?|children|boys?|girls?|twins|family|guests?|visitors?|parents|others|cleaner|postman"
    r"|plumber|nurse|carer|babysitter|lodger|doctor|delivery(?: (?:man|driver|person))?|courier"
    r"|flatmates?|roommates?|friends?|neighbou?rs?|partner|boyfriend|girlfriend)"
)
_LOOKING = r"(?:look|search|hunt|check)(?:ing)?"
_MOVING = r"(?:go|going|drive|driving|move|moving|wander(?:ing)?|patrol(?:ling)?|walk(?:ing)?)"
_ROUND = (
    r"(?: (?:a?round|about|everywhere|(?:from )?room (?:to|by|after) room"
    r"|(?:in |into |through |a?round |to )?(?:all (?:of )?the|the whole|the entire|the|every|each)"
    r"(?: single)? (?:rooms?|house|home|flat|apartment|place)))"
)
_FOUND = (
    r"(?:,? until| till) (?:you have|you've|you)(?: can| finally)?"
    r" (?:find|found|see|seen|spot|spotted|locate|come across) (?P<what>[a-z' -]+?)"
)
_KEEP = r"(?:please |just )?(?:(?:keep(?: on)?|carry on|go on|continue) )?"
_SO = r"(?:(?:please|just|also|then|go|come|and|instead|maybe|you can|could you) )*"
_ANOTHER = r"(?!me\b|us\b|him\b|her\b|them\b)(?:my )?[a-z]+"
_STOP = r"(?:wait|stay|stand|sit)"
_I_RETURN = r"(?:i am|i'm|we are|i|we)(?: (?:come|get|am|are))? (?:back|return|here)(?: again)?"
_HOUR = r"(?:half past )?[a-z0-9]+(?::\d\d)? ?[ap]\.?m\.?|half past [a-z]+|\d{1,2}:\d\d"
_UNTIL_SEEN = (
    rf"(?:until|till) (?:(?:it is )?(?P<time>{_HOUR})"
    r"|(?:you (?:can )?(?:see|find|spot) |there is )?"
    r"(?P<until>(?!no\b|nobody\b|not\b|i\b|you\b)[^,;]+?)"
    r"(?: (?:comes(?: in)?|is there|there|shows up|turns up|arrives|appears))?)"
)
_THEM = r"(?:him|her|them)"
_TOLD_END = r"(?=$|[,;]| and (?:then )?(?:go|come|drive|return|look|find|wait|follow|turn|head)\b)"

ENGLISH_COMPOUND = CompoundForms(
    trigger=re.compile(
        r"\b(?:if|unless|in case|until|till|every|twice|thrice|times|slowly|carefully|follow"
        r"|(?:wait|stay|stand) .*for)\b",
        re.ASCII,
    ),
    conditions=(
        re.compile(
            rf"(?:please )?{_IF} (?P<body>(?:there is )?(?:nobody|no one)\b.+?)[,.;]"
            r" ?(?:and |but )?if (?:there is (?:some|any)(?:body|one)|(?:some|any)(?:body|one) is)"
            r"(?: (?:there|in|in there|inside))?,?(?: then)? (?P<else>.+)"
        ),
        re.compile(rf"(?:please )?{_IF_NOT} (?P<body>.+?){_OTHERWISE}(?P<else>.+)"),
        re.compile(rf"(?:please )?{_IF_NOT} (?P<body>.+)"),
        re.compile(
            rf"(?:please )?(?:check|see|look|find out) (?:if|whether) (?P<if>.+?)[;,.] ?(?:and )?"
            rf"if (?:so|yes|there is|they are)(?:,| then)? (?P<then>.+?){_OTHERWISE}(?P<else>.+)"
        ),
        re.compile(
            r"(?:please )?(?:check|see|look|find out) (?:if|whether) (?P<if>.+?)[;,.] ?(?:and )?"
            r"if (?:so|yes|there is|they are)(?:,| then)? (?P<then>.+)"
        ),
        re.compile(
            r"(?P<then>.+?),? (?P<unless>unless) (?P<if>.+?)"
            rf"(?:,? (?:and )?in (?:which|that) case,? |{_OTHERWISE})(?P<else>.+)"
        ),
        re.compile(rf"{_NO_QUESTION}(?P<then>.+?),? {_IF} (?P<if>.+?){_OTHERWISE}(?P<else>.+)"),
        re.compile(rf"{_NO_QUESTION}(?P<then>.+?),? {_IF_NOT} (?P<if>.+)"),
    ),
    read_condition=read_condition,
    read_memory=read_memory,
    clock=re.compile(
        r"(?:it is|it's|the time is)(?: already)? (?:(?:after|past|later than) (?P<after>[^,]+)"
        r"|(?:before|earlier than|not yet|not (?:after|past)) (?P<before>[^,]+))"
    ),
    go_there=re.compile(
        r"\b(?P<verb>go|drive|move|head|come|return|get|walk|proceed)(?: over| back)? there\b"
    ),
    to=" to the ",
    tells=(
        (
            re.compile(
                rf"\b(?:tell|inform|remind|let|ask) {_THEM} (?:know )?to"
                rf" (?P<w>[^,;\"]+?){_TOLD_END}"
            ),
            r'say "please \g<w>"',
        ),
        (
            re.compile(
                rf"\b(?:tell|inform|remind|let) {_THEM} (?:know )?(?:that )?"
                r"(?!(?:if|whether|where|what|who|how|when|why|about)\b|(?:a|the) [a-z]+(?:$|[,;]))"
                rf"(?P<w>[^,;\"]+?){_TOLD_END}"
            ),
            r'say "\g<w>"',
        ),
        (
            re.compile(rf"\bask {_THEM} (?=(?:if|whether|what|where|when|how|why|which|who)\b)"),
            "ask ",
        ),
        (re.compile(rf"\bsay (?P<w>[^,;\"]+?) to {_THEM}(?=$|[,;]| and\b)"), r'say "\g<w>"'),
    ),
    reports=re.compile(
        r"(?:please )?(?:(?:tell|inform|notify|warn|say) me|let me know|say so|report(?: back)?)"
        r"(?: about it| please)?"
    ),
    calls=", ",
    cuts=re.compile(rf" then |{_NOT_BEGUN} (?={_VERBS}\b)"),
    failures=re.compile(
        rf"(?:try to )?(?P<main>.+?)[,;.]? (?:and |but |or )?{_IF} {_FAILS}"
        r"(?:,| then|, then)? (?P<else>.+?)(?: instead)?"
    ),
    rounds=re.compile(
        r"(?P<main>.+?),? (?:a )?(?P<times>twice|thrice|couple of times|(?:few|several|two|three"
        r"|four|five|six|seven|eight|nine|ten|[2-9]|1\d|20) times)"
    ),
    count=_count,
    waits=(
        re.compile(rf"{_BEFORE}{_STAY}(?: until| till) i say (?P<word>[a-z]+){_GO_ON}"),
        re.compile(
            rf"{_BEFORE}{_STAY}(?: until| till) (?:it is )?"
            rf"(?P<time>(?:half past )?[a-z0-9]+(?::\d\d)?(?: ?[ap]\.?m\.?)?){_GO_ON}"
        ),
        re.compile(rf"{_BEFORE}{_STAY}{_AT}(?: until| till) (?P<who>{PERSON}) {_COMES}{_GO_ON}"),
        re.compile(rf"{_BEFORE}{_STAY}{_AT}(?: until| till) (?P<who>{_I_RETURN}){_GO_ON}"),
        re.compile(
            rf"{_BEFORE}{_STAY}{_AT}(?: until| till) you (?:can )?see (?P<who>{PERSON}){_GO_ON}"
        ),
        re.compile(rf"{_BEFORE}{_STAY}{_AT} for (?P<who>{PERSON}){_TO_COME}{_GO_ON}"),
        re.compile(rf"{_FIRST}{_STAY} for (?P<who>me|us){_TO_COME}{_GO_ON}"),
        re.compile(rf"{_BEFORE}{_STAY} for (?P<who>{PERSON}){_TO_COME}{_AT}{_GO_ON}"),
        re.compile(rf"{_BEFORE}{_STAY}{_AT}(?: until| till) (?P<named>{_ONE}) {_COMES}{_GO_ON}"),
        re.compile(
            rf"{_BEFORE}{_STAY}{_AT}(?: until| till) you (?:can )?see (?P<named>{_ONE}){_GO_ON}"
        ),
        re.compile(rf"{_BEFORE}{_STAY}{_AT} for (?P<named>{_ONE}){_TO_COME}{_GO_ON}"),
        re.compile(rf"{_BEFORE}{_STAY} for (?P<named>{_ONE}){_TO_COME}{_AT}{_GO_ON}"),
    ),
    time=_time,
    slowly=re.compile(r"\b(?<!not )(?<!too )(?:very |nice and )?(?:slowly|carefully)\b"),
    polls=(
        re.compile(
            rf"(?:please )?every {EN_DURATION},? (?:please )?(?P<main>[^,;]+?),? {_UNTIL_SEEN}"
        ),
        re.compile(rf"(?:please )?(?P<main>[^,;]+?) every {EN_DURATION},? {_UNTIL_SEEN}"),
    ),
    poll_there="there is {until} in the {place}",
    spins=re.compile(
        r"(?:please )?(?:keep |slowly )*(?:turn|spin|rotat)(?:ing|e)?"
        r"(?: (?:a?round|slowly|on the spot))*"
        r"(?: (?:to the )?(?:left|(?P<right>right)))?(?: slowly)?,? (?:until|till) you (?:can )?"
        r"(?:see|find|spot) (?P<until>(?!no\b|nobody\b|not\b)[^,;]+)"
    ),
    spun_to="there is {until}",
    follows=re.compile(rf"(?P<main>.*\bfollow\b.+?) for {EN_DURATION}"),
    there=(
        (re.compile(r"\bgo(?: on)? in(?: there|side)?(?=$|[,;]| and\b| then\b)"), "go there"),
        (re.compile(r"\bgo inside(?=$|[,;]| and\b| then\b)"), "go there"),
        (
            re.compile(rf"\bgo and (?P<s>{_STOP})(?: (?:in|over|right))? there\b"),
            r"go there and \g<s> there",
        ),
        (
            re.compile(rf"(?<=\bthere and )(?P<s>{_STOP})(?: in there| over there|(?=$|[,;]))"),
            r"\g<s> there",
        ),
        (
            re.compile(rf"^(?:just )?(?P<s>{_STOP})(?: (?:in|over|right))? there\b"),
            r"go there and \g<s> there",
        ),
    ),
    inside=re.compile(r"(?P<rest>.*\b(?:is|are|see|[a-z]*one|[a-z]*body|people))(?: in)? there"),
    within=" in the ",
    tries=re.compile(
        rf"{_SO}(?:(?P<try>try )|(?P<look>check|search|look(?: a?round| for it)?(?: in| at| on)?"
        r"|(?:have|take) a (?:quick )?(?:look|peek)(?: a?round)?(?: in| at| on)?) )?"
        r"(?P<place>(?:the|my|our) [a-z]+(?: [a-z]+)?)(?: instead| too| as well| next| then)?"
    ),
    the="the ",
    search="find {thing} in {place}",
    look_there="look in {place}",
    informs=re.compile(
        rf"{_SO}(?:(?:tell|inform|notify|warn) (?P<who>{_ANOTHER})(?: (?:about it|so))?"
        rf"|let (?P<let>{_ANOTHER}) know)"
    ),
    news="tell {who} that {said}",
    wait_at="go to {at}",
    folk=_FOLK,
    mine=re.compile(r"^(?:the|my|our) "),
    hunts=(
        re.compile(
            rf"{_BEFORE}{_KEEP}(?:{_LOOKING}{_ROUND}*|{_MOVING}{_ROUND}+)"
            r"(?: for (?P<for>[a-z' -]+?))?"
            r"(?P<at> (?:in|on|around|through) (?:the|my|our) [a-z]+(?: [a-z]+)??)?"
            rf"{_ROUND}*{_FOUND}{_GO_ON}"
        ),
    ),
    any_hunted=re.compile(
        r"(?:him|her|it|them|one)|(?:.* )?(?:no|some|any|every|no ?one|nothing|something|anything"
        r"|all|everything|more|another|enough|both|two|three|four|five|six|where|what|out|how)"
        r"(?: .*)?"
    ),
    find="find {what}{at}",
    find_and="find {what}{at}, then {rest}",
    follows_until=re.compile(
        r"(?P<main>.*\b(?:follow|follow(?:ing)|come (?:along )?with|stay with|stay behind)\b .+?),?"
        r" (?:until|till) i (?:say|tell you(?: to)?|shout|ask you to)(?: that)? (?P<word>[^,;]+)"
    ),
    ends=re.compile(r"so|when|otherwise|to stop|stop it"),
    answers=ANSWERS,
    open_question=OPEN_QUESTION,
)
"""A bare "seven" is no time: whether in the morning or in the evening is not said."""
