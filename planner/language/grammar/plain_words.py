"""Prepare a sentence for its second reading: in plainer words, and no word lost that holds it back.

Beside the tables of ``everyday`` stand here the questions whose "if" hangs nothing on anything, and
which words hold an order back.
"""

from __future__ import annotations

import re
from collections import Counter

from planner.language.folding import CHINESE as HAN
from planner.language.folding import has_chinese
from planner.language.grammar.asides import without_asides
from planner.language.grammar.checks import without_compounds
from planner.language.grammar.en.everyday import COURTESY as EN_COURTESY
from planner.language.grammar.en.everyday import ENGLISH_EVERYDAY, TOLD_TWICE
from planner.language.grammar.en.orders import ENGLISH
from planner.language.grammar.everyday import rewrite
from planner.language.grammar.lexicon import MARK, NAME, lexicon_of
from planner.language.grammar.self_correction import take_last_word
from planner.language.grammar.sentence_text import normalise
from planner.language.grammar.zh.everyday import ASKED_AND_SENT, CHINESE_EVERYDAY
from planner.language.grammar.zh.everyday import COURTESY as ZH_COURTESY
from planner.language.grammar.zh.orders import CHINESE
from planner.plan import Vocabulary

_NAMED = re.compile(rf"[^{HAN}]{{0,8}}{MARK}[呢吗么]?[?]+")


def without_sending(text: str) -> str:
    """Return "how many chairs are there, go and count" without its end, which Chinese says so.

    Likewise one turn that is told twice: "turn round and face the other way".
    """
    said = normalise(text)
    plain = rewrite(said, ASKED_AND_SENT if has_chinese(text) else TOLD_TWICE)
    return text if plain == rewrite(said, ()) else plain


def leave_asides_out(text: str, vocabulary: Vocabulary) -> str | None:
    """Return a sentence without what it takes back, courtesy, praise and statements of how things
    stand; None where it has none of them.
    """
    marked = lexicon_of(vocabulary).mark(normalise(text))
    left = without_asides(take_last_word(marked.text) or marked.text)
    return marked.restore(left) if left != marked.text else None


def in_plain_words(text: str, vocabulary: Vocabulary) -> str | None:
    """Return a sentence in the grammar's own words; None where there are none, or where a word in
    it holds orders back: what is taken away must carry no meaning.
    """
    said = normalise(text)
    chinese = has_chinese(said)
    courtesy, phrases = (
        (ZH_COURTESY, CHINESE_EVERYDAY) if chinese else (EN_COURTESY, ENGLISH_EVERYDAY)
    )
    marked = lexicon_of(vocabulary).mark(said)
    willing = rewrite(marked.text, courtesy)
    if willing.rstrip().endswith("?") and _NAMED.fullmatch(willing):
        return None  # "the kitchen?" asks
    rewritten = rewrite(willing, phrases)
    if not held_back(willing) <= held_back(rewritten):
        return None
    plain = marked.restore(rewritten)
    return plain if plain and plain != said else None


def held_back(text: str) -> Counter[str]:
    """Return the words of a sentence that deny, except, leave a choice, hang it on something or
    name a speed.
    """
    looked_at = without_compounds(asks_whether(text))
    vetoes = (*ENGLISH.vetoes, *CHINESE.vetoes)
    return Counter(found[0] for _, veto in vetoes for found in veto.finditer(looked_at))


_WHETHER = re.compile(
    r"\b(tell (?:me|us)|check(?:ing)?|see(?:ing)?|look(?:ing)?|find(?:ing)? out|report"
    r"|let (?:me|us) know"
    rf"|ask(?: (?:him|her|them|(?:every|any|some)(?:one|body)|{NAME}|(?:(?:the|my|our|a) )?[a-z]+)"
    rf"(?: (?:in|at|on|by|near) (?:the )?(?:{MARK}|[a-z]+(?: room)?))?)?) (?:if|whether)\b"
    r"|(?<=[看查认下])(?:一下|看)?(?:是否|是不是|有没有)"
)


_WHEN_THEY = re.compile(
    rf"(\bask (?:him|her|them|{NAME}|(?:(?:the|my|our) )[a-z]+)"
    rf"(?: (?:in|at|on|by|near) (?:the )?(?:{MARK}|[a-z]+(?: room)?))?) when"
    r"(?= (?:he|she|they)(?:'s| is|'re| are|'ll| will| can| wants?| needs?| has| have)\b"
    r"(?! (?:back|here|there|home|in|up|awake|done|ready)\b)"
    r"(?![^,.;!?]*\b(?:if|whether|what|how|where|who|why|to)\b)[^,.;!?]*(?:[.!?]|$| and ))"
)
"""What is asked of somebody: "ask him when he's free"; before a question it is when to ask."""


_WHOEVER = re.compile(r"(?:(?<=\btell )|(?<=\bask ))whoever(?: is|'s)(?= (?:in|at|on|by|near)\b)")
"""Whoever is there is told or asked: no condition."""

_A_NOT_A = re.compile(r"((?:看|查|确认|问)[^,。;!?]*?)([^,。;!?])不\2")
"""看看她在不在: to be looked at, no negation."""

_DONE_OR_NOT = re.compile(r"((?:看|查|确认|问)[^,。;!?]*?[着了完好过])没有?(?=[,。;!?]|$)")
"""看看电视开着没有, 看看门关了没: likewise."""

_ASKS_THEM = re.compile(r"(问[^,。;!?]{0,12}?)(?:要不要|想不想|是不是|是否|能不能|有没有|需不需要)")
"""问问妈妈要不要喝茶: asked of somebody, no condition."""


def asks_whether(text: str) -> str:
    """Return the text without the "if" of a question that looking answers: no condition."""
    plain = _DONE_OR_NOT.sub(r"\1", _A_NOT_A.sub(r"\1\2", _ASKS_THEM.sub(r"\1要", text)))
    plain = _WHOEVER.sub("them", _WHEN_THEY.sub(r"\1", plain))
    return _WHETHER.sub(lambda found: found[1] or "有", plain)
