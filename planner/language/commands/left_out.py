"""Read which place a person leaves out of a round: "not the bathroom", 卧室就别进了. Pure.

Whole sentences, with a reason behind them at most. Whether an order goes to that place, and what is
left of it, is for the missions to say: by itself, "not the bathroom" leaves nothing out.
"""

from __future__ import annotations

import re

from planner.language.folding import fold_words, has_chinese

MAX_READ = 120
_ENDS = " .!,;:。~…，；！"
_LEAD = (
    r"(?:(?:no|oh|ok|okay|well|but|and|also|wait|hang on|sorry|actually|please|just|only|robot"
    r"|pons|hey|by the way)[ ,.!;]+)*"
)
_PLACE = (
    r"(?P<{}>(?:(?:the|my|our|his|her|their) |[a-z]+'s )?"
    r"(?:(?!\b(?:if|unless|until|till|when|and|or|but|then|because|since)\b)[a-z' -]){{2,30}}?)"
)
_IN = r"(?:(?:in|into|to|inside|at|through|round) )"
_VISITS = (
    r"(?:go(?:ing)? (?:in|into|to|inside|through)|driv(?:e|ing) (?:in|into|to|through)"
    r"|look(?:ing)? (?:in|into|inside|round)|check(?:ing)?(?: in)?|search(?:ing)?(?: in)?"
    r"|visit(?:ing)?|enter(?:ing)?|do(?:ing)?|try(?:ing)?|inspect(?:ing)?)"
)
_CAN = r"(?:you (?:can|could|may|might)(?: (?:as well|just))? |just )?"
_OMITS = (
    r"(?:skip|omit|ignore|leave out|miss out|pass over"
    r"|(?:stay|keep) (?:out of|away from|clear of))"
)
_SUBJECT = (
    r"(?:i|we|he|she|it|they|there|that|somebody|someone|nobody|no one"
    r"|(?:the|my|our|his|her) [a-z]+(?: [a-z]+)?|[a-z]+(?=')|mum|mom|dad|grandma|grandpa)"
)
_NO_REASON = (
    r"(?:if|unless|until|till|when|but|instead|then|so|please|you|or|go|drive|come|look|check"
    r"|find|search|try|turn|tell|ask|say|wait)"
)
_REASON = (
    rf"(?:(?:[,;.!:]| because| since| as)+ (?:because |since |as )?"
    rf"(?!.*\b{_NO_REASON}\b){_SUBJECT}(?:'s|'re|'ve|'m|'d|'ll| [a-z]+)\b[a-z' ]*)?"
)
_TAIL = (
    r"(?:[ ,]+(?:though|please|this time|today|for now|thanks|thank you|then|ok|okay|at all"
    r"|any ?more|any longer))*"
)
_LEFT_OUT = re.compile(
    rf"{_LEAD}(?:not {_IN}?{_PLACE.format('a')}"
    rf"|{_CAN}{_OMITS} {_PLACE.format('b')}"
    rf"|{_CAN}leave {_PLACE.format('c')} out(?: of it)?"
    rf"|(?:don't|do not)(?: bother)? (?:with|about|{_VISITS}) {_PLACE.format('d')}"
    rf"|(?:you (?:don't|do not) (?:need|have) to|you needn't|(?:there(?:'s| is) )?no need to"
    rf"|(?:there(?:'s| is) )?no point(?: in)?) {_VISITS} {_PLACE.format('e')}"
    rf"|never ?mind(?: about)? {_PLACE.format('f')}"
    rf"|(?:all |everywhere )?(?:but not|except(?: for)?|apart from|without|not including)"
    rf" {_IN}?{_PLACE.format('g')}){_TAIL}{_REASON}{_TAIL}"
)
_LEAD_ZH = r"(?:[哎哦噢啊诶嗯欸]|那个?|不过|但是?|对了|等等|等一下|,)*"
_PLACE_ZH = r"(?:我们?的)?(?P<{}>[^,。;别不甭无免你我]{{1,8}}?)(?:那边|那儿|那里|里面?|那间)?"
_NO_ZH = r"(?:别|不用|不要|不必|甭|无需|不需要|用不着|没必要)"
_VISITS_ZH = r"(?:进|去|看看?|找找?|查看?|数|巡[逻视查]?|管|走|转|检查|搜)"
_END_ZH = r"(?:了|吧|哈|啊|呀|哦)*"
_NO_REASON_ZH = (
    r"(?:如果|要是|[去到](?!过)|改|换(?!衣|鞋|尿|药|洗)|先|来(?!过)|你|找(?!过)"
    r"|看(?!过|书|电视)|而是|是[^我])"
)
_REASON_ZH = rf"(?:,(?:因为)?(?!.*{_NO_REASON_ZH})[^,。;]{{2,16}})?"
_LEFT_OUT_ZH = re.compile(
    rf"{_LEAD_ZH}(?:{_PLACE_ZH.format('a')}(?:就|先|可以|也)*(?:{_NO_ZH}(?:再)?{_VISITS_ZH}"
    rf"(?:去|它|一遍|一下)*|不用(?=了)|免(?=了)|算(?=了)|跳过|除外)"
    rf"|你?(?:就|先|可以)*{_NO_ZH}(?:再)?(?:进|去|到|看|找|查|数|巡|检查|管){_PLACE_ZH.format('b')}"
    rf"(?:里|去|看|找)*"
    rf"|你?(?:就|先|可以)*(?:跳过|略过|避开|不包括){_PLACE_ZH.format('c')}(?:别去|不去)?"
    rf"|除了{_PLACE_ZH.format('d')}(?:以外|之外)?){_END_ZH}{_REASON_ZH}{_END_ZH}"
)


