"""What fuzzers say becomes a line of the table, silence included."""

from __future__ import annotations

import json

from tools.attack.contract import CHECKS, judge_report, taking_json
from tools.attack.decoding import blind_outcome, guided_outcome
from tools.attack.lab import ChildEnd, side_by_side

FINE = {"n": 5, "taken": 3, "crashes": 0, "hangs": 0, "slowest_ms": 1.0, "before_mb": 1.0,
        "after_mb": 2.0, "kinds": {}}  # fmt: skip


def ended(record: dict[str, object]) -> ChildEnd:
    return ChildEnd(0, f"words\n{json.dumps(record)}\n", "")


def test_a_fuzzer_that_found_nothing_meets_its_goal() -> None:
    assert blind_outcome("wav", ended(FINE)).is_met


def test_crashes_hangs_growth_and_silence_do_not() -> None:
    for change in ({"crashes": 1}, {"hangs": 1}, {"after_mb": 12.0}, {"n": 0}):
        assert not blind_outcome("wav", ended({**FINE, **change})).is_met
    assert not blind_outcome("wav", ChildEnd(None, "", "")).is_met
    assert not blind_outcome("wav", ChildEnd(-11, "half a line", "Segmentation fault")).is_met


def test_a_guided_fuzzer_ends_with_its_count_or_its_crash() -> None:
    fine = guided_outcome("wav", ChildEnd(0, "", "stat::number_of_executed_units: 70\n"))
    assert (fine.n, fine.is_met) == (70, True)
    bad = guided_outcome(
        "wav", ChildEnd(77, "", "KeyError: 1\nstat::number_of_executed_units: 7\n")
    )
    assert (bad.n, bad.is_met) == (7, False)


def test_a_child_that_ends_is_heard_and_one_that_does_not_is_killed() -> None:
    quick = ("timeit", "-n1", "-r1", "pass")
    endless = ("timeit", "-n1", "-r1", "-s", "import time; time.sleep(60)", "pass")
    assert [(at, ended.status) for at, ended in side_by_side([quick], 60.0)] == [(0, 0)]
    assert [(at, ended.status) for at, ended in side_by_side([endless], 0.2)] == [(0, None)]


def test_each_check_of_the_contract_has_a_line() -> None:
    failure = {"type": "ServerError", "count": 2, "operations": ["GET /a"]}
    other = {"type": "Odd", "count": 1, "operations": []}
    report = {"complete": True, "test_cases": {"generated": 9}, "failures": [failure, other]}
    found = judge_report(report, "here", 1.0, 2.0)
    assert [(each.attack, each.wrong) for each in found] == [
        *((check, 2 if kind == "ServerError" else 0) for check, kind in CHECKS.items()),
        ("Odd", 1),
    ]


def test_half_a_report_is_a_goal_missed() -> None:
    assert not judge_report(None, "here", 1.0, 1.0)[0].is_met
    assert not judge_report({"complete": False}, "here", 1.0, 1.0)[0].is_met


def test_routes_that_take_json_are_found() -> None:
    assert "/v1/goals" in taking_json()
    assert "/v1/voice" not in taking_json()
