"""Keep the nonces that proofs are made for, the verdict of each request, and an asked-for fence.

Requests by id (stops, operator requests) are settled once. What makes the robot stand (stop, estop,
disarm) is a repeat only for as long as senders repeat, and never across what let the robot go:
senders whose ids come again must still be able to stop it. Hello and grant are asked again on each
status, so for them only the newest refusal is shown, and only for a while. Memory is
bounded by count; time alone would let a flood grow it. Nobody can foretell a nonce, so that no
proof can be collected for later: it is made of the chance that the shell drew for the tick that
first shows it.

Another fence is put in force by proof first, and only while nothing has torque: judged here are
proof, mode and place; reading outlines and writing the file is done beside the loop, which answers
by :class:`FenceDone`. What is written counts from the bridge's next start, so between the two
nobody can arm. Knows no file.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.state_orders import PendingFence, TimedAnswer
from wire import Answer, Mode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bridge.core.inbox import FenceArrival, FenceDone
    from bridge.core.state_orders import Operator
    from bridge.core.tick_context import TickContext

KEPT = 64
SHOWN = 16
"""Newest verdicts in a status: several senders may be waiting, the message must stay small."""
SHOWN_S = 10.0
REPEATED_S = 5.0
"""Senders repeat for 2 s. A stop that comes later under a known id is another person's."""
STOPPING = frozenset({"stop", "estop", "disarm"})
REFUSAL_S = 1.0
"""A refusal of hello or grant that is not repeated is over."""
_REFUSALS = 8
_DETAIL = 400


def verdict_on(tick: TickContext, kind: str, request_id: str) -> Answer | None:
    """Return the verdict of which this request is a repeat."""
    return find_verdict(tick.s.operator, kind, request_id, tick.now_s)


def find_verdict(operator: Operator, kind: str, request_id: str, now_s: float) -> Answer | None:
    """Return the verdict that still counts for this kind of request under this id."""
    for answered in operator.answers:
        counts = kind not in STOPPING or now_s - answered.at_s <= REPEATED_S
        if counts and _is_from(answered, kind, request_id):
            return answered.answer
    return None


def forget_stops(tick: TickContext) -> None:
    """Let each stop be new: the robot may move again, and no old id may keep it from stopping."""
    operator = tick.s.operator
    left = tuple(item for item in operator.answers if item.answer.kind not in STOPPING)
    tick.s.operator = replace(operator, answers=left)


def settle(tick: TickContext, kind: str, request_id: str, code: str, detail: str = "") -> None:
    """Give the verdict: ``ok``, or the reason why not."""
    answer = _answer(kind, request_id, code, detail)
    operator = tick.s.operator
    others = tuple(item for item in operator.answers if not _is_from(item, kind, request_id))
    answers = (*others[-(KEPT - 1) :], TimedAnswer(tick.now_s, answer))
    tick.s.operator = replace(operator, answers=answers)
    tick.say("answered", f"{kind} {request_id} {code}")


def refuse_openly(tick: TickContext, kind: str, sender: str, code: str, detail: str) -> None:
    """Show why a hello or a grant is not taken, as long as it keeps being asked."""
    tick.drop(f"{kind}_{code}")
    operator = tick.s.operator
    answer = _answer(kind, sender, code, detail)
    others = tuple(item for item in operator.refusals if not _is_from(item, kind, sender))
    known = any(item.answer == answer for item in operator.refusals)
    refusals = (*others[-(_REFUSALS - 1) :], TimedAnswer(tick.now_s, answer))
    tick.s.operator = replace(operator, refusals=refusals)
    if not known:
        tick.say(f"{kind}_refused", f"{sender} {code} {detail}".strip())


def settle_openly(tick: TickContext, kind: str, sender: str) -> None:
    """Forget the refusals of one sender: it is taken now."""
    operator = tick.s.operator
    if operator.refusals:
        left = tuple(item for item in operator.refusals if not _is_from(item, kind, sender))
        tick.s.operator = replace(operator, refusals=left)


def answers_to_echo(tick: TickContext) -> tuple[Answer, ...]:
    """Return the answers that the next status echoes, oldest first."""
    operator = tick.s.operator
    settled = [
        item.answer for item in operator.answers[-SHOWN:] if tick.now_s - item.at_s <= SHOWN_S
    ]
    refused = [item.answer for item in operator.refusals if tick.now_s - item.at_s <= REFUSAL_S]
    return (*settled, *refused)


def _is_from(item: TimedAnswer, kind: str, sender: str) -> bool:
    return item.answer.id == sender and item.answer.kind == kind


def _answer(kind: str, request_id: str, code: str, detail: str) -> Answer:
    return Answer(
        id=request_id, kind=kind, accepted=code == "ok", code=code, detail=detail[:_DETAIL]
    )


NONCE_S = 60.0


OLD_NONCE_S = 10.0


_ACCEPTED = 16


def nonce_text(tick: TickContext) -> str:
    """Return the nonce that counts now, as it is on the wire: boot, number and chance."""
    operator = tick.s.operator
    return f"{tick.config.boot}.{operator.nonce_no}.{operator.nonce_tag}"


def old_nonce_text(tick: TickContext) -> str | None:
    """Return the nonce before, while orders signed under it may still arrive."""
    operator = tick.s.operator
    if operator.old_nonce_no is None or not tick.now_s <= operator.old_until_s:
        return None
    return f"{tick.config.boot}.{operator.old_nonce_no}.{operator.old_tag}"


def renew_nonce(tick: TickContext) -> None:
    """Change the nonce every 60 s, so that a proof once made does not lie about for long."""
    operator = tick.s.operator
    if operator.nonce_no == 0:
        void_nonces(tick)  # the run's first: there is none before it
    elif not tick.now_s - operator.nonce_made_s < NONCE_S:
        _next_nonce(tick)


def bad_proof(
    tick: TickContext, kind: str, request_id: str, nonce: str | None, *, authentic: bool
) -> Iterator[tuple[str, str]]:
    """Yield code and detail of each fault of a proof: its HMAC, its nonce, or a second use."""
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


def use_nonce(tick: TickContext, kind: str, request_id: str) -> None:
    """Spend the nonce: the one now shown stays valid for a moment, for orders already signed."""
    operator = tick.s.operator
    used = tuple(
        f"{number} {kind} {request_id}"
        for number in (operator.nonce_no, operator.old_nonce_no)
        if number is not None
    )
    tick.s.operator = replace(operator, accepted=(*operator.accepted, *used)[-_ACCEPTED:])
    _next_nonce(tick)


def void_nonces(tick: TickContext) -> None:
    """Let no proof from before a stop end what the stop began, however late it arrives.

    A request is repeated until it is echoed, so one that was signed before may come after.
    """
    _next_nonce(tick)
    tick.s.operator = replace(tick.s.operator, old_nonce_no=None, old_tag="")


def _next_nonce(tick: TickContext) -> None:
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
