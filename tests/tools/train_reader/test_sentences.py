"""Writers' rows are checked against their labels; assignments are drawn by seed."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest

from tools.train_reader.assignments import draw_assignment
from tools.train_reader.sentences import COLUMNS, WrittenSentence, fault_of, read_sentences


def _row(label: str, words: str) -> WrittenSentence:
    return WrittenSentence("en01-000-plain", "en", "p", "s", ("kitchen", "hall"), label, words)


def test_a_row_that_holds_what_its_label_names_is_right() -> None:
    row = _row('go(hall); say("Dinner\'s up", to "Dad")', "HALL! Tell dad dinner’s up")
    assert fault_of(row) == ""
    assert row.category == "plain"


@pytest.mark.parametrize(
    ("label", "words", "fault"),
    [
        ("go(hall)", "", "no words"),
        ("go(hall", "to the hall", "label"),
        ("go(attic)", "to the attic", "the home has no place"),
        ("go(hall)", "to the kitchen", "the place isn't"),
        ('find("cup")', "where's my mug", "the quoted words"),
    ],
)
def test_a_faulty_row_is_told(label: str, words: str, fault: str) -> None:
    assert fault_of(_row(label, words)).startswith(fault)


def test_rows_are_read_by_their_columns(tmp_path: Path) -> None:
    path = tmp_path / "en_01.tsv"
    row = ("en01-000-which", "en", "p", "s", "kitchen | hall", "home", "off home ")
    path.write_text("\n".join(("\t".join(COLUMNS), "\t".join(row), "a\tb")), "utf-8")
    (read,) = read_sentences(path)
    assert (read.home, read.words, read.category) == (("kitchen", "hall"), "off home", "which")


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_same_seed_draws_the_same_assignments(language: str) -> None:
    drawn = [[draw_assignment(Random(seed), language) for seed in range(50)] for _ in range(2)]
    assert drawn[0] == drawn[1]
    assert len({label for *_, label in drawn[0]}) > 25
