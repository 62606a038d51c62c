"""Identify the language of a sentence."""

from __future__ import annotations

from planner.language.folding import is_chinese
from planner.plan import Language


def language_of(text: str) -> Language:
    """Return Chinese where the text is Chinese (``folding.is_chinese``), else English."""
    return Language.ZH if is_chinese(text) else Language.EN
