"""Tell cheaply whether a sentence may be about standing orders, before any of their forms is tried.

A standing order holds a time, an event or one who comes; a word about those that are kept holds one
of these or the kind of thing that it lists, moves or drops. What holds none of them is about none.
"""

from __future__ import annotations

import re

from planner.language.folding import fold, has_chinese

_TIMES = (
    r"o?\d|every|each|daily|nightly|hourly|weekly|week\w*|month\w*|years?|fortnight|morning\w*"
    r"|evening\w*|afternoons?|(?:to)?nights?|noon|midday|midnight|to(?:day|morrow)|yesterday|\w*days?"
    r"|hour\w*|min(?:ute)?s?|sec(?:ond)?s?|o'?clock|half|quarter|time\w*|how long|until|till|later"
    r"|earlier|sooner|soon|before|after|once|moment|when\w*|if|unless|always|never|from now on"
    r"|any ?(?:more|longer)|one|two|three|four|five|six|seven|eight|nine|ten|eleven|twelve"
    r"|first|third|\w+fth|\w*(?:six|seven|nin|ten|elev|twentie|thirtie|teen|eigh)(?:th|enth)"
    r"|january|february|march|april|june|july|august|september|october|november|december"
    r"|dawn|dusk|sun(?:rise|set|down)|breakfast|lunch|dinner|supper|bedtime|christmas|easter|eve"
)
_KEPT = (
    r"re?mind\w*|wake|alarms?|timers?|\w*schedul\w*|standing|recurring|regular\w*|orders?|jobs?|tasks?"
    r"|chores|errands|duties|routines?|rules?|list|agenda|calendar|programme|planned|asked|given"
    r"|keeping|kept|supposed|stop|quit|cancel\w*|drop\w*|pause|skip|remove|delete|forget|scrap\w*"
    r"|ditch|clear|wipe|undo|rid|enough|no more|postpone|delay|snooze|things?|business"
)
_COMES = r"every(?:one|body)|any(?:one|body)|some(?:one|body)|whoever|visitors?|guests?"
_CONCERNED = re.compile(rf"(?<![a-z])(?:{_TIMES}|{_KEPT}|{_COMES})(?![a-z])")
_CONCERNED_ZH = re.compile(
    r"[\d点时分秒刻天周月年日晚早午夜次每逢号节等再先后前事单活列删停改别撤延挪推跳调换]"
    r"|半|星期|礼拜|钟|睡觉|多久|会儿|圣诞|国庆|元旦|除夕|提醒|记着|贪睡|任务|安排|计划|规矩|吩咐|交代"
    r"|取消|去掉|清[空除掉]|作废|免了|恢复|继续|照[常旧样]|不用|不要"
    r"|如果|要是|假如|万一|一旦|只要|除非|就|有人|看[见到]|没电|客人|来[人访]|[进敲]门"
)


def may_concern_orders(text: str) -> bool:
    """Return whether anything in a sentence may be of a standing order."""
    pattern = _CONCERNED_ZH if has_chinese(text) else _CONCERNED
    return pattern.search(fold(text)) is not None
