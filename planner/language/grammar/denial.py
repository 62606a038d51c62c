"""Own the words that deny, except or switch off, in both languages.

Where one stands, nothing is offered: "go to every room but the kitchen" must not be answered with
"did you mean: go to the kitchen?". In doubt a sentence denies. What is *told* as a denial is
another thing: only the part that surely says what is not to be done.
"""

from __future__ import annotations

import re
from functools import lru_cache

from rapidfuzz.distance import OSA

from planner.language.grammar.lexicon import MARK

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
_CLAUSE = re.compile(r"[^,.;!?。、]+")
_DENIES_ZH = re.compile(
    r"(?P<except>[^,.;!?。、]*除外|除(?!非|[草湿霜臭垢味法名])(?:了|开|去)?.*?(?:(?=[都全其])|之外|以外|外|$)"
    rf"|[^,.;!?。、]*(?:之外|以外|{MARK}外))"
    r"|(?P<order>别(?!的|人|处|忘|客|担|怕|着急|急|紧|介意)"
    r"|不(?:要(?!紧)|用(?![说客担急着谢管])"
    r"|[许准允必得能去该到让进]|可(?:以|(?=[去进到]))|应)|勿|莫(?!非)|禁止|甭|唔(?:好|使|要|准|可)|"
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
    return next((part for clause in _CLAUSE.findall(text) if (part := _denied(clause))), None)


def _denied(clause: str) -> str | None:
    bare = _ASKS.sub("〇", without_compounds(clause))
    found = None if _TELLS_ZH.search(bare) else _DENIES_ZH.search(bare)
    if found is None:
        return None
    return found["except"] or str(clause)
