"""Obey people: stops, arm, disarm, estop, reset, resume. Stops are levels and never refused.

One id gets one verdict; repeats change nothing. Arm, reset and resume need a proof whose HMAC fits
(judged where the bytes were read) under a nonce that still counts (judged here). Nobody can
foretell a nonce, so that no proof can be collected for later: it is made of the chance that the
shell drew for the tick that first shows it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.authority.epoch import hold, turn
from bridge.core.authority.grants import operator_acted
from bridge.core.authority.request_answers import settle, verdict_on
from bridge.core.faults.fault_latch import clear_on_arm, clear_on_reset
from bridge.core.modes.arming import arm_lacks, reset_lacks
from bridge.core.modes.mode_table import Fact, Request
from bridge.core.modes.transition import go
from wire import HeldReason, Mode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bridge.core.inbox import OpArrived
    from bridge.core.tick_context import Tick

NONCE_S = 60.0
OLD_NONCE_S = 10.0
_PROVEN = frozenset({"arm", "reset", "resume"})
_ACCEPTED = 16


def nonce_text(tick: Tick) -> str:
    """Return the nonce that counts now, as it is on the wire: boot, number and chance."""
    operator = tick.s.operator
    return f"{tick.config.boot}.{operator.nonce_no}.{operator.nonce_tag}"


def old_nonce_text(tick: Tick) -> str | None:
    """Return the nonce before, while what was signed under it may still arrive."""
    operator = tick.s.operator
    if operator.old_nonce_no is None or not tick.now_s <= operator.old_until_s:
        return None
    return f"{tick.config.boot}.{operator.old_nonce_no}.{operator.old_tag}"


def renew_nonce(tick: Tick) -> None:
    """Change the nonce every 60 s, so that a proof once made does not lie about for long."""
    operator = tick.s.operator
    if operator.nonce_no == 0:
        _void_nonces(tick)  # the run's first: there is none before it
    elif not tick.now_s - operator.nonce_made_s < NONCE_S:
        _next_nonce(tick)


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
        _void_nonces(tick)
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
        _void_nonces(tick)
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


def bad_proof(
    tick: Tick, kind: str, request_id: str, nonce: str | None, *, authentic: bool
) -> Iterator[tuple[str, str]]:
    """Yield code and detail of what is wrong with a proof: its HMAC, its nonce, or a second use."""
    if nonce is None or not authentic:
        yield "bad_proof", "the proof is missing or not made with this robot's operator key"
        return
    operator = tick.s.operator
    if nonce == nonce_text(tick) and operator.nonce_tag:
        number: int | None = operator.nonce_no
    elif nonce == old_nonce_text(tick) and operator.old_tag:
        number = operator.old_nonce_no
    else:
        yield "old_nonce", "the proof was made for a nonce that no longer counts; sign anew"
        return
    if f"{number} {kind} {request_id}" in operator.accepted:
        yield "repeated", "this proof was already used"


def use_nonce(tick: Tick, kind: str, request_id: str) -> None:
    """Spend the nonce: the one now shown stays valid for a moment, for what is already signed."""
    operator = tick.s.operator
    used = tuple(
        f"{number} {kind} {request_id}"
        for number in (operator.nonce_no, operator.old_nonce_no)
        if number is not None
    )
    tick.s.operator = replace(operator, accepted=(*operator.accepted, *used)[-_ACCEPTED:])
    _next_nonce(tick)


def _void_nonces(tick: Tick) -> None:
    """Let no proof from before a stop end what the stop began, however late it arrives.

    A request is repeated until it is echoed, so one that was signed before may come after.
    """
    _next_nonce(tick)
    tick.s.operator = replace(tick.s.operator, old_nonce_no=None, old_tag="")


def _next_nonce(tick: Tick) -> None:
    operator = tick.s.operator
    tick.s.operator = replace(
        operator,
        nonce_no=operator.nonce_no + 1,
        nonce_tag=tick.inbox.chance,
        nonce_made_s=tick.now_s,
        old_nonce_no=operator.nonce_no,
        old_tag=operator.nonce_tag,
        old_until_s=tick.now_s + OLD_NONCE_S,
    )


def _arm(tick: Tick, request_id: str) -> None:
    use_nonce(tick, "arm", request_id)
    tick.s.held = None
    clear_on_arm(tick)
    turn(tick, "armed")
    tick.s.grants = replace(operator_acted(tick.s.grants), since_arm=False)
    go(tick, Request.ARM, "arm")


def _disarm(tick: Tick, _request_id: str) -> None:
    _void_nonces(tick)
    go(tick, Request.DISARM, Request.DISARM)


def _estop(tick: Tick, _request_id: str) -> None:
    tick.s.buttons = replace(tick.s.buttons, ordered=True)
    if tick.s.mode is Mode.ESTOPPED:
        _void_nonces(tick)  # latched already: what is said again ends a reset signed before it
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
