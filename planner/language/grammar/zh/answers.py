"""Own the Chinese words of orders that hang on what somebody answers."""

from __future__ import annotations

import re

_IF = r"(?:如果|要是|假如|若是|万一)"
_WHO = rf"(?:{_IF}?(?:[他她]们?|我?(?:妈妈?|爸爸?|奶奶|爷爷|外公|外婆)|人家|大家)?{_IF}?)"
_SAYS = r"(?:说|回答|答)(?:的是)?"
_ECHO = r"(?P<echo>[^,。;就的不没说是他她如果]{1,3}?)"
_FIRM = r"(?:是|对|好|行|可以|要|想|需要|愿意|有|同意|嗯)"
_DONE = r"(?:的话,?[你您]?就?|,?[你您]?就|[的了啊呀],)"
_YES = rf"{_WHO}(?:{_SAYS}(?:{_FIRM}|%s)[的啊呀了]*|是的?|可以|行|同意|答应|{_ECHO}){_DONE}"
_NO = (
    rf"{_WHO}(?:{_SAYS}(?:不|没有?)(?:{_FIRM}|用|%s)?了?"
    rf"|不(?:是|行|可以|同意|用|{_ECHO})了?){_DONE}"
)
_ANY = r"[^,。;就的不没]{1,3}?"
_ASK = r"(?P<ask>(?:[^,;。]+,)?[^,;。]*?问[^,;。]{2,}?)[,;。?]+(?:然后|再)?"
_ORDER = r"(?P<then>.+?)"
_ELSE = r"(?:[,;。](?:(?:否则|不然|要不然)(?:的话)?,?[你您]?就?|%s)(?P<else>.+))?"


def _form(first: str, second: str) -> re.Pattern[str]:
    later = second.replace(_ECHO, _ANY) % _ANY
    return re.compile(_ASK + first % _ANY + _ORDER + _ELSE % later)


ANSWERS = ((True, _form(_YES, _NO)), (False, _form(_NO, _YES)))
OPEN_QUESTION = re.compile(
    r"是不是[^,]{0,2}[不没]|是否[不没]|[不没][^,]*吗"
    r"|什么|啥|谁|哪|几[点个时岁]|多少|怎么|为何|还是|何时|多[久大长]"
)
