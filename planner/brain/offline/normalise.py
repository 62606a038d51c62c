"""Bring every way of writing a sentence to one: width, case, script, contractions, spaces.

Pure text to text. What it takes away carries no meaning; all else is left for the grammar to
account for, symbols included.
"""

from __future__ import annotations

import re
import unicodedata

from planner.plan import Language

# The characters of orders and rooms that differ, traditional then simplified.
_PAIRS = (
    "廳厅廚厨臥卧衛卫間间書书門门進进來来車车後后從从請请機机點点經经過过樓楼電电視视櫃柜檯台臺台爐炉燈灯沒没嗎吗裡里裏里這这個个讓让幫帮帶带東东說说開开關关現现會会圖图館馆陽阳園园"
    "邊边兩两執执當当動动別别還还與与終终導导衝冲專专準准處处見见觀观尋寻顯显幾几數数誰谁給给將将著着轉转離离應应單单雙双檢检員员樁桩迴回歸归廁厕麼么為为時时達达訪访駛驶發发環环緊紧"
    "趕赶馬马話话問问紅红樣样繼继續续順顺貨货區区實实驗验頭头號号遠远飯饭領领護护隨随搖摇擺摆餵喂"
)
_ONE_SCRIPT = str.maketrans(_PAIRS[::2], _PAIRS[1::2])

_CJK = r"[\u3400-\u9fff。、]"
_CJK_GAP = re.compile(rf"(?<={_CJK})\s+|\s+(?={_CJK})")
_IN_BRACKETS = re.compile(r"\(([^()\d]+)\)")
_HYPHEN = re.compile(r"(?<=[a-z])[-_](?=[a-z])")
_CONTRACTIONS = (
    (re.compile(r"\bcan'?t\b"), "can not"),
    (re.compile(r"\bwon'?t\b"), "will not"),
    (re.compile(r"\b(do|does|did|is|are|would|could|should|must)n'?t\b"), r"\1 not"),
    (re.compile(r"\b(what|where|who|how)'?s\b"), r"\1 is"),
    (re.compile(r"\blet's\b"), "let us"),
    (re.compile(r"\bi'd\b"), "i would"),
    (re.compile(r"\bi'm\b"), "i am"),
    (re.compile(r"\byou're\b"), "you are"),
)
_QUOTES = str.maketrans({"’": "'", "‘": "'", "“": '"', "”": '"', "「": '"', "」": '"'})


def normalise(text: str) -> str:
    """Return the sentence in one form of writing; the same words always give the same form."""
    folded = unicodedata.normalize("NFKC", text).casefold().translate(_QUOTES)
    shown = "".join(char for char in folded if unicodedata.category(char) != "Cf")
    plain = _HYPHEN.sub(" ", shown.translate(_ONE_SCRIPT))
    for pattern, words in _CONTRACTIONS:
        plain = pattern.sub(words, plain)
    whole = " ".join(_CJK_GAP.sub("", plain).split())
    inside = _IN_BRACKETS.fullmatch(whole)
    return inside[1] if inside else whole


def squash(name: str) -> str:
    """Return a name without what people write differently: spaces, hyphens, apostrophes, case."""
    return re.sub(r"[\s\-_'’\"]+", "", normalise(name))


def language_of(text: str) -> Language:
    """Tell the language of a sentence: any Chinese character makes it Chinese."""
    return Language.ZH if re.search(r"[\u3400-\u9fff]", text) else Language.EN
