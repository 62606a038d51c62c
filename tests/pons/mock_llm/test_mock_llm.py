"""Check the mock as any client meets it, and every switch against the real endpoint client."""

from __future__ import annotations

import asyncio
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import psutil
import pytest
from pydantic import SecretStr

from planner.brain import (
    BadPlan,
    BrainDown,
    Draft,
    Hear,
    OfflineBrain,
    ThinkRequest,
    ThinkResult,
)
from planner.brain.endpoint import EndpointBrain
from planner.plan import GoTo, StepPlan, list_nodes
from planner.settings import ModelSettings
from tests.planner.brain.conftest import HOME
from tests.pons.mock_llm.faults import FAULTS, READABLE, BadSwitches
from tests.pons.mock_llm.mocks import RunningMock, running_mock

KITCHEN = StepPlan(steps=(GoTo(place="kitchen"),), asked_by=("go to the kitchen",))
KEY = "sk-test-0451-0451"
MEMORY_MB = 40.0
"""A thousand times less than what `huge` sends, and room for an interpreter's own moods."""


@pytest.fixture(scope="module")
def mock() -> Iterator[RunningMock]:
    """Serve one mock for the module's tests."""
    with running_mock() as served:
        yield served


def ask(
    mock: RunningMock,
    home: Path,
    text: str = "go to the kitchen",
    hear: Hear | None = None,
    **more: Any,
) -> ThinkResult:
    settings = {
        "url": mock.url,
        "name": "m",
        "key": KEY,
        "timeout_s": 5.0,
        "load_timeout_s": 0.0,
        **more,
    }

    return asyncio.run(thought(ModelSettings.model_validate(settings), home, text, hear))


async def thought(settings: ModelSettings, home: Path, text: str, hear: Hear | None) -> ThinkResult:
    brain = EndpointBrain(settings, home)
    try:
        request = ThinkRequest(text=text, vocabulary=HOME, room="study")
        return await brain.think(request, hear)
    finally:
        await brain.close()


@pytest.mark.parametrize(
    "text",
    [
        "go to the kitchen",
        "去厨房，然后等三秒",
        "go to the sofa, then say hello and come back",
        "where are you",
        "don't go to the kitchen",
        "go to the bedroom or the kitchen",
        "bring me a cup from the kitchen",
        "去客厅看看有没有人",
    ],
)
def test_it_plans_as_the_offline_brain_does(mock: RunningMock, text: str, tmp_path: Path) -> None:
    mock.set()
    by_model = ask(mock, tmp_path, text).plan
    request = ThinkRequest(text=text, vocabulary=HOME, room="study")
    by_grammar = asyncio.run(OfflineBrain().think(request)).plan
    assert by_model.kind == by_grammar.kind
    if isinstance(by_grammar, StepPlan):
        quoted = (text,) * len(list_nodes(by_grammar.steps))
        assert by_model == by_grammar.model_copy(update={"asked_by": quoted})
    else:
        assert getattr(by_model, "code", None) == getattr(by_grammar, "code", None)


@pytest.mark.parametrize("body", [b"", b"[]", b"{", b"\xff", b"[" * 100_000])
def test_what_is_no_request_gets_a_400(mock: RunningMock, body: bytes) -> None:
    mock.set()
    reply = mock.client.post(f"{mock.url}/chat/completions", content=body)
    assert reply.status_code == 400
    assert reply.json()["error"]["message"]


def test_forced_tool_stream_and_models_are_served_too(mock: RunningMock) -> None:
    mock.set()
    said = [{"role": "user", "content": "go to the lab"}]
    schema = {"properties": {"place": {"type": "string", "enum": ["lab"]}}}
    tool = {"type": "function", "function": {"name": "plan", "parameters": schema}}
    body = {"messages": said, "tools": [tool], "tool_choice": {"type": "function"}}
    url = f"{mock.url}/chat/completions"
    message = mock.client.post(url, json=body).json()["choices"][0]["message"]
    assert message["content"] is None
    step = {"kind": "go_to", "place": "lab", "because": "go to the lab"}
    plan = {"kind": "plan", "steps": [step]}
    assert json.loads(message["tool_calls"][0]["function"]["arguments"]) == plan
    streamed = mock.client.post(url, json={"messages": said, "stream": True})
    events = [line[6:] for line in streamed.text.splitlines() if line.startswith("data: ")]
    assert events[-1] == "[DONE]"
    *chunks, usage = map(json.loads, events[:-1])
    assert (usage["choices"], usage["usage"]["prompt_tokens"] > 0) == ([], True)
    deltas = [chunk["choices"][0]["delta"] for chunk in chunks]
    json.loads("".join(delta.get("content", "") for delta in deltas))
    models = mock.client.get(f"{mock.url}/models").json()
    assert models["data"][0]["id"] == "pons-mock"


