"""Identify the language of a sentence."""

from __future__ import annotations

import re

from planner.language.folding import count_chinese
from planner.plan import Language

_WORD = re.compile(r"[A-Za-z]+")


def language_of(text: str) -> Language:
    """Return Chinese where it has at least as many characters as Latin script has words.

    A name in the other script does not decide: "go to the 厨房" is English, 去kitchen Chinese.
    """
    chinese = count_chinese(text)
    return Language.ZH if chinese and chinese >= len(_WORD.findall(text)) else Language.EN