_ABSENT = re.compile(
    rf"{_LEAD}(?:(?:i (?:know|think|am sure|'m sure) )?(?:it|he|she|they"
    rf"|there(?='s nobody|'s no one))(?:'s not|'re not| is not| are not| isn't| aren't"
    rf"|'s nobody|'s no one)"
    rf" {_IN}{_PLACE.format('a')}(?: either)?){_TAIL}{_REASON}{_TAIL}"
)
_ABSENT_ZH = re.compile(
    rf"{_LEAD_ZH}(?:[它他她]们?)?(?:肯定|应该|也)*不(?:会)?在{_PLACE_ZH.format('a')}{_END_ZH}{_REASON_ZH}"
)
_DENIED = re.compile(
    rf"{_LEAD}(?:not {_IN}?{_PLACE.format('a')}|i (?:(?:didn't|did not) (?:say"
    rf"|mean|want|ask for)|never (?:said|meant|wanted|asked for))"
    rf" {_IN}?{_PLACE.format('b')}){_TAIL}{_REASON}"
)
_DENIED_ZH = re.compile(
    rf"(?:{_LEAD_ZH[:-1]}|不对|不(?!过|对)|错了)*(?:我(?:说|要|指|想要?去)的?)?(?:不是|没说|没让你)"
    rf"(?:去|到)?{_PLACE_ZH.format('a')}(?:呀|啊|吧|哦)*{_REASON_ZH}"
)


def read_absent_place(text: str) -> str | None:
    """Return the words for the place where what is sought is said not to be."""
    return _read(_ABSENT, _ABSENT_ZH, text)


def read_denied_place(text: str) -> str | None:
    """Return the words for the place that a person says was not meant."""
    return _read(_DENIED, _DENIED_ZH, text)


def read_left_out(text: str) -> str | None:
    """Return the words for the place that a sentence leaves out; None where it leaves none out."""
    return _read(_LEFT_OUT, _LEFT_OUT_ZH, text)


def _read(english: re.Pattern[str], chinese: re.Pattern[str], text: str) -> str | None:
    said = fold_words(text).replace("’", "'").strip(_ENDS)
    if not 0 < len(said) <= MAX_READ or text.rstrip().endswith(("?", "？")):
        return None
    if has_chinese(said):
        said = re.sub(r"[，。；]", ",", "".join(said.split()))
    found = (chinese if has_chinese(said) else english).fullmatch(said)
    return next((words for words in found.groups() if words), None) if found is not None else None