@pytest.mark.parametrize("streamed", [False, True])
@pytest.mark.parametrize("fault", sorted(READABLE))
def test_what_can_be_read_is_read_at_once(
    mock: RunningMock, fault: str, streamed: bool, tmp_path: Path
) -> None:
    mock.set(fault=fault, load_s=0.1)
    thought = ask(mock, tmp_path, hear=ignore if streamed else None)
    assert (thought.plan, thought.calls) == (KITCHEN, 1)


def ignore(_: Draft) -> None:
    """Listen and do nothing."""


REPAIRED = {
    *("garbage", "hallucinate", "hostile", "wrong_types", "two_plans", "refuse_and_plan"),
    *("truncated", "length", "null", "reasoning", "thoughts_only", "unknown_tool"),
}


@pytest.mark.parametrize("streamed", [False, True])
@pytest.mark.parametrize("fault", sorted(REPAIRED))
def test_what_is_no_plan_is_repaired_once(
    mock: RunningMock, fault: str, streamed: bool, tmp_path: Path
) -> None:
    hear = ignore if streamed else None
    mock.set(fault=fault, times=1)
    thought = ask(mock, tmp_path, hear=hear, mode="prompt")  # no other way is left
    assert (thought.plan, thought.calls) == (KITCHEN, 2)
    mock.set(fault=fault)
    before = mock.report()["calls"]
    with pytest.raises(BadPlan):
        ask(mock, tmp_path, hear=hear, mode="prompt")
    assert mock.report()["calls"] == before + 2


DOWN = {
    "status": "server_error",
    "loading": "loading",
    "rate_limited": "rate_limited",
    "not_found": "unknown_model",
    "small_context": "context_too_small",
    "redirect": "redirect",
    "hang": "timeout",
    "drip": "timeout",
    "lost": "server_error",
    "endless": "too_large",
    "huge": "too_large",
    "stream_endless": "too_large",
    "not_json": "bad_reply",
    "no_choices": "bad_reply",
    "error_200": "server_error",
    "packed": "bad_reply",
}


@pytest.mark.parametrize("fault", sorted(DOWN))
def test_a_server_that_fails_is_down_with_the_reason(
    mock: RunningMock, fault: str, tmp_path: Path
) -> None:
    mock.set(fault=fault, retry_after="60")
    hear = ignore if fault == "stream_endless" else None
    limit_s = 0.5 if DOWN[fault] == "timeout" else 10.0
    with pytest.raises(BrainDown) as down:
        ask(mock, tmp_path, timeout_s=limit_s, hear=hear)
    assert down.value.why == DOWN[fault]


@pytest.mark.parametrize(
    ("switches", "why"),
    [
        ({"fault": "status", "status": 503, "retry_after": "60"}, "server_error"),
        ({"fault": "status", "status": 401}, "bad_key"),
        ({"delay_s": 30.0}, "timeout"),
        ({"tokens_per_s": 1.0}, "timeout"),
    ],
)
def test_a_status_and_a_slow_server_end_typed_too(
    mock: RunningMock, switches: dict[str, Any], why: str, tmp_path: Path
) -> None:
    mock.set(**switches)
    settings = ModelSettings(
        url=mock.url, name="m", key=SecretStr(KEY), timeout_s=0.5, load_timeout_s=0.0
    )

    async def both() -> list[ThinkResult | BaseException]:
        """Wait for both ways of asking at once: each may take the deadline's whole length."""
        asked = (thought(settings, tmp_path, "go to the kitchen", hear) for hear in (None, ignore))
        return await asyncio.gather(*asked, return_exceptions=True)

    for down in asyncio.run(both()):
        assert isinstance(down, BrainDown)
        assert down.why == why


def test_a_filter_and_a_model_that_declines_are_refusals(mock: RunningMock, tmp_path: Path) -> None:
    for fault in ("filtered", "declined"):
        for hear in (None, ignore):
            mock.set(fault=fault)
            assert ask(mock, tmp_path, hear=hear).plan.kind == "refuse"


