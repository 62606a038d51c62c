"""Check the mock as any client meets it: plans, ways of asking, switches, the command."""

from __future__ import annotations

import asyncio
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import httpx
import pytest

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
from planner.plan import StepPlan, list_nodes
from planner.settings import ModelSettings
from tests.known import known
from tests.planner.brain.conftest import HOME
from tests.pons.mock_llm.mocks import RunningMock

SAID = "go to the kitchen"


async def thought(
    mock: RunningMock, home: Path, text: str = SAID, hear: Hear | None = None, **more: Any
) -> ThinkResult:
    told = {"url": mock.url, "name": "m", "timeout_s": 5.0, "load_timeout_s": 0.0, **more}
    brain = EndpointBrain(ModelSettings.model_validate(told), home)
    try:
        request = ThinkRequest(text=text, vocabulary=HOME, room="study")
        return await brain.think(request, hear)
    finally:
        await brain.close()


def ignore(_: Draft) -> None:
    """Listen and do nothing."""


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
    by_model = asyncio.run(thought(mock, tmp_path, text)).plan
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


@pytest.mark.parametrize(
    ("switches", "why"),
    [
        ({"fault": "status", "status": 503, "retry_after": "60"}, "server_error"),
        ({"fault": "status", "status": 401}, "bad_key"),
        ({"delay_s": 30.0}, "timeout"),
        ({"tokens_per_s": 1.0}, "timeout"),
        ({"fault": "hang"}, "timeout"),
        ({"fault": "garbage"}, "bad_plan"),
        ({"fault": "stream_breaks"}, None),
    ],
    ids=lambda value: value.get("fault", "slow") if isinstance(value, dict) else value,
)
def test_its_faults_are_met_as_faults(
    mock: RunningMock, switches: dict[str, Any], why: str | None, tmp_path: Path
) -> None:
    mock.set(**switches)
    limit_s = 0.5 if why == "timeout" else 20.0

    async def both() -> list[ThinkResult | BaseException]:
        """Wait for both ways of asking at once: each may take the deadline's whole length."""
        asked = (thought(mock, tmp_path, hear=hear, timeout_s=limit_s) for hear in (None, ignore))
        return await asyncio.gather(*asked, return_exceptions=True)

    for end in asyncio.run(both()):
        if why is None:
            assert isinstance(end, ThinkResult), "a broken stream is asked for plainly"
        else:
            met = end.why if isinstance(end, BrainDown) else "bad_plan"
            assert (met, isinstance(end, (BrainDown, BadPlan))) == (why, True)


def test_a_plan_is_heard_as_it_is_written(mock: RunningMock, tmp_path: Path) -> None:
    mock.set(tokens_per_s=200.0)
    heard: list[Draft] = []
    text = "go to the kitchen, then wait ten seconds and go to the sofa"
    plan = asyncio.run(thought(mock, tmp_path, text, heard.append)).plan
    assert isinstance(plan, StepPlan)
    assert len(heard) >= 3
    assert [len(draft.steps) for draft in heard] == sorted(len(draft.steps) for draft in heard)
    assert heard[-1].steps[:1] == plan.steps[:1]
    assert heard[-1].text.startswith('{"kind": "plan"')


def test_switches_are_checked_and_counted(mock: RunningMock) -> None:
    for wrong in ({"fault": "dance"}, {"delay_s": -1}, {"status": 200}, {"times": 0}, {"x": 1}):
        reply = mock.client.post(mock.url.replace("/v1", "/mock"), json=wrong)
        assert reply.status_code == 422
    mock.set(fault="garbage", times=2)
    assert mock.report()["switches"]["fault"] == "garbage"


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
    url = known(process.stdout).readline().removeprefix("pons mock-llm: ").strip()
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
        hangs(process)
        began_s = time.monotonic()
        process.send_signal(signal.SIGINT)
        assert known(process.stdout).readline() == "ended with 0\n"
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
