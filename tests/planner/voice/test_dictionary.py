"""What the dictionary knows, and what is left of it for one site."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.voice.dictionary import Dictionary


@pytest.fixture
def known(tmp_path: Path) -> Dictionary:
    path = tmp_path / "words.dict"
    path.write_text("bathroom B AE TH\nread R IY D\nread(2) R EH D\nreads R IY D Z\n", "utf-8")
    return Dictionary(path)


def test_a_word_is_kept_in_all_the_ways_it_is_said_and_no_other(known: Dictionary) -> None:
    assert known.cut(["read", "read", "unheard"]) == "read R IY D\nread(2) R EH D\n"


def test_what_the_model_lacks_is_added(known: Dictionary) -> None:
    assert "settee" in known
    assert "sofa" not in known
    assert known.cut(["bathroom"]).splitlines()[1].startswith("bathroom(2) B AA")


def test_without_a_dictionary_it_raises(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="none"):
        Dictionary(tmp_path / "none.dict")
