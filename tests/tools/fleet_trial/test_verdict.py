"""Judge journals that are written by hand: each kind of wrong is seen, and none where none is."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest

from tools.fleet_trial.verdict import TrialVerdict, judge

Goal = tuple[str, int, Sequence[str]]
"""Its id, its order's number, its states; each comes a second after the one before it."""
RIGHT: Goal = ("g1", 100, ("planning", "running", "succeeded"))


def verdict_of(
    folder: Path,
    journals: Mapping[str, Sequence[Goal]],
    rows: Sequence[tuple[str, int, str]],
    accepted: Mapping[int, Sequence[str]],
) -> TrialVerdict:
    """Write journals and rows down, and judge them."""
    for name, goals in journals.items():
        (folder / name).mkdir()
        with sqlite3.connect(folder / name / "missions.db") as disk:
            disk.execute("CREATE TABLE missions (id TEXT, record TEXT)")
            disk.execute("CREATE TABLE idempotency_keys (goal TEXT)")
            disk.execute("CREATE TABLE transitions (seq INTEGER PRIMARY KEY, mission TEXT, "
                         "state TEXT, at_unix_s REAL, record TEXT)")  # fmt: skip
            for goal, number, states in goals:
                write_goal(disk, goal, number, states)
        disk.close()
    with sqlite3.connect(folder / "fleet.sqlite") as disk:
        disk.execute("CREATE TABLE fleet_missions (id TEXT, text TEXT, state TEXT)")
        for mission, number, state in rows:
            text = f"go to the kitchen and say {number}"
            disk.execute("INSERT INTO fleet_missions VALUES (?, ?, ?)", (mission, text, state))
    disk.close()
    homes = [folder / name for name in journals]
    return judge(accepted, homes, f"sqlite:///{folder / 'fleet.sqlite'}")


def write_goal(disk: sqlite3.Connection, goal: str, number: int, states: Sequence[str]) -> None:
    """Write a goal by its id: ``…-`` has no key, ``…m`` drove, ``…s`` said something."""
    steps = [{"state": "skipped"}, {"state": "succeeded" if "s" in goal else "skipped"}]
    text, second_s = f"go to the kitchen and say {number}", 0.0
    record: dict[str, Any] = {"id": goal, "text": text, "plan": {"steps": steps}}
    for state in states:
        second_s += 100.0 if state == "later" else 1.0
        if state == "later":
            continue
        drove = "m" in goal or state == "succeeded"
        record |= {"state": state, "metres": 0.5 if drove else 0.0}
        disk.execute(
            "INSERT INTO transitions (mission, state, at_unix_s, record) VALUES (?, ?, ?, ?)",
            (goal, state, second_s, json.dumps(record)),
        )
    disk.execute("INSERT INTO missions VALUES (?, ?)", (goal, json.dumps(record)))
    if not goal.endswith("-"):
        disk.execute("INSERT INTO idempotency_keys VALUES (?)", (goal,))


def test_what_went_right_is_clean(tmp_path: Path) -> None:
    verdict = verdict_of(
        tmp_path, {"r1": [RIGHT], "r2": []}, [("m1", 100, "succeeded")], {100: ["m1"]}
    )
    assert verdict.is_clean


LATER: Goal = ("g1", 100, ("later", "planning", "running", "succeeded"))
TAKEN_BACK = ("planning", "running", "cancelled")


def test_a_goal_that_a_slow_disk_refused_is_told_and_no_fault(tmp_path: Path) -> None:
    verdict = verdict_of(
        tmp_path,
        {"r1": [("g0-", 100, TAKEN_BACK), LATER]},
        [("m1", 100, "succeeded")],
        {100: ["m1"]},
    )
    assert verdict.is_clean
    assert verdict.taken_back == (100,)


@pytest.mark.parametrize(
    "journals",
    [
        {"r1": [("g0m-", 100, TAKEN_BACK), LATER]},  # it drove
        {"r1": [("g0s-", 100, TAKEN_BACK), LATER]},  # it said something
        {"r1": [("g0", 100, TAKEN_BACK), LATER]},  # under a key of its own
        {"r1": [("g0-", 100, TAKEN_BACK)], "r2": [LATER]},  # at another robot
        {"r1": [("g0-", 100, ("later", *TAKEN_BACK)), RIGHT]},  # not ended when the other began
    ],
)
def test_a_true_double_is_never_taken_for_one_that_was_taken_back(
    tmp_path: Path, journals: dict[str, list[Goal]]
) -> None:
    verdict = verdict_of(tmp_path, journals, [("m1", 100, "succeeded")], {100: ["m1"]})
    assert (verdict.begun_twice, verdict.given_twice) == ((100,), (100,))
    assert verdict.taken_back == ()


@pytest.mark.parametrize(
    ("journals", "rows", "wrong"),
    [
        ({"r1": []}, [], "lost"),
        ({"r1": []}, [("m1", 100, "offered")], "lost"),
        ({"r1": [RIGHT], "r2": [("g9", 100, ("running", "cancelled"))]},
         [("m1", 100, "succeeded")], "begun_twice"),
        ({"r1": [RIGHT, ("g2", 100, ("queued",))]}, [("m1", 100, "succeeded")], "given_twice"),
        ({"r1": [RIGHT]}, [("m1", 100, "succeeded"), ("m2", 100, "waiting")], "given_twice"),
        ({"r1": [RIGHT]}, [("m1", 100, "unknown")], "without_end"),
        ({"r1": [RIGHT]}, [("m1", 100, "failed")], "told_wrong"),
        ({"r1": []}, [("m1", 100, "succeeded")], "told_wrong"),
    ],
)  # fmt: skip
def test_each_kind_of_wrong_is_seen(
    tmp_path: Path,
    journals: dict[str, list[Goal]],
    rows: list[tuple[str, int, str]],
    wrong: str,
) -> None:
    verdict = verdict_of(tmp_path, journals, rows, {100: ["m1"]})
    assert getattr(verdict, wrong) == (100,)
