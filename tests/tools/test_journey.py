"""Count the files that a goal and a tick enter, on the small site."""

from __future__ import annotations

import re
import sys

from tools.journey import (
    BRIDGE_FILES,
    EXPRESSIONS,
    FILES,
    FUNCTIONS,
    Tracer,
    bridge_files,
    planner_journey,
)
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
    planner = planner_journey(ORDER, "two_room").calls
    assert planner
    assert all(name.startswith("planner/") for name in planner)
    bridge = bridge_files(ORDER, "two_room")
    assert {"bridge/core/step.py", "bridge/core/motion/limiter.py"} <= set(bridge)
    assert all(name.startswith("bridge/") for name in bridge)


def test_the_way_of_a_sentence_and_of_a_scan_grows_no_longer() -> None:
    """The limits in ``tools/journey.py`` are ratchets: who shortens the way lowers them."""
    walked = planner_journey(ORDER)
    assert len(walked.calls) <= FILES.most
    assert len(walked.functions) <= FUNCTIONS.most
    assert walked.expressions <= EXPRESSIONS.most
    assert len(bridge_files(ORDER)) <= BRIDGE_FILES.most


def test_a_function_counts_once_and_each_use_of_an_expression() -> None:
    tracer = Tracer(("tests",))
    pattern = re.compile("a")
    with tracer.tracing():
        _search_twice(pattern)
        _search_twice(pattern)
    assert len(tracer.functions) == 1
    assert tracer.expressions == 4


def _search_twice(pattern: re.Pattern[str]) -> None:
    pattern.search("a")
    pattern.search("b")