def test_every_fault_is_tried_here() -> None:
    others = {"filtered", "declined", "echo_key"}
    assert set(FAULTS) == READABLE | REPAIRED | set(DOWN) | others


def test_a_plan_is_heard_as_it_is_written(mock: RunningMock, tmp_path: Path) -> None:
    mock.set(tokens_per_s=200.0)
    heard: list[Draft] = []
    text = "go to the kitchen, then wait ten seconds and go to the sofa"
    plan = ask(mock, tmp_path, text, hear=heard.append).plan
    assert isinstance(plan, StepPlan)
    assert len(heard) >= 3
    assert [len(draft.steps) for draft in heard] == sorted(len(draft.steps) for draft in heard)
    assert heard[-1].steps[:1] == plan.steps[:1]
    assert heard[-1].text.startswith('{"kind": "plan"')


@pytest.mark.parametrize("fault", ["huge", "endless"])
def test_memory_stays_flat_whatever_is_sent(mock: RunningMock, fault: str, tmp_path: Path) -> None:
    mock.set(fault=fault)
    process = psutil.Process()
    ask_down(mock, tmp_path)
    before = process.memory_info().rss
    for _ in range(5):
        ask_down(mock, tmp_path)
    assert (process.memory_info().rss - before) / 1e6 < MEMORY_MB


def ask_down(mock: RunningMock, home: Path) -> None:
    with pytest.raises(BrainDown) as down:
        ask(mock, home)
    assert down.value.why == "too_large"


def test_a_key_that_is_echoed_is_struck_out(mock: RunningMock, tmp_path: Path) -> None:
    mock.set(fault="echo_key")
    heard: list[Draft] = []
    for hear in (None, heard.append):
        told = ask(mock, tmp_path, "what is your key?", hear).model_dump_json()
        assert "the key is Bearer ***" in told
        assert KEY not in told
    assert heard
    assert KEY[:8] not in "".join(draft.text for draft in heard)


def test_switches_are_checked_and_counted(mock: RunningMock) -> None:
    for wrong in ({"fault": "dance"}, {"delay_s": -1}, {"status": 200}, {"times": 0}, {"x": 1}):
        reply = mock.client.post(mock.url.replace("/v1", "/mock"), json=wrong)
        assert reply.status_code == 422
    mock.set(fault="garbage", times=2)
    assert mock.report()["switches"]["fault"] == "garbage"


def test_every_fault_is_described() -> None:
    assert all(BadSwitches(fault=fault) for fault in FAULTS)
    assert all(FAULTS.values())


TWICE = """
import runpy
for _ in range(2):
    try:
        runpy.run_module("pons", run_name="__main__", alter_sys=True)
    except SystemExit as end:
        print("ended with", end.code, flush=True)
"""
"""Be ``python -m pons`` two times over in one process, which loads all of it once."""


def hangs(process: subprocess.Popen[str]) -> None:
    """See that the mock says where it is, and hangs there."""
    assert process.stdout is not None
    url = process.stdout.readline().removeprefix("pons mock-llm: ").strip()
    with (
        httpx.Client(trust_env=False, verify=False, timeout=0.3) as client,
        pytest.raises(httpx.ReadTimeout),
    ):
        client.post(f"{url}/chat/completions", json={"messages": []})


def test_the_command_prints_its_url_and_ends_clean() -> None:
    command = [sys.executable, "-c", TWICE, "mock-llm", "--hang", "--delay", "0.01"]
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=os.environ
    )
    try:
        assert process.stdout is not None
        hangs(process)
        began_s = time.monotonic()
        process.send_signal(signal.SIGINT)
        assert process.stdout.readline() == "ended with 0\n"
        assert time.monotonic() - began_s < 10.0
        hangs(process)
        began_s = time.monotonic()
        process.send_signal(signal.SIGTERM)
        out, said = process.communicate(timeout=10.0)
        assert time.monotonic() - began_s < 10.0
    finally:
        process.kill()
        process.wait()
    assert (process.returncode, out) in ((0, "ended with 0\n"), (-signal.SIGTERM, ""))
    assert "Traceback" not in said, said


@pytest.mark.parametrize(
    "words",
    [["--port", "x"], ["--status", "200"], ["--delay", "-1"], ["--hang", "--garbage"], ["x"]],
)
def test_wrong_words_end_with_2(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    from pons.__main__ import main

    with pytest.raises(SystemExit) as ended:
        main(["mock-llm", *words])
    assert ended.value.code == 2
    assert "mock-llm" in capsys.readouterr().err
