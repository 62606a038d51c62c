"""Ends, waits and calls are counted once each, whatever is told twice."""

from __future__ import annotations

from typing import Any

from prometheus_client import generate_latest

from planner.watching import MOST_GOALS, PlannerFigures


def goal(state: str, goal_id: str = "g1", **outcome: Any) -> tuple[int, dict[str, Any]]:
    told = {"id": goal_id, "state": state, "outcome": outcome or None}
    return 1, {"type": "goal", "goal": told}


def value(figures: PlannerFigures, name: str, **labels: str) -> float | None:
    return figures.registry.get_sample_value(name, labels)


def test_an_end_is_counted_once_with_its_code() -> None:
    figures = PlannerFigures(lambda: 0.0)
    for _ in range(3):
        figures.offer(goal("succeeded", code="arrived", seconds=12.0))
    figures.offer(goal("failed", "g2"))
    assert value(figures, "pons_goals_ended_total", state="succeeded", code="arrived") == 1.0
    assert value(figures, "pons_goals_ended_total", state="failed", code="none") == 1.0
    assert value(figures, "pons_goal_seconds_sum", state="succeeded") == 12.0


def test_the_wait_for_the_first_waypoint_is_told_from_acceptance_and_from_the_plan() -> None:
    now = [10.0]
    figures = PlannerFigures(lambda: now[0])
    figures.offer(goal("planning"))
    figures.offer(goal("running"))
    now[0] = 10.25
    figures.offer(goal("running"))
    figures.offer((2, {"type": "first_waypoint", "goal": "g1", "seconds": 1.5}))
    assert value(figures, "pons_first_waypoint_seconds_sum") == 1.5
    assert value(figures, "pons_plan_to_first_waypoint_seconds_sum") == 0.25
    figures.offer((3, {"type": "first_waypoint", "goal": "unknown", "seconds": 1.0}))
    assert value(figures, "pons_plan_to_first_waypoint_seconds_count") == 1.0


def test_rows_are_counted_by_kind() -> None:
    figures = PlannerFigures(lambda: 0.0)
    told = (("row_up", "POSE_LOST.0 none"), ("row_down", "POSE_LOST.0"), ("row_up", "X"))
    for code, detail in told:
        figures.offer((1, {"type": "bridge", "event": {"code": code, "detail": detail}}))
    assert value(figures, "pons_fault_rows_total", row="POSE_LOST") == 1.0
    assert value(figures, "pons_fault_rows_total", row="X") == 1.0
    assert value(figures, "pons_bridge_events_total", code="row_down") == 1.0


def test_a_models_calls_are_counted_with_their_tokens() -> None:
    figures = PlannerFigures(lambda: 0.0)
    figures.model_call("g1", 1.5, 1_300, 80)
    assert value(figures, "pons_model_call_seconds_count") == 1.0
    assert value(figures, "pons_model_tokens_total", way="prompt") == 1_300.0
    assert value(figures, "pons_model_tokens_total", way="reply") == 80.0


def test_what_is_remembered_is_bounded_and_other_events_are_passed() -> None:
    figures = PlannerFigures(lambda: 0.0)
    for number in range(3 * MOST_GOALS):
        figures.offer(goal("running", f"g{number}"))
    figures.offer((1, {"type": "progress", "goal": "g1"}))
    figures.close()
    assert len(figures._known) == len(figures._planned_s) == MOST_GOALS
    assert b"pons_goals_ended" in generate_latest(figures.registry)
