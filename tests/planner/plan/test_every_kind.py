"""Check that the lists of kinds of steps are the union's own."""

from __future__ import annotations

from planner.plan import (
    CALLS,
    CONDITIONS,
    DRIVES,
    EVERY_KIND,
    GIVEN,
    NEEDS_CAMERA,
    PLAN,
    RUNNABLE,
    TOOL_CALLS,
)


def test_every_kind_is_what_a_plan_may_hold() -> None:
    shapes = PLAN.json_schema()["$defs"].values()
    kinds = {
        shape["properties"].get("kind", {}).get("const")
        for shape in shapes
        if "properties" in shape
    }
    kinds -= {None, "plan", "answer", "clarify", "refuse"}
    assert kinds == EVERY_KIND | GIVEN | CONDITIONS | CALLS | TOOL_CALLS
    assert RUNNABLE | NEEDS_CAMERA | DRIVES - GIVEN <= EVERY_KIND
    assert not EVERY_KIND & (GIVEN | CALLS | TOOL_CALLS)
