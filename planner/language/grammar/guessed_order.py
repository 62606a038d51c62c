"""Write the plain order that a sentence may mean, by the intent model, in the grammar's own words.

Laws: every place that the sentence names is in the order, and no other; a thing is told in the
sentence's own words; what holds an order back (a denial, a condition, a choice) is never guessed
past. The order is read as any sentence is, and then asked about: nothing moves by a guess.
"""

from __future__ import annotations

import re
from itertools import groupby
from typing import TYPE_CHECKING

from planner.language.grammar.checks import withholds_offers, without_compounds
from planner.language.grammar.en.orders import ENGLISH
from planner.language.grammar.lexicon import MARK
from planner.language.grammar.plain_words import asks_whether
from planner.language.grammar.zh.orders import CHINESE
from planner.language.intent.features import MOST_UNITS, units_of
from planner.language.intent.intent_model import load_intent_model
from planner.plan import Code, Language

if TYPE_CHECKING:
    from planner.language.grammar.lexicon import MarkedText
    from planner.language.intent.intent_model import Guess

SURE = 0.5
"""Of phrases that were kept away in training, 57 of 100 orders were guessed right from here on, and
13 of 100 guesses were wrong; people say no to those."""

NONE = "none"
ORDERS: dict[str, tuple[str, str]] = {
    "go": ("go to {p}", "去{p}"),
    "go_go": ("go to {p} and then to {q}", "先去{p}再去{q}"),
    "look": ("go to {p} and look around", "去{p}看看"),
    "look_here": ("look around", "看看周围"),
    "look_look": ("look around {p}, then look around {q}", "去{p}看看,再去{q}看看"),
    "look_back": ("look around {p} and come back", "去{p}看看再回来"),
    "find_at": ("find {t} in {p}", "去{p}找{t}"),
    "find": ("find {t}", "找{t}"),
    "count_at": ("count {t} in {p}", "数一下{p}的{t}"),
    "count_here": ("count {t} here", "数一下这里的{t}"),
    "person_at": ("is anyone in {p}?", "看看{p}有没有人"),
    "person": ("find a person", "找人"),
    "follow": ("follow me", "跟着我"),
    "home": ("go home", "回家"),
    "go_back": ("go to {p} and come back", "去{p}再回来"),
    "go_wait": ("go to {p}", "去{p}"),
    "rounds": ("patrol all rooms", "巡逻所有房间"),
    "turn": ("turn around", "转身"),
}
"""By intent, in both languages; an intent that is not here asks for nothing."""
_DENIES_NOTHING = re.compile(
    r"不知道?|不晓得|不清楚|[找看]不[着到见]|不见了|不早了|不放心|不好意思|走不[开动]|腿脚不好|忙不过来|听不清"
    r"|要不(?=你|咱|我们)|差不多"
    r"|\b(?:can ?not|could not) (?:find|see|reach|get up|walk|leave|come)\b"
    r"|\b(?:do|does|did) not (?:know|remember|see|feel well)\b|\bnot sure\b|\bno idea\b"
)
"""Said of the person or of what is lost, it forbids nothing."""
_OWN = re.compile(r"^(?:the|a|an|my|our|your|any|some) ")


NOTHING = ""
"""The sentence surely asks for nothing."""


def guess_order(marked: MarkedText, language: Language) -> str | None:
    """Return the order that a marked sentence may mean, or NOTHING; None: not guessed."""
    units, model = units_of(marked.text), load_intent_model()
    if model is None or not 0 < len(units) <= MOST_UNITS:
        return None
    if _holds_back(marked.text):
        return None
    guess = model.guess(units)
    if not guess.share >= SURE:
        return None
    return NOTHING if guess.intent == NONE else write_order(guess, units, marked, language)


def _holds_back(text: str) -> bool:
    """Tell whether a sentence denies, excepts, hangs on something or leaves a choice.

    A speed does not: the order is driven as any is, and the person sees it before.
    """
    plain = _DENIES_NOTHING.sub("〇", text)
    looked_at = without_compounds(asks_whether(plain))
    vetoes = (*ENGLISH.vetoes, *CHINESE.vetoes)
    held = any(veto.search(looked_at) for code, veto in vetoes if code is not Code.OUT_OF_SCOPE)
    return held or withholds_offers(plain)


def write_order(
    guess: Guess, units: list[str], marked: MarkedText, language: Language
) -> str | None:
    """Return the order of a guess; None where a place is left out, or a place or thing lacks."""
    form = ORDERS.get(guess.intent, ("", ""))[language is Language.ZH]
    named = list(dict.fromkeys(re.findall(MARK, marked.text)))
    wanted = [slot for slot in ("{p}", "{q}") if slot in form]
    if (
        not form
        or len(named) != len(wanted)
        or any(len(marked.mention(mark).ids) != 1 for mark in named)
    ):
        return None
    thing = _thing(guess, units, language) if "{t}" in form else ""
    if thing is None:
        return None
    filled = form.replace("{t}", thing)
    for slot, mark in zip(wanted, named, strict=True):
        written = marked.mention(mark).written
        filled = filled.replace(slot, written if language is Language.ZH else f"the {written}")
    return filled


def _thing(guess: Guess, units: list[str], language: Language) -> str | None:
    """Return the longest run of units that names a thing."""
    runs = [
        [unit for unit, _ in run]
        for is_thing, run in groupby(zip(units, guess.thing, strict=True), lambda pair: pair[1])
        if is_thing
    ]
    longest = max(runs, key=len, default=[])
    if language is Language.ZH:
        return "".join(longest) or None
    words = _OWN.sub("", " ".join(longest))
    return f"the {words}" if words else None
