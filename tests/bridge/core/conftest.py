"""Mark the core's quick suite: all that needs no hypothesis and no long drive, about 2 s in all."""

from __future__ import annotations

import pytest
from hypothesis import settings

# Coverage asks for lines, not for luck: few examples of each law, the same ones each time.
settings.register_profile("coverage", deadline=None, derandomize=True, max_examples=4)

QUICK = frozenset(
    """
    test_ages_and_docs test_branches test_drive_out test_enumerated test_fence test_freespace
    test_horizon test_kinematics test_limiter test_modes test_numbers test_odometry test_path
    test_quick_core test_quick_corners test_scanpicture test_stopcurve test_wheelcontrol
    test_window_edges
    """.split()  # noqa: SIM905  # one name a word reads better
)
LONG = (
    "never_exceeds",
    "harder_row",
    "three_rows",
    "every_pair",
    "BRAIN_GONE",
    "LIDAR_STALE.1",
    "NO_RANGE",
    "LIDAR_BLIND.1",
    "BATTERY",
    "LOOP_LATE.2",
    "YAW",
    "STUCK",
    "stop_wins",
    "wall",
    "drives_along",
)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark what belongs to ``-m core_quick``."""
    for item in items:
        test = getattr(item, "obj", None)
        plain = not getattr(test, "is_hypothesis_test", False)
        quick = item.path.stem in QUICK or item.path.stem.endswith("_exact")
        if quick and plain and not any(part in item.name for part in LONG):
            item.add_marker("core_quick")
