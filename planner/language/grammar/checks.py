"""Check a sentence for reasons not to take it as an order: denials, vetoes, harm.

- Words that deny, except or switch off. Where one stands, nothing is offered: "go to every room but
  the kitchen" must not be answered with "did you mean: go to the kitchen?". In doubt a sentence
  denies. What is *told* as a denial is only the part that surely says what is not to be done.
- Vetoes are broad: in doubt nothing moves. What is told is narrow: "you denied it", "I can't check
  the condition" or "speeds are not mine" is said of the very part that surely is that.
- Orders refused for what they would do, each with its rule. Words alone: the bridge guards the
  robot whatever was said; this only tells a person why not.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from re import Pattern

from rapidfuzz.distance import OSA

from planner.language.catalogue import say
from planner.language.grammar.lexicon import MARK
from planner.plan import Bilingual, Code

_COMPOUNDS = re.compile(
    r"不锈钢|差不多|不好意思|对不起|了不起|不客气|不用谢|不错(?!过)|"
    r"没(?:关系|事|错|有?问题)|特别|别墅|分别|级别|"
    r"性别|识别|类别|非常|莫名|除夕"
)
"""Words that hold a character of denial and deny nothing."""
_ASKS = re.compile(r"([^\s,.;!?。])[不没]\1|(?<=[是能可])否")
"""能不能, 有没有, 是否: a question, no denial."""

_THE = r"(?:(?:the|my|our|your|a|that|this) )?"
_INTO = r"(?:(?:in|into|to|at|near|on|by|for|from) )*"
_REST = r"[^,.;!?]*"
_BUT = (
    rf"(?:(?<=room)|(?<=rooms)|(?<=place)|(?<=places)|(?<=house)|(?<=home)|(?<=where)|(?<=thing)|"
    rf"(?<=\bany)|(?<=\ball)|(?<=\bnone)|(?<=one)|(?<=body)),? but\b(?! (?:first|before|then|after|"
    r"come|go|wait|only)\b)"
    rf"|\bbut {_INTO}{_THE}{MARK}(?! first)"
)
EXCEPTIONS_EN = (
    rf"{_BUT}|\b(?:exclud(?:e|ed|es|ing)|excepting|exempt|aside from|besides|save for|"
    r"omit(?:ting)?|minus|leav(?:e|ing) out|pass over|steer clear|off limits|out of bounds|"
    r"no longer|hold off|banned|barring)\b"
)
EXCEPTIONS_ZH = (
    r"甭|[唔毋休](?=[好使要得可准系想])|(?<!猫)咪(?=[去入到行过走返嚟来开再同搞])|千祈|之外|"
    rf"以外|{MARK}外(?=[都全其的,]|$)|(?<![多至])少(?=[去来往到进])|排除|[跳略]过|不包括|撇开"
)
"""Denials beside those that the grammars name; with them they veto a sentence."""

_TAMPERING = (
    r"\b(?:turn|switch|shut|power|cut)(?:ed|s|ing|ting)?\b(?: [^\s,.;!?]+){0,5}? (?:off|down)\b"
    r"|\b(?:close|seal|block|fence|rope)\w* off\b|\b(?:kill|mute|delete|erase|nix)\b"
    r"|\b(?:disabl|deactivat|dismantl|disconnect|unplug|uninstall|overrid|bypass)\w*\b"
    r"|关(?:掉|闭|上|了|机|[灯门])|断[电开]|停用|禁用|屏蔽|拔|拆|解除|绕过"
)
_LEAVING = (
    r"\b(?:leave|leaving|exit|exiting|depart|vacate|evacuate|flee|escape|enough of)\b"
    r"|\b(?:run|walk|drive|move|back|hide|come|stay|roll) (?:\w+ )?from\b"
    r"|\b(?:go|get|come|move|drive|walk|roll|stay|step|run|keep|head|back|be)\b[^,.;!?]{0,24}? "
    r"(?:out|away)\b|\bstop(?:s|ped|ping)? \w+ing\b|\bquit\b"
    r"|离开|(?<![拿取搬端找看说发想])出[来去]|走开|[滚躲撤]|退[出开]|让开|远离"
)
_DENIALS = (
    r"\b(?:not|no|none|never|nobody|nowhere|nothing|neither|nor|without|except|avoid|instead|"
    r"ignore|forget|skip|cancel|abort|undo|refrain|refuse|other than|rather than|apart from|"
    r"far from|cannot|unable|stay out|stay off|hardly|wrong|forbidden|prohibited|alone|"
    r"exception|bar|save|sans)\b|\bd\W?o\W?n(?!e\b)\w*|\bdnt\b"
    r"|\w+n't\b|\b(?:do|does|did|is|are|wo|ca|should|must|would|could)nt\b"
    r"|[别不勿莫没无未甭唔毋禁拒除休免冇]|止步|表(?=[去到进])|免得|省得|取消|停止|忘|算了|代替|而是|休想"
)
_WITHHOLDS = re.compile(f"{EXCEPTIONS_EN}|{EXCEPTIONS_ZH}|{_TAMPERING}|{_LEAVING}|{_DENIALS}")

_WORD = re.compile(r"[a-z]{4,}")
_SLIPS_OF = ("never", "except", "without", "avoid", "cannot", "disable", "leave", "excluding")
_NO_SLIPS = frozenset({"ever", "fever", "lever", "sever", "leaves", "cleave"})

_HEAD = (
    r"(?:^|[,.;!?:。、] ?|\b(?:you|please|pls|robot|pons|but|and|then|so|ok|okay|hey|also|just|"
    r"now|well) )"
)
_NO_ORDER = (
    r"(?! (?:forget|worry|mind|hesitate|fail|bother|panic|miss|be (?:afraid|shy)|you (?!dare)|we|i|"
    r"they|know|care)\b)"
)
_DENIES_EN = re.compile(
    rf"{_HEAD}(?P<order>(?:(?:do|must|should|may|shall|need) not"
    r"|(?<=you )(?:can|are|will) not"
    rf"|(?:do|must|should)nt|never|don\W*t)\b{_NO_ORDER}{_REST})"
    r"|(?<!is )(?<!are )(?<!am )(?<!was )(?<!were )(?<!if )(?<!why )(?<!whether )(?<!or )"
    r"(?<!i )(?<!did )(?<!would )(?<!could )(?<!have )(?<!had )"
    rf"(?P<not>\bnot (?:(?:yet|now|even|ever|go|going|drive|enter) )*{_INTO}{_THE}{MARK}{_REST})"
    r"|(?P<except>\b(?:except|other than|rather than|instead of|apart from|skip|avoid|refrain|"
    r"stay (?:out|away|off)|keep (?:out|off|away|clear)|by no means|under no circumstances|"
    r"neither|nor|without (?:going|entering|visiting|passing|touching|waking)|do nothing|"
    r"go nowhere|no (?:going|entry|entering|driving|visiting)|"
    rf"leave (?:it|them|him|her|me|everything) alone|exclud(?:e|ed|ing)|excepting|exempt|"
    rf"aside from|save for|omit(?:ting)?|leav(?:e|ing) out|steer clear|barring)\b{_REST})"
    rf"|(?P<about>\b(?:forget|ignore|without)(?: about)? {_THE}{MARK}{_REST})"
    rf"|(?P<but>(?:{_BUT}){_REST})|{_HEAD}(?P<undo>(?:cancel|abort|undo)\b{_REST})"
    rf"|(?P<bare>^(?:no|nope|no thanks?(?: you)?|not now|never|not yet|not)(?=[.! ]*$))"
    rf"|(?P<off>(?:^|(?<=[,.;!?]))(?! ?(?:is|are|was|were|why)\b)"
    rf"{_REST}\b(?:forbidden|prohibited|off limits|out of bounds|"
    r"not (?:allowed|permitted|to be (?:visited|entered)))\b)"
    r"|(?P<tail>\bdo not$)"
)
_DENIED_CLAUSE = re.compile(r"[^,.;!?。、]+")
_DENIES_ZH = re.compile(
    r"(?P<except>[^,.;!?。、]*除外|除(?!非|[草湿霜臭垢味法名])(?:了|开|去)?.*?(?:(?=[都全其])|之外|以外|外|$)"
    rf"|[^,.;!?。、]*(?:之外|以外|{MARK}外))"
    r"|(?P<order>别(?!的|人|处|忘|客|担|怕|着急|急|紧|介意)"
    r"|不(?:要(?!紧)|用(?![说客担急着谢管])"
    r"|[许准允必得能去该让进]|(?<![找看见听够想等碰摸]不)到(?![\d一二两三四五六七八九十几半])|可(?:以|(?=[去进到]))|应)|勿|莫(?!非)|禁止|甭|唔(?:好|使|要|准|可)|"
    r"(?<!猫)咪(?=[去入到行过走返])|千祈|无需|避免|避开|绕开|拒绝|取消|"
    r"(?<![多至])少(?=[去来往到进])|排除|[跳略]过|不包括|^算了吧?$)"
)
_TELLS_ZH = re.compile(
    r"[我他她它](?:们|妈|爸)?(?:现在|还|也|都)?(?:[不没别勿莫]|避|无)|(?:为什么|怎么|干嘛|何)(?:还)?不"
)
"""我不能 …, 为什么不 …: told or asked, and no order to the robot."""


def without_compounds(text: str) -> str:
    """Return a sentence, as long as it was, with the words that only look like a denial blotted."""
    return _COMPOUNDS.sub(lambda found: "〇" * len(found[0]), text)


def withholds_offers(text: str) -> bool:
    """Tell whether a marked sentence denies, excepts or switches off anything, or may do so."""
    plain = _ASKS.sub("〇", without_compounds(text))
    return _WITHHOLDS.search(plain) is not None or any(map(_may_deny, _WORD.findall(plain)))


@lru_cache(maxsize=4096)
def _may_deny(word: str) -> bool:
    """Tell whether a word is a denial with one letter wrong: "nevr", "exept", "witout"."""
    near = (OSA.distance(word, denial, score_cutoff=1) <= 1 for denial in _SLIPS_OF)
    return word not in _NO_SLIPS and any(near)


def denied_part(text: str) -> str | None:
    """Return the part of a marked sentence that surely says what is not to be done, else None."""
    found = _DENIES_EN.search(text)
    if found is not None:
        return found[found.lastgroup or 0].strip(" ,")
    return next(
        (part for clause in _DENIED_CLAUSE.findall(text) if (part := _find_denial(clause))), None
    )


def _find_denial(clause: str) -> str | None:
    bare = _ASKS.sub("〇", without_compounds(clause))
    found = None if _TELLS_ZH.search(bare) else _DENIES_ZH.search(bare)
    if found is None:
        return None
    return found["except"] or str(clause)


Vetoes = Sequence[tuple[Code, Pattern[str]]]

_CLAUSE = re.compile(r"(?:[^,;!?。、]|,(?= ?-?\d))+?(?=,(?! ?-?\d)|[;!?。、]|\.(?!\d)|$)")
_IF_EN = re.compile(
    r"(?<!what )(?<!as )(?<!even )(?<!wonder )(?<!wondering )(?<!know )(?<!ask )(?<!see )"
    r"(?<!check )(?<!me )(?<!us )(?<!tell )(?<!sure )"
    r"(?P<if>\bif\b(?! (?:you )?(?:please|would|could|may|do not mind|like|went|go|possible|"
    r"(?:have|get) (?:a|time|some))\b)[^,.;!?]*"
    r"|\b(?:unless|(?<!just )in case|provided|assuming|depending on|except if|as long as)\b"
    r"[^,.;!?]*"
    r"|(?<!i )\bsuppose\b[^,.;!?]*"
    r"|\b(?:as soon as|once)\b(?! (?:you|there|more|again|around|a|in|every|upon)\b)[^,.;!?]*"
    r"|(?<!know )(?<!ask )(?<!remember )\bwhen(?:ever)? (?!(?:did|do|does|is|are|was|were|will|can|"
    r"should|would|have|has|had|to|there)\b)(?!you (?:are|get|have|arrive|reach|come) "
    r"(?:there|back|done|in|at|to|a|time|some)\b)[^,.;!?]+"
    r"|\b(?:until|till) (?!\d)[^,.;!?]+)"
)
_IF_ZH = re.compile(
    r"(?P<if>(?:(?:^|(?<=[,;。]))(?![去到回看找跟问等说走转停叫告你您他她它我请再先])[^,.;!?。\s]{1,8}?)?"
    r"(?:如果|要是|假如|假若|倘若|若(?!干)|除非|只要|一旦|万一)(?!你?您?(?:方便|可以|有空|愿意))"
    r"[^,.;!?。]*?(?=[你您]?就|再|[才便]|[,.;!?。]|$)"
    r"|只有[^,.;!?。]*?(?=才)"
    r"|[^,.;!?。]*?(?<![说听讲我你您他她妈爸便空以])的话(?=[,.;!?。就再去到回来请进]|$)"
    r"|当[^,.;!?。]+?(?:时候?|的时候)|[^,.;!?。]+?的时候(?=[,就再才去到])"
    r"|(?:直到|等到)[^,.;!?。]*?(?=就|再|才|[,.;!?。]|$)|[^,.;!?。]+?(?<![此里儿])为止"
    r"|[^,.;!?。]*?[我他她妈爸奶爷][^,.;!?。停]{1,10}再停(?:下来?)?"
    r"|(?:看到|看见|见到|瞧见|碰到|遇到|发现)[^,.;!?。]{1,8}?(?=就)"
    r"|(?<=看看)[^,.;!?。]{1,10}?(?:着|[关开锁亮灭熄停]了|[有没][^,.;!?。]{1,6}|在)(?=就)"
    r"|等(?!我?(?:一下|一会|片刻|等))(?=[我他她它你您有没门天客妈爸人水饭雨])[^,.;!?。]*?(?:之后|以后|(?=就|再|才|[,.;!?。后])))"
)
_SPEED = re.compile(
    r"(?<!no )(?<!to )\bhurry\b|\b(?:slowly|quickly|slower|faster|quicker|speeds?|mph|coordinates?|"
    r"latitude|longitude|gps)\b"
    r"|\b(?:go|drive|move|run|walk|turn|be|as|too|very|so) (?:slow|fast|quick)\b(?! food)"
    r"|\bslow down\b|(?:met(?:re|er)s?|cm|km) (?:per|an?) (?:second|hour|minute)|m/s|km/h"
    r"|\b[xy] ?= ?-?\d|[(\[] ?-?\d+(?:\.\d+)? ?, ?-?\d"
    r"|坐标|米每秒|米/秒|每秒|速度?|慢慢|缓慢|全速|经度|纬度"
)
_OR = re.compile(
    r"\bor\b(?! (?:so|else|something|whatever)\b)|\b(?:either|whichever)\b|或|要么|任意|随便"
    r"|(?<=[^\s你您我他,.;!?。那就])还是"
)


@dataclass(frozen=True, slots=True)
class Veto:
    """Name why a sentence may not be read as an order, and the part that says so."""

    code: Code
    part: str
    denies: bool = False  # a word of denial stands in the sentence, sure or not
    only: bool = True  # no other veto speaks against it


def find_veto(text: str, vetoes: Sequence[Vetoes]) -> Veto | None:
    """Return the veto on a marked sentence, the surest reason first; None where there is none."""
    fired = _find_all(text, vetoes)
    if not fired:
        return None
    sure = _find_all(without_compounds(text), vetoes)
    for code, told in _TOLD:
        part = told(text) if code in sure else None
        if part:
            return Veto(code, part, Code.NEGATED in sure, len(sure) == 1)
    part = _clause_at(text, min(fired.values()))
    return Veto(Code.NOT_UNDERSTOOD, part, Code.NEGATED in sure, set(sure) <= {Code.AMBIGUOUS})


def _find_all(text: str, vetoes: Sequence[Vetoes]) -> dict[Code, int]:
    """Return which vetoes a text calls for, and where each stands first."""
    return {
        code: found.start()
        for grammar in vetoes
        for code, pattern in grammar
        if (found := pattern.search(text))
    }


def condition_in(text: str) -> str | None:
    """Return the words of a condition that a normalised text holds, or None."""
    found = _IF_EN.search(text) or _IF_ZH.search(text)
    return found["if"].strip() if found else None


def _speed(text: str) -> str | None:
    found = _SPEED.search(text)
    return _clause_at(text, found.start()) if found else None


def _alternatives(text: str) -> str | None:
    return text if _OR.search(text) else None


_TOLD: tuple[tuple[Code, Callable[[str], str | None]], ...] = (
    (Code.NEGATED, denied_part),
    (Code.CONDITIONAL, condition_in),
    (Code.AMBIGUOUS, _alternatives),
    (Code.OUT_OF_SCOPE, _speed),
)


def _clause_at(text: str, at: int) -> str:
    """Return the clause around a character."""
    spans = (found for found in _CLAUSE.finditer(text) if found.start() <= at < found.end())
    return next((span[0].strip() for span in spans), text)


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
        r"撞(?![到着]我了)|碾|轧|压过|踢|打人|打他|打她|打翻|打碎|追赶|追着|追上|吓|伤害|攻击|杀|冲向|冲撞|推倒|"
        r"绊倒|砸|(?<!发)烧(?!水|饭|菜|茶|开了|好了)|"
        r"毁|弄坏|监视|偷窥|跟踪(?!球)",
    ),
    _ban(
        "rule.way_out",
        r"\bblock (?:the|a|my|every|all) |\b(?:barricade|obstruct)\b",
        r"堵住|堵在|挡住(?:门|路|出口|他|她|人)(?!了)|封住",
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
