"""Keep answers: one id, one verdict, echoed in status until its sender has surely fallen silent.

Requests by id (stops, operator requests) are settled once and for all; hello and grant are asked
again on each status, so for them only the newest refusal is shown, and only for a while. Memory is
bounded by count; time alone would let a flood grow it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.state_orders import Answered
from wire import Answer

if TYPE_CHECKING:
    from bridge.core.tick_context import Tick

KEPT = 64
SHOWN = 16
"""Newest verdicts in a status: several senders may be waiting, the message must stay small."""
SHOWN_S = 10.0
REFUSAL_S = 1.0
"""A refusal of hello or grant that is not repeated is over."""
_REFUSALS = 8
_DETAIL = 400


def verdict_on(tick: Tick, kind: str, request_id: str) -> Answer | None:
    """Return the verdict that this id already got for this kind of request."""
    for answered in tick.s.operator.answers:
        if answered.answer.id == request_id and answered.answer.kind == kind:
            return answered.answer
    return None


def settle(tick: Tick, kind: str, request_id: str, code: str, detail: str = "") -> None:
    """Give the verdict: ``ok``, or the reason why not."""
    answer = _answer(kind, request_id, code, detail)
    operator = tick.s.operator
    answers = (*operator.answers[-(KEPT - 1) :], Answered(tick.now_s, answer))
    tick.s.operator = replace(operator, answers=answers)
    tick.say("answered", f"{kind} {request_id} {code}")


def refuse_openly(tick: Tick, kind: str, sender: str, code: str, detail: str) -> None:
    """Show why a hello or a grant is not taken, as long as it keeps being asked."""
    tick.drop(f"{kind}_{code}")
    operator = tick.s.operator
    answer = _answer(kind, sender, code, detail)
    others = tuple(item for item in operator.refusals if not _same(item, kind, sender))
    known = any(item.answer == answer for item in operator.refusals)
    refusals = (*others[-(_REFUSALS - 1) :], Answered(tick.now_s, answer))
    tick.s.operator = replace(operator, refusals=refusals)
    if not known:
        tick.say(f"{kind}_refused", f"{sender} {code} {detail}".strip())


def settle_openly(tick: Tick, kind: str, sender: str) -> None:
    """Forget the refusals of one sender: it is taken now."""
    operator = tick.s.operator
    if operator.refusals:
        left = tuple(item for item in operator.refusals if not _same(item, kind, sender))
        tick.s.operator = replace(operator, refusals=left)


def shown(tick: Tick) -> tuple[Answer, ...]:
    """Return what the next status echoes, oldest first."""
    operator = tick.s.operator
    settled = [
        item.answer for item in operator.answers[-SHOWN:] if tick.now_s - item.at_s <= SHOWN_S
    ]
    refused = [item.answer for item in operator.refusals if tick.now_s - item.at_s <= REFUSAL_S]
    return (*settled, *refused)


def _same(item: Answered, kind: str, sender: str) -> bool:
    return item.answer.id == sender and item.answer.kind == kind


def _answer(kind: str, request_id: str, code: str, detail: str) -> Answer:
    return Answer(
        id=request_id, kind=kind, accepted=code == "ok", code=code, detail=detail[:_DETAIL]
    )
