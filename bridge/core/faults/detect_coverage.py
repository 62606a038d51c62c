"""Detect a lidar that is covered or gone, and a zone that says how fast one may drive in it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.geometry.debounce import filled
from wire import Mode

if TYPE_CHECKING:
    from bridge.core.faults.fault_latch import Dirty
    from bridge.core.tick_context import Tick

BLIND_SHARE = 0.05
BLIND_S, BLIND_LONG_S = 0.3, 5.0


def blind(tick: Tick, dirty: Dirty) -> None:
    """Judge how many beams come back, beside what is normal here; none at all is never normal."""
    lidar, watch = tick.s.lidar, tick.s.watch
    if lidar.picture is None:
        return
    normal = lidar.baseline_returns
    sees = lidar.picture.returns >= max(1.0, BLIND_SHARE * normal)
    if sees and watch.blind_s == 0.0:
        return
    watch.blind_s = filled(watch.blind_s, tick.dt_s, BLIND_LONG_S, dirty=not sees)
    if watch.blind_s >= BLIND_S and not sees:
        evidence = f"{lidar.picture.returns} of {lidar.picture.beams} beams, normally {normal:.0f}"
        dirty.append(("LIDAR_BLIND.0", evidence))
        if watch.blind_s >= BLIND_LONG_S:
            dirty.append(("LIDAR_BLIND.1", evidence))


def no_range(tick: Tick, dirty: Dirty) -> None:
    """Judge whether anything watches for obstacles: a lidar that has spoken, and still does."""
    if tick.s.mode in {Mode.BOOT, Mode.SELFTEST}:
        return  # which wait for the first scan
    if tick.s.lidar.newest is None or "LIDAR_STALE.1" in tick.s.rows:
        for stage in ("NO_RANGE.0", "NO_RANGE.1"):
            dirty.append((stage, "the lidar says nothing"))


def zone(tick: Tick, dirty: Dirty) -> None:
    """Find the slowest zone that the robot is in; ``cap`` takes its value."""
    fence, here, watch = tick.config.fence, tick.robot_in_map, tick.s.watch
    watch.zone_mps = None
    if fence is None or not fence.zones or here is None:
        return
    watch.zone_mps = fence.max_speed_mps(here.x_m, here.y_m)
    if watch.zone_mps is not None:
        dirty.append(("SPEED_ZONE.0", f"at most {watch.zone_mps:.2f} m/s here"))
