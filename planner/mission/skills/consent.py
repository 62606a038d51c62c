"""Tell a plain yes and a plain no from all other answers, in English and Chinese. Pure.

For questions upon whose yes something moves: every clause must say it, or be mere courtesy. What
comes with a condition, a question or both words is neither. Orders to stop and to take the goal
back never come here: they are obeyed beside the question (planner/brain/intents).
"""

from __future__ import annotations

import re
import unicodedata

_READ = 80
"""Characters; a longer answer is no plain one."""
_CLAUSE_END = re.compile(r"[.,;:!~…。、]+")
_CJK = re.compile(r"[\u3400-\u9fff]")
_ONE_SCRIPT = str.maketrans("對沒問題開過確認當請謝這裡別錯’", "对没问题开过确认当请谢这里别错'")
_EN_POLITE = r"please|thanks|thank you|robot|pons"
_EN_YES = (
    r"y|yes|yeah|yep|yup|ok|okay|sure|of course|certainly|go ahead|(?:go|drive) there|do (?:it|so)"
    r"|you may|please do"
)
_EN_NO = (
    r"n|no|nope|nah|never|no way|wrong|not (?:now|there)"
    r"|(?:do not|don't)(?: (?:go|drive|do (?:it|that)))?(?: there)?"
)
_ZH_POLITE = r"请|您|你|那就|那|就|谢谢(?:你|您)?|机器人|小车"
_ZH_YES = r"是|对|好|行|可以|没问题|同意|确认|确定|当然(?:可以)?|去|过去|开过去|要"
_ZH_NO = r"不|不是|不对|不要|不用|不行|不可以|不能|不好|不同意|不去|不过去|别|别去|别过去|否|错"
_ZH_END = r"的|吧|啊|呀|哦|啦"
"""了 is none of these: 好了 and 行了 mean "enough"."""


def _english(core: str) -> re.Pattern[str]:
    return re.compile(rf"(?:(?:{_EN_POLITE}) )*(?:{core})(?: (?:{core}|{_EN_POLITE}))*")


def _chinese(core: str) -> re.Pattern[str]:
    return re.compile(rf"(?:{_ZH_POLITE})*({core})\1*(?:{_ZH_END})*(?:{_ZH_POLITE})*")


_YES = (_english(_EN_YES), _chinese(_ZH_YES))
_NO = (_english(_EN_NO), _chinese(_ZH_NO))
_COURTESY = re.compile(rf"(?:{_EN_POLITE})|(?:{_ZH_POLITE})")


def consents(answer: str) -> bool | None:
    """Return True for a plain yes, False for a plain no, None for everything else."""
    if not len(answer) <= _READ:
        return None
    folded = unicodedata.normalize("NFKC", answer).casefold().translate(_ONE_SCRIPT)
    clauses = [_plain(clause) for clause in _CLAUSE_END.split(folded)]
    said = [clause for clause in clauses if clause and not _COURTESY.fullmatch(clause)]
    for patterns, meaning in ((_YES, True), (_NO, False)):
        if said and all(any(p.fullmatch(clause) for p in patterns) for clause in said):
            return meaning
    return None


def _plain(clause: str) -> str:
    return ("" if _CJK.search(clause) else " ").join(clause.split())
