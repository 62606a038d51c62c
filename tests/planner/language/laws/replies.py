"""Judge a reply by the laws of ``docs/replies.md``: inner words, foreign words, sentences."""

from __future__ import annotations

import re
from pathlib import Path

_PAGE = (Path(__file__).parents[4] / "docs" / "replies.md").read_text("utf-8")
_QUOTED = re.compile(r"“[^”]*”|`[^`]*`|\{[^}]*\}|\"[^\"]*\"")
_UNITS = re.compile(r"\b(?:m|cm|s|h|min|WAV|PCM|MB|kHz|UTC|Pons|US|tv)\b")
_HAN = re.compile(r"[\u3400-\u9fff]+")
_LATIN = re.compile(r"[A-Za-z]{2,}")


def _block(name: str) -> frozenset[str]:
    found = re.search(rf"```{name}\n(.*?)```", _PAGE, re.DOTALL)
    assert found is not None, name
    return frozenset(word.strip() for word in re.split(r"[,\n]", found[1]) if word.strip())


INNER = _block("inner-words")
GROUPS = _block("set-up-groups")
PAGE_GROUPS = _block("page-set-up-groups")
_INNER = re.compile(
    "|".join(rf"\b{re.escape(word)}\b" if word.isascii() else word for word in sorted(INNER)),
    re.IGNORECASE | re.ASCII,
)


def find_inner(said: str) -> list[str]:
    """Return the inner words of a reply; a person's own words are quoted, and theirs."""
    return _INNER.findall(_QUOTED.sub("", said))


def find_foreign(said: str, language: str, names: frozenset[str] = frozenset()) -> list[str]:
    """Return the words of a reply that are of another language, names and quotations apart."""
    plain = _QUOTED.sub("", said)
    if language == "zh":
        return [w for w in _LATIN.findall(_UNITS.sub("", plain)) if w not in names]
    return [w for w in _HAN.findall(plain) if w not in names]


def count_sentences(said: str) -> int:
    """Return how many sentences a reply has."""
    plain = re.sub(r"\d\.\d", "0", _QUOTED.sub("x", said))
    return len(re.findall(r"[.!?](?= |$)|[。！？]", plain)) or 1
