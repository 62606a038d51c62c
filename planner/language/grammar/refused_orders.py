"""Own the orders that are refused for what they would do, each with the rule that it breaks.

Words alone: the bridge guards the robot whatever was said. This only tells a person why not.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from planner.language.catalogue import say
from planner.plan import Bilingual


@dataclass(frozen=True, slots=True)
class Ban:
    """Hold one rule, and the words of both languages by which an order breaks it."""

    rule: Bilingual
    pattern: re.Pattern[str]


def _ban(rule: str, *patterns: str) -> Ban:
    return Ban(say(rule), re.compile("|".join(patterns)))


_GUARDS = (
    r"(?:obstacles?|walls?|people|safety|sensors?|lidar|laser|bumpers?|fence|limits?|bridge|"
    r"brakes?|"
    r"collisions?|protective stop|e-?stop|watchdog)"
)
TAMPERING = _ban(
    "rule.guards",
    rf"\b(?:ignore|disable|override|bypass|switch off|turn off|deactivate|unplug|cover|remove|skip|"
    rf"forget(?: about)?|disregard|do not (?:mind|avoid)) (?:all |any |the |your )*"
    rf"(?:[a-z]+ )?{_GUARDS}\b",
    r"\bwithout (?:stopping|braking|looking|slowing)\b",
    r"(?:忽略|无视|关闭|关掉|禁用|屏蔽|绕过|取消|解除|拆掉|不管|不要管|别管)(?:所有|一切|你的|"
    r"掉)?(?:的)?"
    r"(?:障碍|墙|人|安全|传感器|雷达|激光|保险杠|防撞|碰撞|围栏|限速|限制|急停|刹车|保护)",
)
"""Told ahead of "not": "don't mind the obstacles" is no plain no."""
HARM = (
    _ban(
        "rule.harm",
        r"\b(?:hit(?! the (?:road|sack|hay)\b)|ram|crash|attack|kick|hurt|harm|"
        r"kill(?! the (?:lights?|power|music|tv|sound)\b)|"
        r"smash|stab|punch|injure|bump|chase|scare|frighten|"
        r"crush|squash|trip (?:him|her|them|the|a|my)|knock (?:down|over|out)|poke|slap|bully|"
        r"threaten|burn|poison|drown|"
        r"(?:run|drive|roll) over(?! (?:to|there|here|and)\b)|run into(?! the [\ue000-\ue7ff])|"
        r"(?:run|drive|crash|bump|slam) into (?:the |a |my |that |this )?(?:\w+ )?"
        r"(?:wall|door|dog|cat|person|people|man|woman|child|kid|baby|glass|window|mirror|vase|me|"
        r"him|her|them)|"
        r"push (?:\w+ ){1,3}(?:down|over|off|out)|break (?:the|a|that|this|my) |destroy|"
        r"set (?:\w+ ){0,3}on fire|spy on|trap|lock (?:\w+ ){1,2}(?:in|up))\b",
        r"撞|碾|轧|压过|踢|打人|打他|打她|打翻|打碎|追赶|追着|追上|吓|伤害|攻击|杀|冲向|冲撞|推倒|"
        r"绊倒|砸|(?<!发)烧(?!水|饭|菜|茶)|"
        r"毁|弄坏|监视|偷窥|跟踪(?!球)",
    ),
    _ban(
        "rule.way_out",
        r"\bblock (?:the|a|my|every|all) |\b(?:barricade|obstruct)\b",
        r"堵住|堵在|挡住(?:门|路|出口|他|她|人)|封住",
    ),
    _ban(
        "rule.level_floor",
        r"\b(?:(?:down|up|off|over|onto|climb|take) (?:the |a )?(?:stairs?|staircase|steps|ledge|"
        r"edge|balcony|"
        r"cliff|kerb|curb|escalator)|(?:into|in) (?:the )?(?:pool|water|fire|pond|river|bathtub|"
        r"lake))\b",
        r"(?:下|上|爬)楼(?:梯)?|楼梯(?:上)?(?:开|冲|滚|爬|走)|(?:冲|开|掉)(?:下|进|到)(?:楼梯|水|"
        r"泳池|池塘|火)|跳下",
    ),
)


def broken_rule(text: str) -> Bilingual | None:
    """Return the rule that an order would break, or None."""
    return next((ban.rule for ban in HARM if ban.pattern.search(text)), None)
