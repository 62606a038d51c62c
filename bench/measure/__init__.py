"""List the measurements in the order in which they run: the cheapest first."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from bench import endpoint
from bench.measure import (
    brain_silent,
    brains_compared,
    clone_to_url,
    codec_fuzz,
    core_step,
    detector_map,
    fault_times,
    find_objects,
    flood,
    footprint,
    goal_to_waypoint,
    hostile_planner,
    journal_kills,
    lockstep_speed,
    memory_ticks,
    mock_faults,
    object_position,
    offline_brain,
    page,
    picture_signs,
    planner_silent,
    replay_hour,
    stop_under_load,
    streaming,
    suite_time,
    tick_lateness,
    tick_stress,
    unexplained_stops,
    vision_overhead,
    voice,
    walls_and_people,
    wheel_tracking,
)

if TYPE_CHECKING:
    from bench.lab import Measure

ALL: tuple[Measure, ...] = cast(
    "tuple[Measure, ...]",
    (
        core_step,
        lockstep_speed,
        tick_lateness,
        footprint,
        goal_to_waypoint,
        endpoint,
        brains_compared,
        streaming,
        offline_brain,
        voice,
        vision_overhead,
        detector_map,
        object_position,
        page,
        brain_silent,
        planner_silent,
        journal_kills,
        fault_times,
        codec_fuzz,
        mock_faults,
        picture_signs,
        find_objects,
        memory_ticks,
        walls_and_people,
        hostile_planner,
        tick_stress,
        flood,
        stop_under_load,
        unexplained_stops,
        replay_hour,
        wheel_tracking,
        clone_to_url,
        suite_time,
    ),
)
