"""Observe every refusal of a site that a test brings about: its Chinese sentence is Chinese.

A conftest takes the fixture in; what a test provokes on purpose, or a law by chance, is judged.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest

from maps.errors import CODES, SiteError

_NAMED = (
    r"`[^`]*`",
    r"'(?:[^'\\]|\\.)*'",
    r'"(?:[^"\\]|\\.)*"',
    r"“[^”]*”",
    r"pons(?: [\w.-]+)+",
    r"(?<!\w)/\S+",
)
"""What stays as it is in every language: quotes, commands and paths."""
_ENGLISH = re.compile(r"[A-Za-z']+(?: [A-Za-z']+){2,}")
_CHINESE = re.compile(r"[\u4e00-\u9fff]")


def english_in(chinese: str) -> str:
    """Return the first run of three or more English words in a Chinese text; empty: none."""
    for named in _NAMED:
        chinese = re.sub(named, "‹›", chinese)
    found = _ENGLISH.search(chinese)
    return found[0] if found else ""


def flaws_of(error: SiteError) -> list[str]:
    """Return what is wrong with a refusal's code or its Chinese sentence."""
    chinese = error.message["zh"]
    found = [] if error.code in CODES else [f"{error.code} is no code of maps.errors"]
    if not _CHINESE.search(chinese) or english_in(chinese):
        found.append(f"{error.code} in Chinese: {chinese}")
    return found


@pytest.fixture(autouse=True)
def refusals_are_whole_in_chinese(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Fail a test in which a SiteError was made whose Chinese sentence holds English."""
    flaws: list[str] = []
    born = SiteError.__init__

    def observe(error: SiteError, code: str, message: str, zh: str) -> None:
        born(error, code, message, zh)
        flaws.extend(flaws_of(error))

    monkeypatch.setattr(SiteError, "__init__", observe)
    yield
    assert not flaws, flaws
