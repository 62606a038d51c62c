"""List the objections to arming and to a reset. Accepting conditions, all named."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.faults.fault_table import ALL, STAGES, Clears
from bridge.core.modes.mode_table import LATCHED
from bridge.core.sensing.sensor_update import recorder_lack
from bridge.core.sensing.stop_inputs import pressed_input
from wire import SEVERITY, Action, Mode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bridge.core.tick_context import TickContext

STANDING_S = 0.5
CLEAN_S = 2.0
STICK_S = 0.25
_OF_THE_BRAIN = "BRAIN_GONE"


def arm_lacks(tick: TickContext) -> Iterator[tuple[str, str]]:
    """Yield code and detail of each thing that keeps the robot disarmed."""
    if tick.s.mode is not Mode.DISARMED:
        yield "not_disarmed", f"mode is {tick.s.mode.value}; arming starts from DISARMED"
        return
    yield from ready_lacks(tick)


def ready_lacks(tick: TickContext) -> Iterator[tuple[str, str]]:
    """Yield the conditions of arming that do not depend on the mode."""
    s = tick.s
    if s.fence_asked is not None:
        yield (
            "fence_changing",
            "another fence is being put in force; the bridge starts anew with it",
        )
    for name, up in s.rows.items():
        stage = STAGES[name]
        everyones = stage.binds == ALL or stage.row.startswith("LIDAR_")
        if stage.row == _OF_THE_BRAIN:
            continue  # it ends with the arming that it asks for
        stops = SEVERITY[stage.action] >= SEVERITY[Action.HOLD2]
        clean_s = CLEAN_S if stage.clears is Clears.ON_RESET else tick.dt_s
        if everyones and stops and not tick.now_s - up.dirty_s > clean_s:
            yield stage.row.lower(), up.evidence
    if s.lidar.received_s is None:
        yield "lidar_stale", "no scan has come yet"
    if not tick.still_for(STANDING_S):
        yield "not_standing", f"the robot must have stood for {STANDING_S} s"
    pressed_s = s.stick.pressed_s
    if pressed_s is not None and not tick.now_s - pressed_s > STICK_S:
        yield "stick_not_neutral", "somebody holds a dead-man"
    if not s.loop.recorder_ok:
        yield recorder_lack(tick.inbox)


def is_outside_fence(tick: TickContext) -> bool:
    """Tell whether the robot is known to stand where its fence allows nobody.

    It is said, and keeps nobody from arming: a stick that is to bring it back needs torque.
    """
    fence, here = tick.config.fence, tick.robot_in_map
    return fence is not None and here is not None and not fence.allows(here.x_m, here.y_m)


def reset_lacks(tick: TickContext) -> Iterator[tuple[str, str]]:
    """Yield code and detail of each thing that keeps a latched mode latched."""
    s = tick.s
    if s.mode not in LATCHED:
        yield "not_latched", f"mode is {s.mode.value}; only ESTOPPED and FAULT are reset"
        return
    if pressed_input(tick) is not None:
        yield "estop_pressed", pressed_input(tick) or ""
    pressed_s = s.buttons.pressed_s
    if pressed_s is not None and not tick.now_s - pressed_s >= CLEAN_S:
        yield "estop_just_released", f"the input must have been free for {CLEAN_S} s"
    if not tick.still_for(STANDING_S):
        yield "not_standing", f"the robot must have stood for {STANDING_S} s"
    for name, up in s.rows.items():
        stage = STAGES[name]
        latched = stage.clears is Clears.ON_RESET and stage.row != "ESTOP"
        if latched and not tick.now_s - up.dirty_s >= CLEAN_S:
            yield stage.row.lower(), f"its detector must be clean for {CLEAN_S} s"
