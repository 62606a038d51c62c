"""Fold spellings that mean alike: width, case, script, look-alike letters.

The only place that folds text; code that compares words folds both sides here. Standard library
alone, pure, and stable: folding twice changes nothing more. The table of scripts is generated from
OpenCC's (script_table.py), so that a word in traditional characters is the same word everywhere.
"""

from __future__ import annotations

import re
import unicodedata

from planner.language.script_table import SIMPLIFIED, TRADITIONAL

_TO_SIMPLIFIED = str.maketrans(TRADITIONAL, SIMPLIFIED)
CHINESE = r"\u3400-\u9fff"
"""The range of Chinese characters, for use within a class of a pattern."""
_CHINESE = re.compile(rf"[{CHINESE}]")
_LATIN_WORD = re.compile(r"[A-Za-z]+")

# Letters of other alphabets that are drawn as a Latin one (after folding of case): a person who
# sees them reads the Latin word. Source: confusables.txt of Unicode (UTS 39), lower case only.
_LOOK_ALIKES = str.maketrans(
    "аеорсухіјѕԁԛԝһӏᴏοαερτυκνιɑɡıɩʀ",
    "aeopcyxijsdqwhlooaeptukviagiir",
)
_UNSEEN = frozenset({"Cf", "Mn", "Me", "Cc"})


def fold_width(text: str) -> str:
    """Return the text in one width (NFKC): fullwidth letters and ligatures become plain ones."""
    return unicodedata.normalize("NFKC", text)


def fold_script(text: str) -> str:
    """Return the text in simplified characters, character for character."""
    return text.translate(_TO_SIMPLIFIED)


def fold(text: str) -> str:
    """Return the text in one width, one case and one script; spaces stay as they are."""
    folded = fold_width(fold_width(text).casefold())
    return fold_script(folded)


def fold_words(text: str) -> str:
    """Return the folded text with single spaces and none at its ends: how names are compared."""
    return " ".join(fold(text).split())


def unmask(text: str) -> str:
    """Return folded text as a person sees it: nothing unseen in it, look-alike letters Latin.

    For the stop lane, and for names that must not be mistaken for another: a Russian word is no
    English one to anybody else.
    """
    decomposed = unicodedata.normalize("NFD", text)
    seen = "".join(c for c in decomposed if unicodedata.category(c) not in _UNSEEN or c in "\t\n\r")
    return unicodedata.normalize("NFC", seen).translate(_LOOK_ALIKES)


def has_chinese(text: str) -> bool:
    """Return whether any Chinese character stands in the text."""
    return _CHINESE.search(text) is not None


def is_chinese(text: str) -> bool:
    """Return whether a text has at least as many Chinese characters as words in Latin script.

    A name in the other script does not decide: "go to the 厨房" is English, 去kitchen Chinese.
    """
    chinese = count_chinese(text)
    return chinese > 0 and chinese >= len(_LATIN_WORD.findall(text))


def count_chinese(text: str) -> int:
    """Return the number of Chinese characters in the text."""
    return len(_CHINESE.findall(text))
