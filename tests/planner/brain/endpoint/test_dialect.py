"""Check how servers are asked: by the ladder, by presets, and at the address that was judged."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx
import pytest

from planner.brain import BadPlan, BrainDown
from planner.brain.endpoint.dialect import FILE, LADDER, Dialect, body_of
from planner.brain.schema import schema_of
from planner.plan import Vocabulary
from planner.settings import PRESETS, JsonMode, PresetName
from tests.planner.brain.conftest import HOME
from tests.planner.brain.endpoint.servers import (
    GO,
    Server,
    answer,
    brain,
    settings,
    think,
    wrote,
)

Body = dict[str, Any]


def refused(words: str, status: int = 400) -> Callable[[], httpx.Response]:
    return lambda: answer({"error": {"message": words}}, status)


def rung(body: Body) -> str:
    assert not ("tools" in body and "response_format" in body)
    assert ("tools" in body) == ("tool_choice" in body)
    if "tools" in body:
        (tool,) = body["tools"]
        assert body["tool_choice"]["function"]["name"] == tool["function"]["name"] == "plan"
        assert tool["function"]["parameters"]["properties"]["kind"]
        return "tool"
    return str(body.get("response_format", {"type": "prompt"})["type"])


@pytest.mark.parametrize("last", range(4))
@pytest.mark.parametrize("status", [400, 422, 404, 500, 501])
def test_the_ladder_is_stepped_down_once_and_remembered(
    last: int, status: int, home: Vocabulary, tmp_path: Path
) -> None:
    no = refused("response_format or tool_choice: no support for tools here", status)
    server = Server(*[no] * last, lambda: wrote(GO))
    assert think(brain(server, tmp_path), home).plan.kind == "plan"
    assert [rung(body) for body in server.bodies] == [mode.value for mode in LADDER[: last + 1]]
    schema = json.dumps(schema_of(home), separators=(",", ":"), ensure_ascii=False)
    for body in server.bodies:  # told once: by the format, by the tool, or else by the prompt
        by_prompt = rung(body) in ("json_object", "prompt")
        assert (schema in body["messages"][0]["content"]) is by_prompt
        assert [each["role"] for each in body["messages"]] == ["system", "user"]
    later = Server(lambda: wrote(GO))
    think(brain(later, tmp_path), home)
    assert [rung(body) for body in later.bodies] == [LADDER[last].value]


def test_what_a_500_says_of_itself_is_no_word_about_the_mode(
    home: Vocabulary, tmp_path: Path
) -> None:
    server = Server(refused("out of memory", 500), lambda: wrote(GO))
    think(brain(server, tmp_path), home)
    assert [rung(body) for body in server.bodies] == ["json_schema"] * 2


@pytest.mark.parametrize(
    "words",
    [
        "the request exceeds the available context size, try increasing it",
        "This model's maximum context length is 4096 tokens; response_format, max_tokens",
    ],
)
def test_an_order_that_is_too_long_makes_no_server_simple(
    words: str, home: Vocabulary, tmp_path: Path
) -> None:
    server = Server(refused(words), lambda: wrote(GO))
    with pytest.raises(BrainDown) as down:
        think(brain(server, tmp_path), home)
    assert (down.value.why, len(server.requests)) == ("context_too_small", 1)


def test_complaints_that_contradict_each_other_come_to_an_end(
    home: Vocabulary, tmp_path: Path
) -> None:
    server = Server(refused("neither max_tokens nor max_completion_tokens, temperature, stream"))
    with pytest.raises(BrainDown) as down:
        think(brain(server, tmp_path), home)
    assert (down.value.why, len(server.requests) <= 8) == ("bad_request", True)
    assert len({json.dumps(body) for body in server.bodies}) == len(server.requests)
    assert not (tmp_path / FILE).exists()


@pytest.mark.parametrize("name", PresetName)
def test_a_preset_is_asked_in_its_own_way(
    name: PresetName, home: Vocabulary, tmp_path: Path
) -> None:
    known = PRESETS[name]
    more = {"preset": name, "allow_offhost": True, "url": "http://127.0.0.1:9/v1"}
    server = Server(lambda: wrote(GO))
    think(brain(server, tmp_path, extra_body={"top_k": 20}, **more), home)
    (body,) = server.bodies
    assert rung(body) == known.mode
    assert body[known.tokens_field] == 1000 if known.max_tokens == 1000 else 4000
    assert len({"max_tokens", "max_completion_tokens"} & body.keys()) == 1
    assert {key: body[key] for key in known.quiet} == dict(known.quiet)
    assert body["top_k"] == 20
    loud = Server(lambda: wrote(GO))
    think(brain(loud, tmp_path, thinking=True, name="loud", **more), home)
    assert not known.quiet.keys() & loud.bodies[0].keys()
    if known.quiet:
        (word, *_) = known.quiet
        strict = Server(refused(f"Unrecognized request argument supplied: {word}"),
                        lambda: wrote(GO))  # fmt: skip
        think(brain(strict, tmp_path, name="strict", **more), home)
        assert [word in asked for asked in strict.bodies] == [True, False]
        assert rung(strict.bodies[1]) == known.mode


def test_own_words_win_over_the_presets_and_ours_over_both() -> None:
    mine = settings(preset="dashscope", extra_body={"enable_thinking": True})
    body = body_of(mine, Dialect.first(mine), [], {}, stream=True)
    assert (body["enable_thinking"], body["stream"], body["model"]) == (True, True, "m")


def test_a_filter_that_refuses_the_order_is_a_refusal(home: Vocabulary, tmp_path: Path) -> None:
    for code in ("content_filter", "data_inspection_failed"):
        server = Server(answer({"error": {"code": code, "message": "filtered"}}, 400))
        assert think(brain(server, tmp_path), home).plan.kind == "refuse"
        assert len(server.requests) == 1


def test_a_mode_of_the_owner_is_kept_whatever_is_remembered(
    home: Vocabulary, tmp_path: Path
) -> None:
    think(brain(Server(lambda: wrote(GO)), tmp_path), HOME)
    for mode in JsonMode:
        server = Server(lambda: wrote(GO))
        think(brain(server, tmp_path, mode=mode), home)
        assert [rung(body) for body in server.bodies] == [mode.value]


def test_the_ladder_is_climbed_again_after_a_day(home: Vocabulary, tmp_path: Path) -> None:
    no = refused("response_format: no support here")
    server = Server(no, *[lambda: wrote(GO)] * 2, no, *[lambda: wrote(GO)] * 3)
    for _ in range(2):
        think(brain(server, tmp_path), home)
    assert [rung(body) for body in server.bodies] == ["json_schema", "tool", "tool"]
    _age_by_a_day(tmp_path)
    for _ in range(2):  # it still refuses, which holds for another day
        think(brain(server, tmp_path), home)
    assert [rung(body) for body in server.bodies[3:]] == ["json_schema", "tool", "tool"]
    _age_by_a_day(tmp_path)
    for _ in range(2):  # it was updated
        think(brain(server, tmp_path), home)
    assert [rung(body) for body in server.bodies[6:]] == ["json_schema", "json_schema"]


def _age_by_a_day(home: Path) -> None:
    _age_by(home, 86_401.0)


def _age_by(home: Path, seconds: float) -> None:
    kept = json.loads((home / FILE).read_text("utf-8"))
    for row in kept.values():
        row["climbed_unix_s"] -= seconds
    (home / FILE).write_text(json.dumps(kept), "utf-8")


NOTHING = (
    {"content": ""},
    {"content": None},
    {"content": " \n"},
    {"content": "I will go to the kitchen for you!"},
    {"content": "", "reasoning_content": GO},
    {"content": "", "tool_calls": []},
    {"content": "<think>Perhaps {}?</think>"},
)


@pytest.mark.parametrize("message", NOTHING)
@pytest.mark.parametrize("last", [1, 2, 3])
def test_a_way_that_is_taken_and_brings_nothing_is_left_and_climbed_again(
    message: Body, last: int, home: Vocabulary, tmp_path: Path
) -> None:
    def nothing() -> httpx.Response:
        return answer({"choices": [{"message": message, "finish_reason": "stop"}]})

    server = Server(*[nothing] * last, lambda: wrote(GO))
    thought = think(brain(server, tmp_path), home)
    assert (thought.plan.kind, thought.calls) == ("plan", 1)
    assert [rung(body) for body in server.bodies] == [mode.value for mode in LADDER[: last + 1]]
    later = Server(lambda: wrote(GO))
    think(brain(later, tmp_path), home)
    assert [rung(body) for body in later.bodies] == [LADDER[last].value], "it is remembered"
    _age_by(tmp_path, 3_601.0)
    healed = Server(lambda: wrote(GO))
    for _ in range(2):
        think(brain(healed, tmp_path), home)
    assert [rung(body) for body in healed.bodies] == ["json_schema"] * 2


def test_a_model_that_writes_nothing_in_any_way_is_no_fault_of_a_way(
    home: Vocabulary, tmp_path: Path
) -> None:
    server = Server(lambda: wrote(""))
    with pytest.raises(BadPlan):
        think(brain(server, tmp_path), home)
    assert len(server.requests) == 5, "each way once, and the repair turn"
    assert not (tmp_path / FILE).exists()


def test_thoughts_that_took_the_room_of_the_reply_are_no_fault_of_the_way(
    home: Vocabulary, tmp_path: Path
) -> None:
    cut = {"choices": [{"message": {"content": ""}, "finish_reason": "length"}]}
    server = Server(answer(cut), lambda: wrote(GO))
    think(brain(server, tmp_path), home)
    assert [rung(body) for body in server.bodies] == ["json_schema"] * 2
