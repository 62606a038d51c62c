"""A file is read apart: what it does to its reader is told and does nothing to us."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest

from tools.attack.file_kinds import KINDS
from tools.attack.files import file_outcome, outcome_of
from tools.attack.lab import ChildEnd
from tools.attack.unsound import Unsound

pytestmark = [
    pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning"),
    pytest.mark.nightly(keep=6),
]
"""The fork only reads one file and ends; threads of the test's own process are nothing to it."""


class Refusal(Exception):
    code = "no"


class Bare(Exception):
    pass


def refuse() -> None:
    raise Refusal


def refuse_bare() -> None:
    raise Bare


def crash() -> None:
    raise Unsound("x")


def spin() -> None:
    while True:
        pass


def die() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def grow() -> int:
    return len(bytes(range(256)) * 1_200_000)


def test_a_reading_is_read_or_refused_by_code() -> None:
    assert outcome_of(lambda: 1, (Refusal,))[0] == "read"
    assert outcome_of(refuse, (Refusal,))[0] == "refused"


def test_what_else_is_raised_is_named() -> None:
    assert outcome_of(crash, (Refusal,))[0].startswith("Unsound at test_files.py")
    assert outcome_of(refuse_bare, (Bare,))[0] == "Bare without a code"


def test_a_reader_that_dies_or_never_ends_is_told() -> None:
    assert outcome_of(die, ())[0] == "died of -9"
    assert outcome_of(spin, (), limit_s=1)[0] == "took over 1 s"


def test_memory_is_counted() -> None:
    what, grown_mb = outcome_of(grow, ())
    assert what == "read"
    assert grown_mb > 90.0, "of 307; the system may take some of the fork's pages back meanwhile"


def test_a_child_that_said_nothing_is_a_finding() -> None:
    assert file_outcome(KINDS[0], ChildEnd(-11, "", "Segmentation fault")).wrong == 1
    fine = ChildEnd(0, '{"counts": {"read": 2, "refused": 3}, "most_mb": 1, "slowest_s": 0.1}', "")
    assert (file_outcome(KINDS[0], fine).n, file_outcome(KINDS[0], fine).is_met) == (5, True)
    bad = ChildEnd(0, '{"counts": {"read": 2, "X at y": 3}, "most_mb": 1, "slowest_s": 0.1}', "")
    assert file_outcome(KINDS[0], bad).wrong == 3


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: str(kind.name))
def test_each_good_file_is_taken_or_refused_by_its_reader(kind: object, tmp_path: Path) -> None:
    assert kind in KINDS
    at = next(i for i, each in enumerate(KINDS) if each is kind)
    folder = tmp_path / "two_room"
    folder.mkdir()
    read, refusals = KINDS[at].load()
    KINDS[at].beside(folder)
    for data in KINDS[at].seeds():
        (folder / KINDS[at].file).write_bytes(data)
        assert outcome_of(lambda: read(folder), refusals)[0] in {"read", "refused"}
