"""Obey an operator who puts another fence in force: proof first, only while nothing has torque.

The core judges proof, mode and place; reading outlines and writing the file is done beside the
loop, which answers by :class:`FenceDone`. What is written counts from the bridge's next start, so
between the two nobody can arm. Knows no file.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.authority.requests import bad_proof, settle, use_nonce, verdict_on
from bridge.core.state_orders import PendingFence
from wire import Mode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bridge.core.inbox import FenceArrival, FenceDone
    from bridge.core.tick_context import TickContext

KIND = "fence"
STANDING_S = 0.5


def hear_fence(tick: TickContext, arrived: FenceArrival) -> None:
    """Take one request, or give it its verdict; one id gets one verdict."""
    asked = tick.s.fence_asked
    if verdict_on(tick, KIND, arrived.id) is not None:
        return
    if asked is not None and asked.id == arrived.id:
        return  # being written; it is repeated until then
    refusal = next(_against(tick, arrived), None)
    here = tick.robot_in_map
    if refusal is not None or here is None:
        code, detail = refusal or ("robot_unlocated", "where the robot stands is not known")
        settle(tick, KIND, arrived.id, code, detail)
        return
    use_nonce(tick, KIND, arrived.id)
    tick.s.fence_asked = PendingFence(arrived.id, arrived.source, arrived.text, here)
    tick.say("fence_asked", f"by {arrived.source}")


def hear_done(tick: TickContext, done: FenceDone) -> None:
    """Give the verdict on the fence that was being written."""
    asked = tick.s.fence_asked
    if asked is None or asked.id != done.id or asked.written:
        return
    settle(tick, KIND, done.id, done.code, done.detail)
    if done.code == "ok":
        tick.s.fence_asked = replace(asked, text="", written=True)
        tick.say("fence_accepted", f"by {asked.source}: {done.detail}")
    else:
        tick.s.fence_asked = None
        tick.say("fence_refused", f"{done.code}: {done.detail}")


def _against(tick: TickContext, arrived: FenceArrival) -> Iterator[tuple[str, str]]:
    """Yield code and detail of each objection to a fence request; the first one decides."""
    if tick.stopped:
        yield "stopped", "a stop came in the same tick; ask again"
    yield from bad_proof(tick, KIND, arrived.id, arrived.nonce, authentic=arrived.authentic)
    mode = tick.s.mode
    if mode is not Mode.DISARMED:
        yield (
            "not_disarmed",
            f"mode is {mode.value}; a fence changes only in DISARMED: disarm first",
        )
    if tick.s.fence_asked is not None:
        yield "fence_busy", "another fence is being put in force; the bridge starts anew with it"
    if not tick.still_for(STANDING_S):
        yield "not_standing", f"the robot must have stood for {STANDING_S} s"
    if tick.robot_in_map is None:
        yield "robot_unlocated", "where the robot stands is not known, so it may be outside"
