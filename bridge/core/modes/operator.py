"""Obey people: stops, arm, disarm, estop, reset, resume. Stops are levels and never refused.

One id gets one verdict; repeats change nothing. Arm, reset and resume need a proof whose HMAC fits
(judged where the bytes were read) under a nonce that still counts
(:mod:`bridge.core.authority.requests`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.authority.epoch import hold, new_epoch, release
from bridge.core.authority.ownership import forget_arming, renew_budgets, void_hand_budget
from bridge.core.authority.requests import bad_proof, settle, use_nonce, verdict_on, void_nonces
from bridge.core.faults.fault_latch import clear_on_arm, clear_on_reset
from bridge.core.modes import selftest
from bridge.core.modes.arming import arm_lacks, reset_lacks
from bridge.core.modes.mode_table import Fact, RequestCause
from bridge.core.modes.transition import go
from bridge.core.sensing.stop_inputs import latch_order
from wire import HeldReason, Mode

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
    latch_order(tick, ordered=False)
    clear_on_reset(tick)
    if tick.s.selftest.passed:
        go(tick, RequestCause.RESET, "reset")
    else:
        selftest.enter(tick, Fact.UNPROVEN_RESET, "reset")


def _resume(tick: TickContext, request_id: str) -> None:
    use_nonce(tick, "resume", request_id)
    release(tick)
    renew_budgets(tick)


_OBEY = {"arm": _arm, "disarm": _disarm, "estop": _estop, "reset": _reset, "resume": _resume}
