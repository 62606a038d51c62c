"""Obey people: stops, arm, disarm, estop, reset, resume. Stops are levels and never refused.

One id gets one verdict; repeats change nothing. Arm, reset and resume need a proof whose HMAC fits
(judged where the bytes were read) under a nonce that still counts
(:mod:`bridge.core.authority.requests`).
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.authority.epoch import hold, turn
from bridge.core.authority.grants import operator_acted
from bridge.core.authority.requests import bad_proof, settle, use_nonce, verdict_on, void_nonces
from bridge.core.faults.fault_latch import clear_on_arm, clear_on_reset
from bridge.core.modes.arming import arm_lacks, reset_lacks
from bridge.core.modes.mode_table import Fact, Request
from bridge.core.modes.transition import go
from wire import HeldReason, Mode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bridge.core.inbox import OpArrived
    from bridge.core.tick_context import Tick

_PROVEN = frozenset({"arm", "reset", "resume"})


def hear_stops(tick: Tick) -> None:
    """Obey every stop that is new; many at once are one change of epoch."""
    for stop in tick.inbox.stops:
        if verdict_on(tick, "stop", stop.id) is None:
            settle(tick, "stop", stop.id, "ok", f"by {stop.source}")
            if not tick.stopped:
                turn(tick, "stop")
            tick.stopped = True
            hold(tick, HeldReason.STOP, stop.id)
    if tick.stopped:
        void_nonces(tick)
        go(tick, Request.STOP, "stop")


def hear_op(tick: Tick, op: OpArrived) -> None:
    """Give one request its verdict, and obey it if that is ok."""
    if verdict_on(tick, op.kind, op.request.id) is not None:
        return
    refusal = next(_against(tick, op), None)
    if refusal is None:
        _OBEY[op.kind](tick, op.request.id)
        settle(tick, op.kind, op.request.id, "ok", f"by {op.request.source}")
    else:
        settle(tick, op.kind, op.request.id, *refusal)


def estop(tick: Tick, why: str) -> None:
    """Latch the protective stop, in a new epoch; said again, it changes nothing."""
    if go(tick, Request.ESTOP, why):
        void_nonces(tick)
        turn(tick, "estop")


def _against(tick: Tick, op: OpArrived) -> Iterator[tuple[str, str]]:
    """Yield code and detail of what speaks against a request, the first one decides."""
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


def _arm(tick: Tick, request_id: str) -> None:
    use_nonce(tick, "arm", request_id)
    tick.s.held = None
    clear_on_arm(tick)
    turn(tick, "armed")
    tick.s.grants = replace(operator_acted(tick.s.grants), since_arm=False)
    go(tick, Request.ARM, "arm")


def _disarm(tick: Tick, _request_id: str) -> None:
    void_nonces(tick)
    go(tick, Request.DISARM, Request.DISARM)


def _estop(tick: Tick, _request_id: str) -> None:
    tick.s.buttons = replace(tick.s.buttons, ordered=True)
    if tick.s.mode is Mode.ESTOPPED:
        void_nonces(tick)  # latched already: what is said again ends a reset signed before it
    estop(tick, "estop")


def _reset(tick: Tick, request_id: str) -> None:
    use_nonce(tick, "reset", request_id)
    tick.s.buttons = replace(tick.s.buttons, ordered=False)
    clear_on_reset(tick)
    go(tick, Request.RESET if tick.s.selftest.passed else Fact.UNPROVEN_RESET, "reset")


def _resume(tick: Tick, request_id: str) -> None:
    use_nonce(tick, "resume", request_id)
    tick.s.held = None
    tick.s.grants = operator_acted(tick.s.grants)


_OBEY = {"arm": _arm, "disarm": _disarm, "estop": _estop, "reset": _reset, "resume": _resume}
