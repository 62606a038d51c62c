"""The laws of replies: the length, the language and the words of what somebody at home is told.

The words and the groups are read from ``docs/replies.md``, so that page and law agree.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from bridge.core.faults.fault_messages import WORDS
from planner.language.catalogue import CATALOGUE
from tests.planner.language.laws.replies import (
    GROUPS,
    INNER,
    PAGE_GROUPS,
    count_sentences,
    find_foreign,
    find_inner,
)

READ = frozenset({"noun", "plural", "measure", "color", "room", "landmark", "number", "joint"})
"""Groups of words, of which sentences are made."""
SHOWN = [
    (words.language, code, text)
    for words in CATALOGUE.words
    for code, text in words.messages.items()
    if code.partition(".")[0] not in GROUPS | READ and code != "image.answers"
]
LISTS = frozenset({"localization.search_timed_out", "localization.carried_while_mapping"})
"""What somebody is told who is to help: three short sentences."""


def test_the_page_names_words_and_groups_that_exist() -> None:
    groups = {code.partition(".")[0] for code in CATALOGUE.words[0].messages}
    assert len(INNER) > 30
    assert groups >= GROUPS
    assert len(SHOWN) > 1000


@pytest.mark.parametrize("language", ["en", "zh"])
def test_no_message_of_the_catalogue_has_an_inner_word(language: str) -> None:
    assert {code: found for own, code, text in SHOWN if own == language
            if (found := find_inner(text))} == {}  # fmt: skip


PAGE = Path(__file__).parents[4] / "web" / "src" / "i18n"
_ENTRY = re.compile(r'^  "([\w.]+)":\s+"((?:[^"\\]|\\.)*)",$', re.MULTILINE)


@pytest.mark.parametrize("language", ["en", "zh"])
def test_no_text_of_the_page_has_an_inner_word(language: str) -> None:
    shown = dict(_ENTRY.findall((PAGE / f"{language}.ts").read_text("utf-8")))
    assert {key.partition(".")[0] for key in shown} >= PAGE_GROUPS
    assert len(shown) > 400
    read = {k: text for k, text in shown.items() if k.partition(".")[0] not in PAGE_GROUPS}
    assert {key: found for key, text in read.items() if (found := find_inner(text))} == {}


def test_no_fault_row_has_an_inner_word() -> None:
    parts = {"lidar", "激光", "雷达"}
    found = {row: set(find_inner(" ".join(words))) - parts for row, words in WORDS.items()}
    assert {row: inner for row, inner in found.items() if inner} == {}


@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_message_is_of_its_language(language: str) -> None:
    assert {code: found for own, code, text in SHOWN if own == language
            if (found := find_foreign(text, language))} == {}  # fmt: skip


def test_every_message_is_short() -> None:
    long = {
        (language, code): text
        for language, code, text in SHOWN
        if (count_sentences(text) > 2 and code not in LISTS and len(text) > 120) or len(text) > 200
    }
    assert long == {}


def test_good_replies_of_the_page_keep_the_laws_and_bad_ones_break_them(repository: Path) -> None:
    rows = re.findall(
        r"^\| (.+?) \| (.+?) \| (.+?) \|$",
        (repository / "docs/replies.md").read_text("utf-8"),
        re.MULTILINE,
    )[1:]
    rows = [row for row in rows if not row[0].startswith("---")]
    assert len(rows) >= 12
    for asked, good, _ in rows:
        language = "zh" if re.search(r"[\u4e00-\u9fff]", asked) else "en"
        assert find_inner(good) == [], good
        assert find_foreign(good, language) == [], good
        assert count_sentences(good) <= 2, good
