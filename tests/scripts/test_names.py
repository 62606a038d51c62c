"""Hold names and first lines to the house's rules; what stood before may only become less."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from scripts import names


def found_in(**sources: str) -> set[str]:
    return set(names.findings({f"{name}.py": text for name, text in sources.items()}))


def test_nothing_new_breaks_the_rules_and_the_list_holds_nothing_that_is_gone() -> None:
    try:
        found = names.findings(names.read_tracked())
    except (FileNotFoundError, subprocess.CalledProcessError):
        pytest.skip("not a git checkout")
    here, known = names.counts(found), names.read_known(names.KNOWN.read_text("utf-8"))
    new = {what: found[what] for what in here - known}
    assert not new, "give these a name of the field (CONTRIBUTING.md)"
    gone = dict(known - here)
    assert not gone, "well done: `python -m scripts.names --write` takes them out of the list"


@pytest.mark.parametrize(
    "name", ["taken", "_shown", "where", "Kept", "still", "rounded", "whoever"]
)
def test_a_bare_participle_pronoun_or_adverb_is_found(name: str) -> None:
    assert names.is_odd(name)


@pytest.mark.parametrize(
    "name", ["speed", "is_held", "read", "seed", "take", "let", "Pose2", "__exit__"]
)
def test_a_noun_a_verb_or_a_phrase_is_none(name: str) -> None:
    assert not names.is_odd(name)


def test_functions_methods_and_classes_are_looked_at() -> None:
    text = "def taken(): ...\nclass Kept:\n  async def _apart(self): ...\n"
    assert found_in(a=text) == {"def taken", "class Kept", "def _apart"}


def test_events_may_be_participles() -> None:
    assert found_in(events="class Submitted: ...\n") == set()
    assert found_in(other="class Submitted: ...\n") == {"class Submitted"}


def test_a_class_name_stands_once_in_the_tree() -> None:
    assert found_in(a="class Leg: ...\n", b="class Leg: ...\n") == {"twice Leg"}


def test_a_first_line_names_its_subject() -> None:
    assert found_in(a='"""What is said."""\n') == {"docstring a"}
    assert found_in(a='def f():\n  """Who asks, waits."""\n') == {"docstring f"}
    assert found_in(a='def f():\n  """Whole numbers only."""\n') == set()


def test_the_list_reads_back_and_counts() -> None:
    known = names.read_known("# head\ndef taken 3\ntwice Leg 2\n")
    assert known == {"def taken": 3, "twice Leg": 2}


def test_the_list_is_sorted(repository: Path) -> None:
    lines = (repository / "tests/scripts/known_names.txt").read_text("utf-8").splitlines()[2:]
    assert lines == sorted(lines)
