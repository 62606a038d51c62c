"""Judge journals that are written by hand: each kind of wrong is seen, and none where none is."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import pytest

from tools.fleet_trial.verdict import TrialVerdict, judge

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

Goal = tuple[str, int, Sequence[str]]
"""Its id, its order's number, its states."""
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
            disk.execute("CREATE TABLE transitions (mission TEXT, state TEXT, at_unix_s REAL)")
            for goal, number, states in goals:
                text = f"go to the kitchen and say {number}"
                record: dict[str, Any] = {"id": goal, "text": text, "state": states[-1]}
                if states[-1] == "idle":
                    step = {"state": "skipped"}
                    record |= {"state": "cancelled", "metres": 0.0, "plan": {"steps": [step]}}
                disk.execute("INSERT INTO missions VALUES (?, ?)", (goal, json.dumps(record)))
                for state in states:
                    disk.execute("INSERT INTO transitions VALUES (?, ?, 0.0)", (goal, state))
        disk.close()
    with sqlite3.connect(folder / "fleet.sqlite") as disk:
        disk.execute("CREATE TABLE fleet_missions (id TEXT, text TEXT, state TEXT)")
        for mission, number, state in rows:
            text = f"go to the kitchen and say {number}"
            disk.execute("INSERT INTO fleet_missions VALUES (?, ?, ?)", (mission, text, state))
    disk.close()
    homes = [folder / name for name in journals]
    return judge(accepted, homes, f"sqlite:///{folder / 'fleet.sqlite'}")


def test_what_went_right_is_clean(tmp_path: Path) -> None:
    verdict = verdict_of(
        tmp_path, {"r1": [RIGHT], "r2": []}, [("m1", 100, "succeeded")], {100: ["m1"]}
    )
    assert verdict.is_clean


def test_a_goal_that_a_slow_disk_refused_has_not_begun(tmp_path: Path) -> None:
    verdict = verdict_of(
        tmp_path,
        {"r1": [RIGHT, ("g0", 100, ("planning", "running", "cancelled", "idle"))]},
        [("m1", 100, "succeeded")],
        {100: ["m1"]},
    )
    assert (verdict.begun_twice, verdict.told_wrong) == ((), ())
    assert verdict.given_twice == (100,)  # and it is told all the same


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
