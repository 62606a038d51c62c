"""Check streams: however cut, they come to what a plain reply would have been, or to none."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.brain import Draft, FallbackBrain, OfflineBrain, ThinkRequest, ThinkResult
from planner.brain.endpoint import EndpointBrain
from planner.brain.endpoint.assembly import Assembly, StreamFailure
from planner.brain.endpoint.completion import read_reply
from planner.brain.endpoint.plan_draft import Drafting
from planner.brain.endpoint.response import Events
from planner.plan import RUNNABLE, GoTo, StepPlan, Vocabulary, Wait
from tests.planner.brain.conftest import HOME
from tests.planner.brain.endpoint.servers import (
    GO,
    Answer,
    Server,
    answer,
    brain,
    raw,
    wrote,
)

EVENTS = {"content-type": "text/event-stream; charset=utf-8"}
STOP = {"choices": [{"index": 0, "delta": {}, "finish_reason": "stop"}]}
KITCHEN = StepPlan(steps=(GoTo(place="kitchen"),))


def delta(**fields: Any) -> dict[str, Any]:
    return {"choices": [{"index": 0, "delta": fields, "finish_reason": None}]}


def call(**piece: Any) -> dict[str, Any]:
    return delta(tool_calls=[piece])


def stream(*events: object, done: bool = True) -> bytes:
    lines = [f"data: {json.dumps(event)}\n\n" for event in events]
    return "".join([*lines, "data: [DONE]\n\n" if done else ""]).encode()


def think(
    made: EndpointBrain | FallbackBrain, home: Vocabulary, heard: list[Draft] | None = None
) -> ThinkResult:
    hear = (heard if heard is not None else []).append

    async def once() -> ThinkResult:
        request = ThinkRequest(text="go to the kitchen", vocabulary=home)
        return await made.think(request, hear)

    return asyncio.run(once())


NAMED = {"function": {"name": "plan", "arguments": ""}}
FULL = {"function": {"name": "plan", "arguments": GO}}


def args(text: object, **more: Any) -> dict[str, Any]:
    return call(**more, function={"arguments": text})


@pytest.mark.parametrize(
    "events",
    [
        [delta(role="assistant"), delta(content=GO[:9]), delta(content=GO[9:])],
        [delta(content=[{"type": "text", "text": GO[:9]}]), delta(content=GO[9:])],
        [delta(reasoning_content="{}", content=None), delta(content=GO, reasoning_content=None)],
        [delta(reasoning="hm {"), delta(content=""), delta(content=GO)],
        [{"choices": []}, delta(content=GO), {"choices": [], "usage": {"total_tokens": 7}}],
        [delta(content=GO), {"choices": [{"index": 1, "delta": {"content": "other"}}]}],
        [{"choices": [{"message": {"content": GO}, "finish_reason": "stop"}]}],
        [delta(content=GO), {"choices": [{"message": {"content": GO}}]}],
        [call(index=0, id="a", **NAMED), args(GO[:9], index=0), args(GO[9:], index=0)],
        [call(id="a", **NAMED), args(GO[:9]), args(GO[9:])],
        [call(id="a", **NAMED), args(GO[:9], id=None), args(GO[9:], id="a")],
        [call(id="a", **NAMED), args(GO[:9], index=None), args(GO[9:], id="")],
        [call(index=0, **NAMED), args(GO, index=0, id="late")],
        [args(GO[:9], index=0), args(GO[9:], index=0), call(index=0, id="a", **NAMED)],
        [args(GO, index=0), call(index=0, function={"name": "pl"}),
         call(index=0, function={"name": "an"})],
        [call(index=0, id="a", **FULL)],
        [call(index=0, id="a", **FULL), call(index=0, id="a", **FULL)],
        [call(index=0, id="a", **FULL), call(index=1, id="b", **FULL)],
        [call(index=0, id="a", **NAMED), args(GO, index=0), call(id="a", **FULL)],
        [args(json.loads(GO), index=0), call(index=0, function={"name": "plan"})],
        [delta(content="Sure, here you are."), call(index=0, id="a", **FULL)],
        [delta(function_call={"name": "plan", "arguments": GO[:9]}),
         delta(function_call={"arguments": GO[9:]})],
        [call(index=0, id="a", name="plan", arguments=GO)],
    ],
)  # fmt: skip
def test_a_plan_is_put_together_however_it_is_cut(
    events: list[object], home: Vocabulary, tmp_path: Path
) -> None:
    server = Server(lambda: raw(stream(*events, STOP), headers=EVENTS))
    thought = think(brain(server, tmp_path), home)
    assert (thought.plan, thought.calls, len(server.requests)) == (KITCHEN, 1, 1)
    assert server.bodies[0]["stream"] is True
    assert server.bodies[0]["stream_options"] == {"include_usage": True}


OTHER = GO.replace("kitchen", "study")
WITH_OTHER = {"function": {"name": "plan", "arguments": OTHER}}


@pytest.mark.parametrize(
    ("events", "told"),
    [
        ([call(index=0, id="a", **FULL), call(index=1, id="b", **WITH_OTHER)], "exactly one"),
        ([delta(content=OTHER), call(index=0, id="a", **FULL)], "exactly one"),
        ([delta(content=f"```{OTHER}```"), call(index=0, id="a", **FULL)], "exactly one"),
        ([call(index=0, function={"name": "drive", "arguments": GO})], "does not exist"),
        ([call(index=0, **FULL), call(index=1, id="b", function={"name": "drive"})], "not exist"),
        ([delta(content=GO), call(index=0, id="a", function={"name": "drive"})], "does not exist"),
        ([call(index=0, id="a", **NAMED)], "no arguments"),
        ([call(index=0, id="a", **NAMED), args(GO[:-2], index=0)], "cut off"),
        ([delta(content=GO), delta(content=OTHER)], "exactly one"),
        ([delta(content=None)], "empty"),
        ([delta(content="<think>"), delta(content=GO)], "thoughts alone"),
    ],
)  # fmt: skip
def test_what_is_not_one_plan_is_none(
    events: list[object], told: str, home: Vocabulary, tmp_path: Path
) -> None:
    good = stream(delta(content=GO), STOP)
    server = Server(raw(stream(*events, STOP), headers=EVENTS), lambda: raw(good, headers=EVENTS))
    thought = think(brain(server, tmp_path, mode="prompt"), home)
    assert (thought.plan, thought.calls) == (KITCHEN, 2)
    assert told in server.bodies[1]["messages"][-1]["content"]


@pytest.mark.parametrize(
    "events",
    [
        [delta(content=GO), {"choices": [{"message": {"content": GO, "refusal": "I won't."}}]}],
        [call(index=0, id="a", **FULL), {"choices": [{"message": {"refusal": "I won't."}}]}],
        [delta(refusal="I won't."), {"choices": [{"message": {"content": GO}}]}],
        [delta(refusal="I "), delta(refusal="won't."), delta(content=GO)],
    ],
)
def test_a_refusal_counts_wherever_it_stands_in_a_stream(
    events: list[object], home: Vocabulary, tmp_path: Path
) -> None:
    server = Server(raw(stream(*events, STOP), headers=EVENTS))
    assert think(brain(server, tmp_path), home).plan.kind == "refuse"


BROKEN: list[Answer] = [
    raw(stream(delta(content=GO), done=False), headers=EVENTS),
    raw(stream(delta(content=GO[:9]), {"error": {"message": "no"}}), headers=EVENTS),
    raw(stream(delta(content=GO), 7, STOP), headers=EVENTS),
    raw(b'data: {"choices":[\n\n' + stream(delta(content=GO), STOP), headers=EVENTS),
    raw(b"", headers=EVENTS),
    raw(stream(delta(content=GO[:30])), headers=EVENTS),  # as llama-cpp-python interrupts one
    raw(stream(call(index=0, id="a", **NAMED), args(GO[:30], index=0)), headers=EVENTS),
    raw(stream(delta(role="assistant")), headers=EVENTS),
]


@pytest.mark.parametrize("broken", BROKEN)
def test_a_broken_stream_is_asked_for_plainly(
    broken: Answer, home: Vocabulary, tmp_path: Path
) -> None:
    server = Server(broken, lambda: wrote(GO))
    thought = think(brain(server, tmp_path), home)
    assert (thought.plan, thought.calls) == (KITCHEN, 1)
    assert [body["stream"] for body in server.bodies] == [True, False]
    assert "stream_options" not in server.bodies[1]


def test_a_server_whose_streams_break_is_not_asked_for_them_again(
    home: Vocabulary, tmp_path: Path
) -> None:
    server = Server(
        *(lambda: raw(stream(delta(content=GO), done=False), headers=EVENTS),
          lambda: wrote(GO)) * 2,
        lambda: wrote(GO),
    )  # fmt: skip
    made = brain(server, tmp_path)
    for _ in range(3):
        assert think(made, home).plan == KITCHEN
    assert [body["stream"] for body in server.bodies] == [True, False, True, False, False]


def test_a_stream_is_asked_for_where_it_is_wanted_alone(home: Vocabulary, tmp_path: Path) -> None:
    server = Server(lambda: wrote(GO))
    think(brain(server, tmp_path, stream=False), home)
    assert server.bodies[0]["stream"] is False
    no = answer({"error": {"message": "stream is not supported"}}, 400)
    first = Server(no, lambda: wrote(GO))
    think(brain(first, tmp_path, name="other"), home)
    think(brain(first, tmp_path, name="other"), home)
    assert [body["stream"] for body in first.bodies] == [True, False, False]
    assert all("response_format" in body for body in first.bodies)


PIECES = st.lists(st.integers(1, 400), min_size=0, max_size=12)
WHOLE = b": hi\r\n\r\n" + stream(delta(content=GO[:20]), delta(content=GO[20:]), STOP).replace(
    b"\n\n", b"\r\n\r\n", 1
)


@given(PIECES, st.sampled_from([b"\n", b"\r\n", b"\r"]))
@settings(max_examples=40)
def test_no_cut_changes_a_stream(cuts: list[int], line_end: bytes) -> None:
    whole = WHOLE.replace(b"\r\n", b"\n").replace(b"\n", line_end)
    events, assembly, at = Events(), Assembly(), 0
    for cut in [*cuts, len(whole)]:
        for event in events.feed(whole[at : at + cut]):
            assembly.add(event)
        at += cut
    for event in events.end():
        assembly.add(event)
    assert events.done
    assert read_reply(assembly.completion()).text == GO


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(max_size=8) | st.just("plan"),
    lambda inner: st.lists(inner, max_size=3)
    | st.dictionaries(
        st.sampled_from(["choices", "delta", "content", "tool_calls", "function", "name", "index",
                         "id", "arguments", "error", "usage", "message", "finish_reason"]),
        inner, max_size=5),
    max_leaves=12,
)  # fmt: skip


@given(st.lists(JSON, max_size=4))
@settings(max_examples=50)
def test_no_event_is_too_odd(events: list[Any]) -> None:
    assembly = Assembly()
    try:
        for event in events:
            assembly.add(event)
    except StreamFailure:
        return
    assert isinstance(assembly.text, str)
    read_reply(assembly.completion())


PLAN = (
    '{"kind":"plan","steps":[{"kind":"go_to","place":"kitchen"},{"kind":"wait","seconds":10},'
    '{"kind":"go_to","place":"wine_cellar"},{"kind":"go_to","place":"study"}]}'
)


@pytest.mark.parametrize(
    ("text", "count"),
    [
        (PLAN[:57], 0),
        (PLAN[:58], 1),
        (PLAN[:86], 1),
        (PLAN, 2),  # up to the place that does not exist
        (f"```json\n{PLAN[:60]}", 1),
        (f"<think>{PLAN}", 0),
        (f"<think>{PLAN}</think>{PLAN[:60]}", 1),
        (PLAN[:60].replace('"plan"', '"refuse"'), 0),
        (PLAN[:60].replace("go_to", "fly"), 0),
        ('{"kind":"plan","steps":[7', 0),
        ('{"kind":"plan","steps":' + "[" * 5000, 0),
        ('{"steps":[{"kind":"wait","seconds":1e999},', 0),
    ],
)
def test_steps_are_read_as_they_are_written(text: str, count: int) -> None:
    heard: list[Draft] = []
    Drafting(HOME, RUNNABLE, heard.append)(lambda: text)
    steps = heard[0].steps if heard else ()
    assert steps == (GoTo(place="kitchen"), Wait(seconds=10.0))[:count]


def test_a_draft_is_bounded_and_clean() -> None:
    heard: list[Draft] = []
    Drafting(HOME, RUNNABLE, heard.append)(lambda: "\x1b[31m\u202egone\x00" + "a" * 30_000)
    (draft,) = heard
    assert draft.text.isprintable()
    assert len(draft.text) == 2000
    Drafting(HOME, RUNNABLE, heard.append)(lambda: "\x00 \n")
    assert len(heard) == 1
    Drafting(HOME, RUNNABLE, heard.append)(lambda: "a" * 3000 + "b" * 500)
    assert heard[1].text == "a" * 1500 + "b" * 500  # the newest


def test_a_recorded_stream_is_read_to_its_end(
    shared_data: Path, home: Vocabulary, tmp_path: Path
) -> None:
    """Real servers' streams give their words; a call of an unknown tool gives none."""
    ends: dict[str, str] = {}
    for path in sorted((shared_data / "llm_fixtures").glob("*stream*.json")):
        for number, exchange in enumerate(json.loads(path.read_text("utf-8"))["interactions"]):
            if "event-stream" not in exchange["content_type"]:
                continue
            body = exchange["response_body"].encode()
            server = Server(raw(body, headers=EVENTS), lambda: wrote(GO))
            heard: list[Draft] = []
            thought = think(
                brain(server, tmp_path, mode="prompt", name=f"{path.name}{number}"), home, heard
            )
            assert (thought.plan, thought.calls) == (KITCHEN, 2), path.name
            assert thought.tokens > 11, "the stream's usage counts"
            said = server.bodies[1]["messages"]
            ends[f"{path.stem}{number}"] = said[-2]["content"] + said[-1]["content"]
    assert len(ends) == 3
    assert "Paris" in ends["hf_llama31_stream1"]
    assert "does not exist" in ends["kimi_k2_stream_tool_variant_a0"]
    assert "no JSON object" in ends["kimi_k2_stream_tool_variant_a1"]


def test_who_listens_hears_nothing_of_a_model_that_is_down(
    home: Vocabulary, tmp_path: Path
) -> None:
    heard: list[Draft] = []
    model = brain(Server(answer({}, 401)), tmp_path)
    thought = think(FallbackBrain(model, OfflineBrain()), home, heard)
    assert (thought.plan, heard) == (KITCHEN, [])
