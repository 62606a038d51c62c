"""Obey people: stops, arm, disarm, estop, reset, resume. Stops are levels and never refused.

One id gets one verdict; repeats change nothing until the robot is let go again. Arm, reset and
resume need a proof whose HMAC fits (judged where the bytes were read) under a nonce that still
counts (:mod:`bridge.core.authority.requests`). Objections to arming and to a reset are accepting
conditions, all named.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.authority.epoch import hold, new_epoch, release
from bridge.core.authority.ownership import forget_arming, renew_budgets, void_hand_budget
from bridge.core.authority.requests import (
    bad_proof,
    forget_stops,
    settle,
    use_nonce,
    verdict_on,
    void_nonces,
)
from bridge.core.faults.fault_latch import clear_on_arm, clear_on_reset
from bridge.core.faults.fault_table import ALL, STAGES, Clears
from bridge.core.modes import selftest
from bridge.core.modes.mode_table import LATCHED, Fact, RequestCause
from bridge.core.modes.transition import go
from bridge.core.sensing.sensor_update import recorder_lack
from bridge.core.sensing.stop_inputs import latch_order, pressed_input
from wire import SEVERITY, Action, HeldReason, Mode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bridge.core.inbox import OperatorArrival
    from bridge.core.tick_context import TickContext

_PROVEN = frozenset({"arm", "reset", "resume"})


def hear_stops(tick: TickContext) -> None:
    """Obey every stop that is new; many at once are one change of epoch."""
    for stop in tick.inbox.stops:
        if verdict_on(tick, "stop", stop.id) is None:
            settle(tick, "stop", stop.id, "ok", f"by {stop.source}")
            if not tick.stopped:
                new_epoch(tick, "stop")
            tick.stopped = True
            hold(tick, HeldReason.STOP, stop.id)
    if tick.stopped:
        void_nonces(tick)
        void_hand_budget(tick)
        go(tick, RequestCause.STOP, "stop")


def hear_op(tick: TickContext, op: OperatorArrival) -> None:
    """Give one request its verdict, and obey it if that is ok."""
    if verdict_on(tick, op.kind, op.request.id) is not None:
        return
    refusal = next(_against(tick, op), None)
    if refusal is None:
        _OBEY[op.kind](tick, op.request.id)
        settle(tick, op.kind, op.request.id, "ok", f"by {op.request.source}")
    else:
        settle(tick, op.kind, op.request.id, *refusal)


def estop(tick: TickContext, why: str) -> None:
    """Latch the protective stop, in a new epoch; said again, it changes nothing."""
    if go(tick, RequestCause.ESTOP, why):
        void_nonces(tick)
        new_epoch(tick, "estop")


def _against(tick: TickContext, op: OperatorArrival) -> Iterator[tuple[str, str]]:
    """Yield code and detail of each objection to an operator's request; the first one decides."""
    if op.kind in _PROVEN:
        if tick.stopped:
            yield "stopped", "a stop came in the same tick; ask again"
        proof = op.request.proof
        nonce = proof.nonce if proof is not None else None
        yield from bad_proof(tick, op.kind, op.request.id, nonce, authentic=op.authentic)
    if op.kind == "arm":
        yield from arm_lacks(tick)
    elif op.kind == "reset":
        yield from reset_lacks(tick)


def _arm(tick: TickContext, request_id: str) -> None:
    use_nonce(tick, "arm", request_id)
    forget_stops(tick)
    release(tick)
    clear_on_arm(tick)
    new_epoch(tick, "armed")
    renew_budgets(tick)
    forget_arming(tick)
    go(tick, RequestCause.ARM, "arm")


def _disarm(tick: TickContext, _request_id: str) -> None:
    void_nonces(tick)
    go(tick, RequestCause.DISARM, RequestCause.DISARM)


def _estop(tick: TickContext, _request_id: str) -> None:
    latch_order(tick, ordered=True)
    if tick.s.mode is Mode.ESTOPPED:
        void_nonces(tick)  # latched already: what is said again ends a reset signed before it
    estop(tick, "estop")


def _reset(tick: TickContext, request_id: str) -> None:
    use_nonce(tick, "reset", request_id)
    forget_stops(tick)
    latch_order(tick, ordered=False)
    clear_on_reset(tick)
    if tick.s.selftest.passed:
        go(tick, RequestCause.RESET, "reset")
    else:
        selftest.enter(tick, Fact.UNPROVEN_RESET, "reset")


def _resume(tick: TickContext, request_id: str) -> None:
    use_nonce(tick, "resume", request_id)
    forget_stops(tick)
    release(tick)
    renew_budgets(tick)


_OBEY = {"arm": _arm, "disarm": _disarm, "estop": _estop, "reset": _reset, "resume": _resume}


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
    fence, here = tick.fence, tick.robot_in_map
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
