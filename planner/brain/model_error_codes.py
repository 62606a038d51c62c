"""Own the reasons for which a model is not believed or not asked: stable codes, both languages.

They stand in a goal's record beside the brain that answered instead, and a page shows them.
"""

from __future__ import annotations

import unicodedata

from planner.language.catalogue import join, say
from planner.plan import Bilingual

REASONS: dict[str, Bilingual] = {
    code: say(f"model_error.{code}")
    for code in (
        "timeout",
        "unreachable",
        "rate_limited",
        "server_error",
        "loading",
        "bad_key",
        "unknown_model",
        "bad_request",
        "context_too_small",
        "redirect",
        "bad_reply",
        "too_large",
        "refused_address",
        "resting",
        "pictures_offhost",
        "no_pictures",
        "bad_picture",
        "picture_too_large",
        "bad_plan",
        "only_words",
        "wrong_language",
        "instructions_told",
        "answer_too_long",
        "offer_not_asked",
        "out_of_budget",
        "unavailable",
    )
}


MOST_SAID = 160
"""Characters of a server's own words that a person is told."""
_UNSEEN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})


def tell_failure(code: str, server: str = "") -> Bilingual:
    """Return the sentence of a code, with what the server itself said: bounded, and in quotes."""
    plain = "".join(each for each in server if unicodedata.category(each) not in _UNSEEN)
    words = " ".join(plain.split())[:MOST_SAID].rstrip(" .。")  # the quotation ends our sentence
    return join((reason(code), say("model_error.said", words=words))) if words else reason(code)


def reason(code: str) -> Bilingual:
    """Return the sentence of a code; one that is not listed reads as ``unavailable``."""
    return REASONS.get(code, REASONS["unavailable"])
