"""Detect motors that draw too much and a battery that runs low, where the drive reports them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.geometry.debounce import LONGEST_S, filled

if TYPE_CHECKING:
    from bridge.core.faults.fault_latch import Dirty
    from bridge.core.tick_context import Tick

PEAK_S = 0.1
HEAT_S = 2.0
"""So long a motor bears its peak current, as heat, before it must rest."""
LOW, EMPTY, UP = 0.20, 0.10, 0.05
CHARGE_S = 2.0
_ROWS = frozenset({"BATTERY.0", "BATTERY.1"})


def current(tick: Tick, dirty: Dirty) -> None:
    """Judge the motors' current: its peak, and the heat that I^2 t leaves (IEC 60034-11)."""
    state, watch, drive = tick.s.drive.newest, tick.s.watch, tick.config.robot.drive
    if state is None or state.current_a is None:
        return
    drawn, peak = abs(state.current_a), drive.peak_current_a
    watch.peak_s = filled(watch.peak_s, tick.dt_s, PEAK_S, dirty=not drawn <= peak)
    bearable = drive.continuous_current_a * drive.continuous_current_a
    full = HEAT_S * (peak * peak - bearable)
    heat = watch.heat_a2s + (drawn * drawn - bearable) * min(tick.dt_s, LONGEST_S)
    watch.heat_a2s = min(max(heat, 0.0), full)
    if watch.peak_s >= PEAK_S:
        dirty.append(("OVERCURRENT.0", f"{drawn:.1f} A, at most {peak:.1f}"))
    elif full > 0.0 and watch.heat_a2s >= full:
        dirty.append(("OVERCURRENT.0", f"{drawn:.1f} A for too long"))


def battery(tick: Tick, dirty: Dirty) -> None:
    """Judge the charge; a row that is up stays until the charge is well above its limit again."""
    state, watch, rows = tick.s.drive.newest, tick.s.watch, tick.s.rows
    if state is None:
        return
    if state.battery is None:  # no news is no charge: what is up stays as it was
        dirty.extend((name, up.evidence) for name, up in rows.items() if name in _ROWS)
        return
    charge, dt_s = state.battery, tick.dt_s
    if charge >= LOW + UP and watch.low_s == watch.empty_s == 0.0:
        return
    watch.low_s = filled(watch.low_s, dt_s, CHARGE_S, dirty=not charge >= LOW)
    watch.empty_s = filled(watch.empty_s, dt_s, CHARGE_S, dirty=not charge >= EMPTY)
    if watch.low_s >= CHARGE_S or ("BATTERY.0" in rows and not charge >= LOW + UP):
        dirty.append(("BATTERY.0", f"{100 * charge:.0f} %"))
    if watch.empty_s >= CHARGE_S or ("BATTERY.1" in rows and not charge >= EMPTY + UP):
        dirty.append(("BATTERY.1", f"{100 * charge:.0f} %"))
