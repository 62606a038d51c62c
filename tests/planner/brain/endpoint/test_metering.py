"""Check that each HTTP call is counted, however it ends, and that none goes out unpaid."""

from __future__ import annotations

import asyncio
import contextlib
import json
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

import httpx
import pytest

from planner.brain import BadPlan, BrainDown, OutOfBudget, ThinkRequest
from planner.brain.endpoint import EndpointBrain
from planner.brain.endpoint.metering import read_usage, tokens_of
from planner.budget import Ledger, Purse, Usage
from planner.plan import Vocabulary
from planner.settings import BudgetSettings, GoalLimits
from tests.planner.brain.endpoint.servers import GO, Answer, Server, answer, raw, settings, wrote

MOST = 1000
FAILURES = (BrainDown, BadPlan)


def metered(
    server: Server, home: Path, words: Vocabulary, calls: int = 9, goal: str = "g1", **more: Any
) -> Usage:
    """Think once, with a budget of so many calls; return the meter."""

    async def once() -> Usage:
        purse = Purse(
            BudgetSettings(goal=GoalLimits(calls=calls)), Ledger.in_home(home), most_reply=MOST
        )
        made = EndpointBrain(
            settings(**more), home, transport=httpx.MockTransport(server), meter=purse
        )
        request = ThinkRequest(text="go to the kitchen", vocabulary=words, goal=goal)
        with contextlib.suppress(*FAILURES):
            await made.think(request)
        usage = purse.usage(goal)
        await made.close()
        purse.close()
        return usage

    return asyncio.run(once())


def said(prompt: int, reply: int, total: int) -> httpx.Response:
    usage = {"prompt_tokens": prompt, "completion_tokens": reply, "total_tokens": total}
    words = 'I claim "usage": {"prompt_tokens": 1, "completion_tokens": 0} and more'
    message = {"content": GO, "reasoning": words}
    return answer({"choices": [{"message": message}], "usage": usage})


EVENTS = {"content-type": "text/event-stream"}
FIGURES = '{"prompt_tokens":7,"completion_tokens":3,"total_tokens":10}'
SAID = f'data: {{"choices":[],"usage":{FIGURES}}}\n\n'
DONE = "data: [DONE]\n\n"


def streamed(*pieces: str, end: str = DONE) -> Answer:
    """Return a stream as servers send it: some 200 bytes around each piece."""
    shell = {"id": "chatcmpl-" + "x" * 90, "object": "chat.completion.chunk", "model": "m" * 40}
    choices = [{"index": 0, "delta": {"content": piece}} for piece in pieces]
    choices.append({"index": 0, "delta": {}, "finish_reason": "stop"})
    lines = [f"data: {json.dumps({**shell, 'choices': [choice]})}\r\n\r\n" for choice in choices]
    return raw(("".join(lines) + ": awake\n\n" + end).encode(), headers=EVENTS)


class Cut(httpx.AsyncByteStream):
    """Send bytes and lose the connection."""

    def __init__(self, sent: str) -> None:
        self._sent = sent.encode()

    async def __aiter__(self) -> AsyncIterator[bytes]:
        yield self._sent
        raise httpx.ReadError("reset")


def cut(text: str) -> Answer:
    return httpx.Response(200, stream=Cut(text), headers=EVENTS)


BABBLE = 'data: {"choices":[{"delta":{"content":"data: [DONE]"}}]}\n\n'


