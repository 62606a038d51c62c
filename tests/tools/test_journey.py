"""Count the files that a goal and a tick enter, on the small site."""

from __future__ import annotations

import sys

from tools.journey import Tracer, bridge_files, planner_files
from wire.geometry import Pose2

ORDER = "go to the kitchen"


def test_only_files_whose_functions_run_below_the_folders_count() -> None:
    tracer = Tracer(("tools",))
    with tracer.tracing() as calls:
        Pose2(0.0, 0.0, 0.0)
        Tracer(("wire",))
    assert sys.getprofile() is None
    assert list(calls) == [] or set(calls) <= {"tools/journey.py"}


def test_a_goal_enters_planner_files_and_a_tick_the_step_of_the_core() -> None:
    planner = planner_files(ORDER, "two_room")
    assert planner
    assert all(name.startswith("planner/") for name in planner)
    bridge = bridge_files(ORDER, "two_room")
    assert {"bridge/core/step.py", "bridge/core/motion/limiter.py"} <= set(bridge)
    assert all(name.startswith("bridge/") for name in bridge)
