"""Mark the core's quick suite: all that needs no hypothesis and no long drive, about 2 s in all."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import settings

# Coverage asks for lines, not for luck: few examples of each law, the same ones each time.
settings.register_profile("coverage", deadline=None, derandomize=True, max_examples=4)

STORIES = frozenset(
    """
    test_braking_learning test_detect_motion_windows test_detectors_edges test_detectors_windows
    test_external_velocity_story test_motion_gates_walls test_ownership_grants
    test_requests_fence test_sensor_update_lies test_step_story
    """.split()  # noqa: SIM905  # one name a word reads better
)
"""Files whose tests drive for seconds of the world's time."""
LONG = (
    "fed_forward_once",
    "hand_on_the_stick_crosses",
    "equal_scans",
    "blocked_way_is_forgotten",
    "fence_counts_what_was_learnt",
    "stop_voids_all",
    "stop_teaches",
    "wall",
    "drives_along",
    "it_arrives_and_stays",
    "made_good_not_orbited",
    "single_point_is_driven",
)


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Import nothing else where the quick suite alone is asked for: half of its time is imports."""
    test = collection_path.suffix == ".py" and collection_path.stem.startswith("test_")
    asked = config.option.markexpr == "core_quick"
    return True if test and asked and not _quick(collection_path) else None


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark what belongs to ``-m core_quick``."""
    for item in items:
        test = getattr(item, "obj", None)
        plain = not getattr(test, "is_hypothesis_test", False)
        drives = "World" in getattr(getattr(test, "__code__", None), "co_names", ())
        long = drives or any(part in item.name for part in LONG)
        if _quick(item.path) and plain and not long:
            item.add_marker("core_quick")


def _quick(test_file: Path) -> bool:
    long_laws = test_file.parent.name == "laws" and test_file.stem != "test_numbers"
    return not long_laws and test_file.stem not in STORIES
