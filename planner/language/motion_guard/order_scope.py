"""Part an order's words into what is to be done and what is not: denied, on condition, or quoted.

A name that stands only in "don't go to the kitchen", in "if it rains, go to the kitchen" or in "say
that the keys are in the kitchen" sends nobody there. In doubt a part counts as not to be done: the
price is one question to a person. Linear in the length of the text, up to ``MAX_READ``.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache

from planner.language.motion_guard.mentioned_names import plain

MAX_READ = 400
"""Characters; what stands behind them asks for nothing."""
_GAP = " | "
"""Stands in for what was cut, so that no words meet that were apart."""

_SPEAK = (
    r"\b(?:say|saying|tell|announce|inform|shout|whisper|repeat|remind|ask|greet|read|answer|reply"
    r"|know)\b"
)
_THEN = (
    r"(?=[.;!?]|,? (?:and )?then\b|(?:,| and) (?:come|go|return|drive|after)\b"
    r"|, (?:he|she|they)(?:'s|'re| is| are) (?:in|at|on|by)\b|$)"
)
_SPEECH = re.compile(
    rf"{_SPEAK}[^.;!?\"“”「」『』]{{0,60}}?(?:[\"“「『][^\"”」』]*[\"”」』]?"
    rf"|(?:\bthat\b|\bwhether\b|\bif\b|: *[^ ]+).*?{_THEN}"
    rf"|(?<=say) (?:please )?(?:go|drive|come|turn|follow|move|run|stop)\b.*?{_THEN})"
    r"|(?:说|喊|问|念|告诉|转告|通知|提醒|回答)[^。；！？!?;“”\"「」『』]{0,12}?"
    r"(?:[“\"「『][^”\"」』]*[”\"」』]?|[:：].*?(?=[。；;!！]|然后|再|$))"
    r"|(?<![听据])说(?!一声|一下|明|的).*?(?=[,，。；;!！]|然后|再|$)"
    r"|(?:告诉|转告|通知|提醒)(?![我我们]).*?(?=[,，。；;!！]|然后|再|$)"
)

_QUOTED = re.compile(r"[“\"「『][^”\"」』]*[”\"」』]?")
_SPEAKS = re.compile(rf"{_SPEAK}|[说喊问念叫]|告诉|转告|通知|提醒|回答")

_NO_DENIAL_ZH = re.compile(
    r"特别|别墅|分别|级别|性别|识别|类别|差别|不错|差不多|不锈钢|不好意思|对不起|了不起|不客气"
    r"|休息|免费|多少|不对|不少|至少|([^\s,.])[不没]\1|是否|能否|可否"
    r"|(?<=[^\s,，。;；!！你您千万请])别(?:动|走|停)(?=$|[,，。;；!！])"
)
_DENY_EN = re.compile(
    r"\b(?:do not|don't|dont|never|must not|mustn't|may not|should not|shouldn't|ought not"
    r"|you cannot|you can't|no need to|no reason to|need not|needn't|avoid|refrain|forget"
    r"|under no circumstances|no longer|not|except|excepting|excluding|without|skip|skipping"
    r"|instead of|rather than|apart from|other than|besides|omit|leave out|leaving out"
    r"|(?:stays?|keep|get) (?:out|away)"
    r"|off limits|(?:anywhere|everywhere|rooms?|everything|places?) but|but not|nor|neither)\b"
)
_ALLOWED_BEFORE = re.compile(
    r"(?:\b(?:why|is|was|are|were|if|or|could|did|does|has|have|had|would|you) |'d )$"
)
_ALLOWED = re.compile(
    r"(?:not only|not (?:too|so|very|that)\b|(?:don't|do not) (?:forget to|mind|worry|hesitate)"
    r"|not sure|not far|dont worry|forget that\b|forget it\b|skip it\b)"
)
_DENY_END_EN = re.compile(r"[,.;!?:]|\b(?:but(?! not)|then|only|and then|just)\b")
_EXCEPTION = re.compile(
    r"except|exclud|without|skip|instead|rather|apart|other than|besides|omit|leav|.* but$|but not"
    r"|not$"
)
_GOES_ON = re.compile(
    r" and (?=(?:then |also )?(?:go|count|find|look|tell|come|check|wait|say|return|see|drive)\b)"
)
_BARE_DENIAL = re.compile(
    r"\W*(?:你|please |just )?(?:不许|别|不要|不准|不用|禁止|不能|don't|do not|never)(?: ?再)?"
    r" ?(?:去|进|过去|进去|走|动|go there|go|do it|enter)了?\W*"
)
_NEXT_NAME = re.compile(r"[,;]?\s*(?:(?:or|nor|and|neither)\b|(?:the|my|our|your) [a-z]+ ?[a-z]*$)")
_DENY_ZH = re.compile(
    r"别|不要|不用|不必|不许|不准|不能|不可|不该|不得|禁止|严禁|切勿|勿|甭|莫|不去|不进"
    r"|(?<![找看见听收想])不到|不是|不想"
    r"|没必要|谁[让叫]|离.{1,8}远|不让|除|避开|绕开|绕过|跳过|排除|没有.{0,6}允许|唔好|唔使"
)
_CLAUSE_ZH = re.compile(r"([,，。；;！!？?]|而是|但是|但|然后|改去|改成|(?<!不)是(?=去))")

_POLITE = re.compile(
    r"(?:appreciate it|be (?:nice|great|good|lovely)|grateful|thank you|thankful) if you\b"
    r"|\bif (?:possible|you please|you (?:would|could|can|like|want|don't mind|do not mind))\b"
    r"|\b(?:see|check|find out|tell me|know|look|ask|wonder|whether|say|report) (?:\w+ ){0,3}?if\b"
    r"|\bwhen (?:you (?:get|are|arrive|reach|have|come)|done|finished|there)\b"
    r"|\bonce you\b|\bas if\b"
)
_FALLBACK = re.compile(
    r"\b(?:if (?:you |it |that |this )?(?:can't|cannot|can not|couldn't|fails?|is (?:blocked|closed"
    r"|shut|locked|not possible)|doesn't|does not|do not find|don't find|find nothing|not\b)"
    r"|otherwise|or else|failing that)"
    r"|(?:如果|要是|若)(?:去|进|到|过|找|看|开)不(?:了|去|到|见|着)"
    r"|(?:去|进|到|过|找|看|开)不(?:了|去|到|见|着)(?:的话|[,]?就)|不行的?话|否则|要不然|实在不行"
)
_CONDITION = re.compile(
    r"\b(?:if|unless|whenever|when|as soon as|in case|provided|only if|until|tomorrow|tonight"
    r"|every (?:day|morning|evening|night|hour|week)|at (?:\d|noon|midnight)|in \d+ minutes?|later"
    r"|next time)\b"
    r"|如果|要是|假如|万一|只要|除非|一旦|每当|若(?!干)|的话|只有|明天|今晚|每天|每晚"
    r"|等会儿?(?!儿?再见)"
    r"|当.{1,12}时|等(?!.{0,6}[秒分]).{1,12}[了完好后]再"
)
_CLAUSE = re.compile(r"[,.;!?。；！？]")
_CONNECTS = re.compile(
    r"[.;!?。；！？]|\band (?=if\b|when\b)|[,，](?=(?:如果|要是|若|万一|假如).{1,20}[就则便])"
)

_NO_ORDER = re.compile(
    r"\b(?:yesterday|i was|i went|i came|i have been|you were|(?<!if )you went|what would)\b"
    r"[^.;!?]*"
    r"|(?:^|[,.;!?] ?|\band )(?:please |just )?"
    r"(?:knock|push|pull|kick|throw|drop|smash|spill|shake)\b[^,.;!?]*|(?:昨天|前天|上次)[^。]*"
    r"|\b(?:did|were|was) (?:you|we|i|it|he|she|they|any\w+|some\w+)\b[^.;!?]*"
    r"|\b(?:have|had) you (?!seen)[a-z]+[^.;!?]*"
    r"|你(?:刚才|之前|已经)?[^,，。]{0,6}?(?:找到|去过|数到|到过)[^。]*"
)


@dataclass(frozen=True, slots=True)
class OrderScope:
    """Hold the parts of an order that count, in lower case and plain writing."""

    ordered: str
    """What is to be done now, without what is denied, on condition, told to others or past."""
    upon: str
    """The same with what is to be done upon a condition: for who has looked or asked first."""
    things: str
    """What may name a thing: all but what is denied; speech names who is spoken to."""
    excluded: str
    """What is denied."""


@lru_cache(maxsize=64)
def read_scope(text: str) -> OrderScope:
    """Return the parts of an order that count. Never raises."""
    said = plain(text)[:MAX_READ]
    if any(_BARE_DENIAL.fullmatch(clause) for clause in _CLAUSE.split(said)[1:]):
        return OrderScope("", "", "", said)  # "the kitchen? Don't go there": nothing is to be done
    speechless = _NO_ORDER.sub(_GAP, _SPEECH.sub(_GAP, _unquote(said)))
    upon, excluded = _cut_denials(speechless)
    things, _ = _cut_denials(said)
    return OrderScope(_cut_conditions(upon), upon, things, excluded)


def _unquote(said: str) -> str:
    """Cut what is quoted after a word of speech, whatever stands in it."""
    return _QUOTED.sub(
        lambda found: _GAP if _SPEAKS.search(said, 0, found.start()) else found[0], said
    )


def _cut_denials(said: str) -> tuple[str, str]:
    kept, excluded = _cut_english(said)
    if re.search(r"[\u3400-\u9fff]", kept):
        kept, more = _cut_chinese(kept)
        excluded = f"{excluded} {more}"
    return kept, excluded


def _cut_english(said: str) -> tuple[str, str]:
    kept: list[str] = []
    excluded: list[str] = []
    at = 0
    while (found := _DENY_EN.search(said, at)) is not None:
        before = said[max(0, found.start() - 12) : found.start()]
        if _ALLOWED.match(said, found.start()) or _is_said_of_facts(found[0], before):
            kept.append(said[at : found.end()])
            at = found.end()
            continue
        kept.append(said[at : found.start()])
        end = _end_of_denial(said, found)
        excluded.append(said[found.start() : end])
        at = end
    return _GAP.join([*kept, said[at:]]), " ".join(excluded)


def _is_said_of_facts(word: str, before: str) -> bool:
    """Tell whether "not" denies no order: "I could not find it", "why don't you"."""
    return word in {"not", "don't", "do not"} and _ALLOWED_BEFORE.search(before) is not None


def _end_of_denial(said: str, denial: re.Match[str]) -> int:
    """Return where a denial ends: with its clause, and a list that goes on behind it.

    An exception ends before a further order, too: "every room except the study and come back".
    """
    end = denial.end()
    if _EXCEPTION.match(denial[0]) is not None:
        ends = (_DENY_END_EN.search(said, end), _GOES_ON.search(said, end))
        return min((found.start() for found in ends if found is not None), default=len(said))
    while True:
        found = _DENY_END_EN.search(said, end)
        if found is None:
            return len(said)
        rest = said[found.end() :]
        cut = _DENY_END_EN.search(rest)
        chunk = rest if cut is None else rest[: cut.start()]
        if found[0] != "," or not _NEXT_NAME.match(chunk.strip()):
            return found.start()
        end = found.end()


def _cut_chinese(said: str) -> tuple[str, str]:
    bare = _NO_DENIAL_ZH.sub(lambda found: "　" * len(found[0]), said)
    kept: list[str] = []
    excluded: list[str] = []
    at = 0
    for cut in [*_CLAUSE_ZH.finditer(bare), None]:
        end = len(said) if cut is None else cut.start()
        clause = said[at:end]
        (excluded if _DENY_ZH.search(bare[at:end]) else kept).append(clause)
        if cut is not None:
            kept.append(cut[0])
            at = cut.end()
    return "".join(kept), " ".join(excluded)


def _cut_conditions(said: str) -> str:
    """Cut what stands on a condition; from a fallback ("if you can't") on alone what follows."""
    fallback = _FALLBACK.search(said)
    if fallback is not None:
        said = said[: fallback.start()]
    polite = [(m.start(), m.end()) for m in _POLITE.finditer(said)]
    for found in _CONDITION.finditer(said):
        if any(start <= found.start() < end for start, end in polite):
            continue
        before = [m.end() for m in _CONNECTS.finditer(said) if m.end() <= found.start()]
        after = _CONNECTS.search(said, found.end())
        rest = said[after.end() :] if after is not None else ""
        return f"{said[: max(before, default=0)]}{_GAP}{_cut_conditions(rest)}"
    return said
