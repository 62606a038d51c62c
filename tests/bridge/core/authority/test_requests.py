"""Hold nonces and verdicts: how long each lasts, and that no proof works twice."""

from __future__ import annotations

from dataclasses import replace

from bridge.core import Inbox
from bridge.core.authority import requests
from bridge.core.state_orders import TimedAnswer
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import at
from tests.bridge.core.table import table
from wire import Answer

EPS = 1e-6


@table(("age_s", "renewed"), [(60.0 - EPS, False), (60.0, True)])
def test_a_nonce_lasts_for_a_minute_and_the_old_one_ten_seconds_more(
    age_s: float, renewed: bool
) -> None:
    tick = at("disarmed")
    tick.now_s = 100.0
    tick.s.operator = replace(tick.s.operator, nonce_made_s=tick.now_s - age_s)
    tick.inbox = Inbox(chance="c" * 16)
    before = tick.s.operator
    requests.renew_nonce(tick)
    after = tick.s.operator
    assert after == (
        replace(
            before,
            nonce_no=before.nonce_no + 1,
            nonce_tag="c" * 16,
            nonce_made_s=tick.now_s,
            old_nonce_no=before.nonce_no,
            old_tag=before.nonce_tag,
            old_until_s=tick.now_s + 10.0,
        )
        if renewed
        else before
    )
    if renewed:
        old = f"b0.{before.nonce_no}.{before.nonce_tag}"
        assert requests.old_nonce_text(tick) == old
        for more_s, codes in ((10.0, []), (EPS, ["old_nonce"])):
            tick.now_s += more_s
            told = requests.bad_proof(tick, "arm", "a1", old, authentic=True)
            assert [code for code, _ in told] == codes


def test_a_proof_is_used_once_under_either_nonce() -> None:
    tick = at("disarmed")
    tick.inbox = Inbox(chance="c" * 16)
    requests.renew_nonce(tick)
    tick.now_s += 60.0
    requests.renew_nonce(tick)
    now, old = tick.s.operator.nonce_no, tick.s.operator.old_nonce_no
    assert old is not None
    requests.use_nonce(tick, "arm", "a1")
    assert {f"{now} arm a1", f"{old} arm a1"} <= set(tick.s.operator.accepted)
    text = requests.old_nonce_text(tick)
    for request_id, codes in (("a1", ["repeated"]), ("a2", [])):
        told = requests.bad_proof(tick, "arm", request_id, text, authentic=True)
        assert [code for code, _ in told] == codes
    for count in range(40):
        requests.use_nonce(tick, "arm", f"b{count}")
    assert len(tick.s.operator.accepted) == 16
    assert tick.s.operator.accepted[-1].endswith("b39")


def quiet() -> TickContext:
    """Return a tick in which nobody has been answered or refused anything yet."""
    tick = at()
    tick.s.operator = replace(tick.s.operator, answers=(), refusals=())
    return tick


def test_64_verdicts_are_remembered_and_the_newest_16_shown() -> None:
    tick = quiet()
    for number in range(70):
        requests.settle(tick, "arm", f"a{number}", "ok" if number % 2 else "stopped", "d" * 500)
    kept = [item.answer for item in tick.s.operator.answers]
    assert [answer.id for answer in kept] == [f"a{number}" for number in range(6, 70)]
    assert [answer.accepted for answer in kept[:2]] == [False, True]
    assert requests.answers_to_echo(tick) == tuple(kept[-16:])
    assert kept[0].detail == "d" * 400
    assert tick.events[-1] == ("answered", "arm a69 ok")
    assert requests.verdict_on(tick, "arm", "a6") is kept[0]
    assert requests.verdict_on(tick, "arm", "a5") is None
    assert requests.verdict_on(tick, "reset", "a6") is None


@table(("age_s", "settled", "refused"), [(1.0, 1, 1), (1.05, 1, 0), (10.0, 1, 0), (10.5, 0, 0)])
def test_a_verdict_is_shown_for_10_s_and_a_refusal_for_1(
    age_s: float, settled: int, refused: int
) -> None:
    tick = quiet()
    answer = Answer(id="a", kind="arm", accepted=True, code="ok", detail="")
    both = (TimedAnswer(tick.now_s, answer),)
    tick.s.operator = replace(tick.s.operator, answers=both, refusals=both)
    tick.now_s += age_s
    assert len(requests.answers_to_echo(tick)) == settled + refused


def test_of_refusals_the_newest_of_each_sender_counts_and_eight_in_all() -> None:
    tick = quiet()
    for number in range(12):
        requests.refuse_openly(tick, "hello", f"p{number}", "owned", "by another")
    senders = [item.answer.id for item in tick.s.operator.refusals]
    assert senders == [f"p{number}" for number in range(4, 12)]
    assert len(tick.events) == 12
    requests.refuse_openly(tick, "hello", "p11", "owned", "by another")
    assert len(tick.events) == 12, "the same again is no news"
    requests.refuse_openly(tick, "hello", "p11", "moving", "wait")
    assert tick.events[12:] == [("hello_refused", "p11 moving wait")]
    requests.refuse_openly(tick, "grant", "p11", "moving", "wait")
    last = [(item.answer.kind, item.answer.id) for item in tick.s.operator.refusals][-2:]
    assert last == [("hello", "p11"), ("grant", "p11")], "of one sender one of each kind"
    requests.settle_openly(tick, "hello", "p11")
    left = [(item.answer.kind, item.answer.id) for item in tick.s.operator.refusals]
    assert ("hello", "p11") not in left
    assert left[-1] == ("grant", "p11")
    assert len(left) == 7
