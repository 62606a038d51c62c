"""Own the reasons for which a model is not believed or not asked: stable codes, both languages.

They stand in a goal's record beside the brain that answered instead, and a page shows them.
"""

from __future__ import annotations

from planner.language.catalogue import say
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


def reason(code: str) -> Bilingual:
    """Return the sentence of a code; one that is not listed reads as ``unavailable``."""
    return REASONS.get(code, REASONS["unavailable"])
