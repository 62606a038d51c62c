"""Leave out the reason that stands beside a word about standing orders: ", I've finished the course".

Pure, on folded text. Law: a clause that orders, denies, excepts or hangs something on something is
no reason, and of the clauses one alone may be none.
"""

from __future__ import annotations

import re

_CUT = re.compile(r"\s*(?:[,;!.。，；！]+(?!\d)|\s[-–—]+\s|—+)\s*")
_MOST = 3
_ORDERS = re.compile(
    r"\b(?:if|when|whenever|unless|until|till|except|but|or|instead|then|don't|do not|never|not to|please"
    r"|go|come|drive(?! (?:me|us|him|her|them) (?:mad|crazy|nuts|up the wall))|tell|say|ask|remind|wake|check|find|look|make|move|change|cancel|scrap|forget"
    r"|keep|remember|stop|only|just|wait|follow|let|leave|at (?:\d|noon))\b"
)
_STATES = re.compile(
    r"(?:because |since |as |cos |'cause |and )?(?:i(?:'m|'ve|'ll|'d)?|we(?:'re|'ve|'ll)?|they(?:'re|'ve|'ll)?"
    r"|he(?:'s)?|she(?:'s)?|it(?:'s|'ll)?|that(?:'s)?|there(?:'s)?"
    r"|(?:the|my|our) [a-z]+(?: [a-z]+)?(?: (?:is|are|was|has|have|will|can|comes?|came|sleeps?)|'s))\b.*"
    r"|(?:the (?:whole )?lot|all of (?:them|it)|every (?:single|last) one|thanks?(?: you)?|of course|obviously)"
)
_ITS_VERB = re.compile(
    r"^(?:because |since |as |cos |'cause |and )?(?:i|we|they|he|she|it|that)(?:'ll|'d| will| would) (?!be\b)[a-z]+"
)
"""What somebody or something will do: "it'll drive us mad" orders no drive."""
_WHILE = re.compile(
    r"(?:when|once|because|since|as) (?:the |my |our )?(?:[a-z]+|everybody|everyone)(?: (?:is|are|was)|'s|'re|'m)?"
    r" (?:back|home|asleep|in bed|up|awake|out|there|in|away|working|sleeping|at (?:work|school|home))"
)
"""When that is, said of a time that is known."""
_ORDERS_ZH = re.compile(
    r"如果|要是|的话|除非|不然|否则|但|不过|只|别|不要|不用|提醒|[叫喊告]|记|改|取消|删|换|推迟|提前|帮|请|去|回|找|看|说|讲|[吗呢?]|什么|哪|谁"
    r"|周|星期|每|[点:]\d|点[钟半]?$"
)
_STATES_ZH = re.compile(
    r"(?:因为)?(?:我们?|他们?|她们?|孩子|宝宝|小孩|会|怕|不然|太|已经|都|今天|那|起|睡|来|吃|已|人|有|没|赶|忙).{0,12}"
    r"|全部|统统|一个不留|都不要了?|当然|(?:放|快|要|刚|正)?(?:暑假|寒假|假期|放假|假).{0,4}"
    r"|(?:[零一二三四五六七八九十两\d]{1,3}点(?:半|钟|多)?)?[^,]{1,14}(?:了|呢|啦|着|完|得很)"
)
_STILL = re.compile(r"(?<=[完着了好])呢$")
_SAID_BY = re.compile(
    r"^(?:医生|大夫|老师|学校|爸爸|妈妈|爷爷|奶奶|老板|[他她]们?)(?:都|也|已经)?(?:说|讲)(?:了|过)?(?=.)"
)


def leave_reasons_out(folded: str, *, chinese: bool) -> str | None:
    """Return the one clause of a sentence that is no reason; None where it has none, or several."""
    clauses = [each for each in _CUT.split(folded) if each]
    if not 2 <= len(clauses) <= _MOST:
        return None
    left = [each for each in clauses if not is_reason(each, chinese=chinese)]
    return left[0] if len(left) == 1 else None


def is_reason(clause: str, *, chinese: bool) -> bool:
    """Tell whether a clause says why, or how things stand, and orders nothing."""
    if chinese:
        told = _STILL.sub("", _SAID_BY.sub("", clause))
        return _ORDERS_ZH.search(told) is None and _STATES_ZH.fullmatch(clause) is not None
    if _WHILE.fullmatch(clause) is not None:
        return True
    states = _STATES.fullmatch(clause) is not None
    return states and _ORDERS.search(_ITS_VERB.sub("", clause)) is None
