"""The judge of the journal's kills sees a lost goal and an effect that came twice."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tools.bench.journal_life import GONE_M, TURNED_RAD, judge
from tools.bench.measure.journal_kills import TWICE, _rows
from tools.bench.minimal_sim import MinimalBody

LEG, SAY = [0, "leg", "g1", 1, True], [0, "say", "g1", "one"]


def done() -> MinimalBody:
    body = MinimalBody()
    body.turned_rad, body.gone_m = TURNED_RAD, GONE_M
    return body


@pytest.mark.parametrize(
    ("lines", "wrong"),
    [
        ([LEG, SAY, [1, "leg", "g1", 2, True]], {}),
        ([[0, "accepted", "turn", "g1"]], {"lost": 1}),
        ([SAY, [1, "say", "g1", "one"]], {"said_twice": 1}),
        ([LEG, [1, "leg", "g1", 1, True]], {"legs_twice": 1}),
        ([LEG, [1, "leg", "g1", 2, False]], {"unasked": 1}),
        ([[1, "unasked"]], {"unasked": 1}),
    ],
)
def test_it_sees_what_went_wrong(
    tmp_path: Path, lines: list[list[Any]], wrong: dict[str, int]
) -> None:
    told = judge(lines, tmp_path, done())
    names = ("lost", "said_twice", "goals_twice", "legs_twice", "unasked", "way_twice")
    assert {name: told[name] for name in names if told[name]} == wrong


def test_a_leg_done_twice_shows_in_the_way(tmp_path: Path) -> None:
    body = done()
    body.turned_rad += 1.0
    assert judge([], tmp_path, body)["way_twice"] == 1
    body.gone_m -= 0.4
    assert judge([], tmp_path, body)["way_twice"] == 2


def test_a_row_tells_only_what_was_counted() -> None:
    told = {"kills": 1, "accepted": 3, "crashed": [], "lost": 0, "goals_twice": 0, "way_twice": 1,
            "unasked": 0}  # fmt: skip
    _, twice = _rows("real planner", [told])
    assert (twice.value, twice.note) == ("1", "goals_twice 0, way_twice 1, unasked 0")


@pytest.mark.slow
def test_a_planner_that_is_killed_loses_and_repeats_nothing(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "tools.bench.journal_life", str(tmp_path), "3", "1"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=50, check=True)
    stories = json.loads(done.stdout)
    assert sum(told["kills"] for told in stories) >= 1
    for told in stories:
        assert (told["crashed"], told["accepted"], told["lost"]) == ([], 3, 0)
        assert not any(told[name] for name in TWICE), told
