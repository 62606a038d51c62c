"""Check that the list of all kinds of steps is the union's own."""

from __future__ import annotations

from planner.plan import CONDITIONS, DRIVES, EVERY_KIND, NEEDS_CAMERA, PLAN, RUNNABLE


def test_every_kind_is_what_a_plan_may_hold() -> None:
    shapes = PLAN.json_schema()["$defs"].values()
    kinds = {
        shape["properties"].get("kind", {}).get("const")
        for shape in shapes
        if "properties" in shape
    }
    assert kinds - {None, "plan", "answer", "clarify", "refuse"} == EVERY_KIND | CONDITIONS
    assert RUNNABLE | NEEDS_CAMERA | DRIVES <= EVERY_KIND
