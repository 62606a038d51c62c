"""List the measurements in the order in which they run: the cheapest first.

Each guards a number that README, docs/ or an ADR states. What was measured once stands in its ADR.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from tools.bench.measure import (
    blind_sector,
    clone_to_url,
    core_step,
    fault_times,
    footprint,
    foxglove_lateness,
    goal_to_waypoint,
    mcp_order,
    memory_recall,
    offline_brain,
    planner_silent,
    ros2_true,
    skill_saved,
    stop_under_load,
    stop_words,
    tick_lateness,
)

if TYPE_CHECKING:
    from tools.bench.context import Measure

ALL: tuple[Measure, ...] = cast(
    "tuple[Measure, ...]",
    (
        core_step,
        tick_lateness,
        footprint,
        goal_to_waypoint,
        offline_brain,
        stop_words,
        memory_recall,
        mcp_order,
        skill_saved,
        planner_silent,
        fault_times,
        blind_sector,
        stop_under_load,
        foxglove_lateness,
        ros2_true,
        clone_to_url,
    ),
)
