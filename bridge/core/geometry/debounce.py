"""Fill a window while trouble is seen and drain it four times as slowly: dither hides nothing.

A detector that flickers between yes and no, one to one, still fills its window, in 8/3 of the time.
"""

from __future__ import annotations

DRAIN = 0.25
LONGEST_S = 0.05
"""What one tick may add: a loop that slept has not watched."""


def fill(level_s: float, dt_s: float, top_s: float, *, dirty: bool) -> float:
    """Return the window's new level [s], from 0 to ``top_s``."""
    step_s = min(max(dt_s, 0.0), LONGEST_S)
    level_s = level_s + step_s if dirty else max(0.0, level_s - DRAIN * step_s)
    return min(level_s, top_s)
