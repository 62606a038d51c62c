"""Say whom else or what else an order is for: "and Grandma too", 还要讲晚上不回来吃饭.

Pure. Laws: the newest order speaks to one person; what is added is one more person, or words to the
same one, and is marked as added ("too", 还要, 顺便). What is in doubt stays as it was said.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.motion_guard.mentioned_names import plain
from planner.language.person_names import is_given_name, people_named

if TYPE_CHECKING:
    from planner.mission.state import Mission

MAX_READ = 80
_ENDS = " .!,;:。~…，；！"
_SPEAKS = re.compile(r"\b(?:tell|ask|inform|remind|warn|greet|call|let|invite)\b", re.IGNORECASE)
_SPEAKS_ZH = re.compile(r"告诉|通知|提醒|问|叫|喊|跟|对|和")
_SOMEBODY = r"(?P<{}>(?:(?:my|our) )?[a-z][a-z'-]{{1,15}})"
_TOO = re.compile(
    r"(?:(?:oh|ok|okay|well|right|while you(?:'re| are) (?:there|at it))[ ,]+)*"
    rf"(?:(?:and|also) (?:(?:tell|ask|call|get|invite) )?{_SOMEBODY.format('a')}(?:[ ,]+(?:too"
    rf"|as well|also))?"
    rf"|(?:(?:tell|ask|call|get|invite) )?{_SOMEBODY.format('b')}[ ,]+(?:too|as well|also))"
)
_TOO_ZH = re.compile(
    r"(?:对了|哦|那|,)*(?:(?:顺便|顺带|还有|也|再|另外|把)+(?:去|帮我)?(?:叫上?|喊上?|问一?下?"
    r"|问问|通知|告诉|带上)?"
    r"(?P<a>[^,，。跟对和给向说讲]{1,6}?)(?:也)?(?:一起|一下|一声|叫上|喊上)?"
    r"|(?P<b>[^,，。跟对和给向]{1,6}?)(?:那边|那儿|那里)?也(?:要|得|去)*(?:一起)?(?:叫上?|喊上?|问一?下|问问|说|讲"
    r"|通知|告诉|提醒)(?:一?[声下句])?"
    r"|(?:再|也|还|顺便|去|过去|要|帮我)*(?:跟|对|和|给|向|告诉|通知|问|提醒)(?P<c>[^,，。]{1,6}?)"
    r"(?:那边|那儿|那里)?(?:也|再|都|去)*(?:(?:说|讲|告诉|通知|问|提醒)?一?[声下句]))"
    r"(?:吧|啊|呀|哦|呗|哈)*"
)
_WORDS_ZH = re.compile(
    r"(?:对了|哦|,)*(?:还有|还要|还得|另外|顺便|再)(?:要|帮我)?(?:(?:跟|和|对)[他她]们?)?(?:说一声"
    r"|说一下|说|讲|告诉[他她]们?)"
    r"(?P<words>[^吗呢?？什么谁哪“”]{2,40})"
)
_TELLS_ZH = re.compile(r"(?P<head>.*?(?:说一声|说一下|说|讲))(?P<words>[^“”\"]{1,60})")


_NO = r"(?:(?:no|nope|sorry|wait|actually|oops|hang on)[ ,.!;]+)"
_INSTEAD = re.compile(
    rf"(?:{_NO}+(?:i meant? |i said )?(?:(?:tell|ask|call|get) )?{_SOMEBODY.format('a')}"
    rf"|i meant? {_SOMEBODY.format('b')}|(?:tell|ask|call) {_SOMEBODY.format('c')} instead)"
    r"(?: instead)?(?:[ ,]+(?:please|not (?:my )?[a-z]+))?"
)
_INSTEAD_ZH = re.compile(
    r"(?:(?:不对|不是|错了|说错了|等等|不|,)+(?:我说的)?(?:应该)?是?|我说的是|改成|换成)"
    r"(?:告诉|问|叫|通知|跟|和)?(?P<a>[^,，。]{1,5}?)(?:才对|吧|啊)*"
)
_SAYS_INSTEAD = re.compile(
    rf"(?:{_NO}+say (?P<a>[^,;]{{2,60}})|{_NO}*say (?P<b>[^,;]{{2,60}}?),? instead)"
)
_SAYS_INSTEAD_ZH = re.compile(
    r"(?:(?:不对|不|等等|算了|,)+(?:还是|改)?|还是|改|换)(?:成)?(?:说|讲)[“\"]?(?P<a>[^“”\",吗呢]{1,40}?)[”\"]?(?:吧)?"
)
_HANGS = re.compile(r"\b(?:if|unless|until|when|or|and then|then)\b|如果|要是|的话|还是|再去|然后")


def correct_words(text: str, last: Mission) -> str | None:
    """Return the order for another person, or with other words; None where nothing is corrected.

    Args:
        text: as it was said.
        last: the newest order.
    """
    said = plain(text).strip(_ENDS)
    chinese = has_chinese(said)
    if not 0 < len(said) <= MAX_READ or text.rstrip().endswith(("?", "？")):
        return None
    if has_chinese(last.order_text) is not chinese:
        return None
    bare = re.sub(r"[，。；!！]", ",", "".join(said.split())) if chinese else said
    found = (_SAYS_INSTEAD_ZH if chinese else _SAYS_INSTEAD).fullmatch(bare)
    if found is not None:
        return _put_words(next(words for words in found.groups() if words), last)
    found = (_INSTEAD_ZH if chinese else _INSTEAD).fullmatch(bare)
    other = next((who for who in found.groups() if who), "") if found is not None else ""
    people = people_named(last.order_text)
    speaks = (_SPEAKS_ZH if chinese else _SPEAKS).search(last.order_text)
    if not is_given_name(other) or len(people) != 1 or speaks is None:
        return None
    return _put_person(other, people[0], last)


def _put_words(words: str, last: Mission) -> str | None:
    """Return an order to say other words; None where it says none, or not once in these words."""
    said = [step.text for step in last.steps if step.kind == "say" and step.text]
    order = plain(last.order_text)
    old = plain(said[0]).strip(_ENDS) if len(said) == 1 else ""
    if not old or order.count(old) != 1 or _HANGS.search(words):
        return None
    return order.replace(old, words)


def _put_person(other: str, person: str, last: Mission) -> str | None:
    """Return an order with another person in the place of its only one."""
    order, who = plain(last.order_text), plain(person)
    if not last.steps or plain(other) == who:
        return None
    put = re.sub(rf"(?<![a-z]){re.escape(who)}(?![a-z])", lambda _: other, order, count=1)
    return put if put != order else None


def add_to_words(text: str, last: Mission) -> str | None:
    """Return the order for one more person, or with more words; None where none is added.

    Args:
        text: as it was said.
        last: the newest order.
    """
    said = plain(text).strip(_ENDS)
    chinese = has_chinese(said)
    people = people_named(last.order_text)
    ready = 0 < len(said) <= MAX_READ and not text.rstrip().endswith(("?", "？"))
    if not ready or len(people) != 1 or has_chinese(last.order_text) is not chinese:
        return None
    if not (_SPEAKS_ZH if chinese else _SPEAKS).search(last.order_text):
        return None
    bare = "".join(said.split()) if chinese else said
    if chinese and (words := _WORDS_ZH.fullmatch(bare)) is not None:
        return _say_besides(words["words"], last)
    found = (_TOO_ZH if chinese else _TOO).fullmatch(bare)
    other = next((who for who in found.groups() if who), "") if found is not None else ""
    return _put_person(other, people[0], last) if is_given_name(other) else None


def _say_besides(words: str, last: Mission) -> str | None:
    """Return the order to tell the same person more, both where nothing was told yet."""
    order = plain(last.order_text)
    told = _TELLS_ZH.fullmatch(order)
    if told is None:
        return None
    if last.steps or not last.plan:
        return f"{told['head']}“{words}”"
    return f"{told['head']}“{told['words'].strip(_ENDS)}，{words}”"