@pytest.mark.parametrize(
    ("answers", "calls", "prompt", "reply"),
    [
        ((said(1234, 56, 1290),), 1, 1234, 56),
        ((said(1234, 56, 1390),), 1, 1234, 156),  # thoughts that only the total holds
        ((wrote("nonsense"), said(10, 5, 15)), 2, None, None),  # the repair turn
        ((wrote("nonsense"),), 5, None, None),  # each way of asking, then the repair
        ((answer({"error": "busy"}, 503), said(10, 5, 15)), 2, 10, 5),
        ((answer({"error": "no"}, 401),), 1, 0, 0),
        ((answer({"error": "unsupported response_format"}, 400), said(10, 5, 15)), 2, 10, 5),
        ((httpx.ConnectError("refused"),), 1, 0, 0),
        ((httpx.ReadTimeout("slow"),), 1, None, MOST),
        ((httpx.ReadError("reset"),), 2, None, 2 * MOST),
        ((raw(b"x" * 40),), 1, None, 10),
        ((raw(b"x" * 2_000_000),), 1, None, MOST),
        ((streamed(*GO),), 1, None, len(GO) + 1),  # a token each, not 60 for what is around it
        ((streamed(GO, end=SAID + DONE),), 1, 7, 3),
        ((streamed("", GO * 3),), 1, None, 58),  # 180 characters, a third more where escaped
        ((cut(BABBLE + SAID),), 1, None, MOST),  # what it says before it is cut is not believed
        ((cut(BABBLE + SAID + DONE), said(10, 5, 15)), 2, 17, 8),
        ((raw(b"", 307, {"location": "http://169.254.169.254/"}),), 1, 0, 0),
    ],
)
def test_what_is_counted(
    answers: tuple[Answer, ...],
    calls: int,
    prompt: int | None,
    reply: int | None,
    tmp_path: Path,
    home: Vocabulary,
) -> None:
    server = Server(*answers)
    usage = metered(server, tmp_path, home)
    assert usage.goal is not None
    assert (usage.goal.calls, usage.under_way) == (len(server.requests), 0)
    assert usage.goal.calls == calls
    estimate = sum(tokens_of(request.content) for request in server.requests)
    assert usage.goal.prompt_tokens == prompt or (
        prompt is None and 0 < usage.goal.prompt_tokens <= estimate
    )
    assert reply is None or usage.goal.reply_tokens == reply


def test_a_spent_budget_sends_nothing(tmp_path: Path, home: Vocabulary) -> None:
    server = Server(wrote("nonsense"))
    assert metered(server, tmp_path, home, calls=0).today.calls == 0
    assert server.requests == []
    assert metered(server, tmp_path, home, calls=1).today.calls == 1  # no repair turn
    assert len(server.requests) == 1
    assert metered(server, tmp_path, home, calls=1).refused is not None
    assert len(server.requests) == 1
    assert metered(server, tmp_path, home, calls=1, goal="g2").today.calls == 2


def test_a_call_that_is_cut_is_paid_in_full(tmp_path: Path, home: Vocabulary) -> None:
    async def hangs(_: httpx.Request) -> httpx.Response:
        await asyncio.sleep(60.0)
        raise AssertionError

    class Hanging(Server):
        __call__ = staticmethod(hangs)  # type: ignore[assignment]  # a server that never answers

    usage = metered(Hanging(), tmp_path, home, timeout_s=0.5)
    assert (usage.today.calls, usage.today.reply_tokens, usage.under_way) == (1, MOST, 0)


async def test_no_call_goes_out_that_no_goal_asked_for(tmp_path: Path) -> None:
    server = Server(said(1, 1, 2))
    purse = Purse(BudgetSettings(), Ledger.in_home(tmp_path))
    made = EndpointBrain(settings(), tmp_path, transport=httpx.MockTransport(server), meter=purse)
    with pytest.raises(OutOfBudget):
        await made._client.post({}, 1.0)
    assert (server.requests, purse.usage().idle_calls) == ([], 1)
    await made.close()
    purse.close()


def test_reading_a_bill() -> None:
    usage = '"usage":{"prompt_tokens":7,"completion_tokens":2,"total_tokens":9}'
    assert read_usage(f"{{{usage}}}".encode()) == (7, 2)
    stream = f'data: {{"usage":{{"prompt_tokens":7,"completion_tokens":1}}}}\n\ndata: {{{usage}}}'
    assert read_usage(stream.encode()) == (7, 2)
    assert read_usage(b'{"usage": {"input_tokens": 7, "output_tokens": 2}}') == (7, 2)
    assert read_usage(json.dumps({"content": usage}).encode()) is None
    for written in ({"kind": "say", "usage": {"prompt_tokens": 0, "completion_tokens": 0}}, "{}"):
        calls = json.dumps({"tool_calls": [{"function": {"arguments": written}}]})
        assert read_usage(calls.encode()) is None  # a model's own words are no bill
    assert read_usage(
        json.dumps({"arguments": usage, "usage": json.loads(f"{{{usage}}}")}).encode()
    ) == (7, 2)
    for odd in ("", '"prompt_tokens": 7}', '"prompt_tokens": 99999999999, "total_tokens": 1}'):
        assert read_usage(odd.encode()) is None


def test_tokens_are_estimated_on_the_high_side() -> None:
    assert tokens_of(b"four plain words, no more") == 6
    assert tokens_of("去厨房看看有没有人".encode()) == 9
    assert tokens_of(b"") == 0
