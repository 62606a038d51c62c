"""Set words that are told to somebody in quotation marks, where they deny: 告诉妈妈不用等我.

What is told is words and orders nothing, so a "not" in it holds no order back. Pure. Laws: only
Chinese, where one clause both names the person and ends the sentence with the words; a person known
by name or as one of the family; a telling that may itself be denied, asked or over (没有, 不用了)
stays as it was said.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.grammar.lexicon import MARK, lexicon_of
from planner.language.grammar.sentence_text import normalise
from planner.language.person_names import is_given_name

if TYPE_CHECKING:
    from planner.plan import Vocabulary

_GO = r"请|麻烦|帮我|替我|帮忙|你|快|先|再|也|过去|然后|顺便|记得"
_LEAD = (
    rf"(?P<lead>(?:.*[,，。;；])?(?:{_GO}"
    rf"|[去到在回](?:(?!{_GO}|[去到在回])[^,，。;；告诉通知提醒跟对和向给叫让喊]){{0,6}})*?)"
)
"""One way to read each text: what begins a part of it never stands within another part."""
_TELLS = re.compile(
    rf"{_LEAD}(?P<verb>(?:告诉|通知|提醒)(?:一下|一声)?|[跟对和向给叫让喊])(?P<rest>.+)"
)
_SPEECH = re.compile(r"(?:说|讲|带(?:个|句)话(?:说)?)?(?:一声|一下|一句|句|声)?[:：,，]?")
_DENIES = r"(?:别(?!的|人)|不|没|勿|甭|无需)"
_WORDS = re.compile(
    r"(?!完|过|之前|以前|之后|以后|的时候|时|了|说|讲)"
    rf"(?=[^,，。;；]*{_DENIES})(?P<words>[^,，。;；\"“”「」?？]{{3,60}})[。.!！]*"
)
_STAYS = re.compile(
    r"(?:了|过)?(?:没有?|吗|么|不)[呀啊呢]?$|^[还都又]*(?:不用|不要|别|不必|不行|不可以)[了啦吧]*$"
    r"|除了|如果|要是|的话"
)
_ORDERED = re.compile(r"别|不[要用必]|千万|先别")
_EVERYBODY = frozenset(("大家", "他们", "她们", "他", "她", "孩子们", "孩子", "客人", "客人们"))
_LONGEST = 5


def quote_told_words(text: str) -> str:
    """Return a sentence with words of denial that are told to somebody in quotation marks."""
    found = _TELLS.fullmatch(text.strip()) if has_chinese(text) and len(text) <= 120 else None
    if found is None:
        return text
    verb, rest = found["verb"], found["rest"]
    for size in range(_LONGEST, 0, -1):
        who, behind = rest[:size], rest[size:]
        if not (is_given_name(who) or who in _EVERYBODY):
            continue
        speech = _SPEECH.match(behind)
        told = behind[speech.end() :] if speech is not None else behind
        # 跟妈妈 alone follows her, 叫妈妈 alone calls her
        tells = _ORDERED.match(told) if verb in "叫让喊" else len(verb) > 1 or told != behind
        words = _WORDS.fullmatch(told)
        if words is None or not tells or _STAYS.search(words["words"]):
            return text
        return f"{found['lead']}对{who}说“{words['words']}”"
    return text


_TO_ME = re.compile(
    rf"(?:请|麻烦|帮我|你|快|先|再|就)*(?:[去到上来回](?:一趟)?)(?P<place>{MARK})(?:这儿|那儿|这边|那边|里)?[来去]?"
    r"(?:(?:提醒|催|叫|喊)我(?![妈爸哥姐弟妹老爷奶儿女孙家们媳的一了说])(?:一下|一声)?"
    r"|[跟和对]我[说讲](?:一声|一下|句)?)[,:]?"
    r"(?P<words>(?!一[声下]$|[的了就是])[^,。;?\"“”]{2,30})[。.!]*"
)
_ASKED = re.compile(r"什么|啥|几|谁|哪|[吗么呢]$|有没有|是不是|在不在|如果|要是|的话|结果|情况")


def quote_words_for_me(text: str, vocabulary: Vocabulary) -> str:
    """Return 到客厅来提醒我吃药 as words to be said there: the speaker is where they send it."""
    if not has_chinese(text) or "我" not in text:
        return text
    marked = lexicon_of(vocabulary).mark(normalise(text))
    found = _TO_ME.fullmatch(marked.text)
    if found is None or _ASKED.search(found["words"]):
        return text
    return marked.restore(f"去{found['place']}说“{found['words']}”")


_CALLED = re.compile(
    r"(?P<why>(?:该|要|可以|准备|马上|快)[^,，。;；]{1,6}了|(?:饭|菜|汤|晚饭|午饭|早饭|饺子|面|水果|茶)(?:都)?(?:做|煮|烧|蒸)?好了|开饭了)[,，。!！]?"
    r"(?:你|快|赶紧|帮我|麻烦)*(?:去)?(?:叫|喊|通知)(?:一下|一声)?(?P<who>大家|所有人|他们|孩子们?|全家人?|家里人)"
    r"(?:来|过来|出来|都来|一下|一声|们)*(?:吧|啊|呀|哈)*[。.!！]*"
)


def say_why_called(text: str) -> str:
    """Return 该吃饭了去叫大家 as the words that call them: why they are to come."""
    found = _CALLED.fullmatch(text.strip()) if has_chinese(text) else None
    return text if found is None else f"对大家说“{found['why']}”"
