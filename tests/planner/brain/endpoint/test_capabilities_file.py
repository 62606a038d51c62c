"""Check how servers are asked: by the ladder, by presets, and at the address that was judged."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx
import pytest

from planner.brain import BrainDown
from planner.brain.endpoint.capabilities_file import FILE
from planner.brain.endpoint.dns_pinning import Names
from planner.brain.endpoint.server_capabilities import LADDER, Dialect, body_of
from planner.brain.endpoint.url_policy import Address
from planner.brain.schema import schema_of
from planner.plan import Vocabulary
from planner.settings import PRESETS, Mode, PresetName
from tests.planner.brain.conftest import HOME
from tests.planner.brain.endpoint.servers import (
    GO,
    KEY,
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
    for body in server.bodies:  # whoever holds the model to it, the prompt tells it
        assert schema in body["messages"][0]["content"]
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
    assert (down.value.why, len(server.requests)) == ("bad_request", 1)


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


def resolving(monkeypatch: pytest.MonkeyPatch, *answers: list[str]) -> list[str]:
    """Let a name lead to these addresses, one list for each look; return what was looked up."""
    asked: list[str] = []

    async def look(_: object, host: str, port: int, **__: object) -> list[tuple[object, ...]]:
        asked.append(host)
        found = answers[min(len(asked), len(answers)) - 1]
        return [(2, 1, 6, "", (each, port)) for each in found]

    monkeypatch.setattr(asyncio.BaseEventLoop, "getaddrinfo", look)
    return asked


def test_a_call_goes_to_the_address_that_was_judged(
    home: Vocabulary, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A name that means another address at the connection leads nowhere else."""
    asked = resolving(monkeypatch, ["203.0.113.7"], ["169.254.169.254"])
    server = Server(lambda: wrote(GO))
    made = brain(server, tmp_path, url="https://models.example/v1", allow_offhost=True)
    think(made, home)
    (request,) = server.requests
    assert str(request.url) == "https://203.0.113.7/v1/chat/completions"
    assert request.headers["host"] == "models.example"
    assert request.extensions["sni_hostname"] == "models.example"
    assert request.headers["authorization"] == f"Bearer {KEY}"
    assert asked == ["models.example"]


@pytest.mark.parametrize("found", [["10.0.0.1", "169.254.169.254"], ["fe80::1"], []])
def test_a_name_that_leads_to_the_link_by_any_of_its_addresses_is_not_asked(
    found: list[str], home: Vocabulary, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    resolving(monkeypatch, found)
    server = Server(lambda: wrote(GO))
    made = brain(server, tmp_path, url="http://models.example:8080/v1", allow_offhost=True)
    with pytest.raises(BrainDown) as down:
        think(made, home)
    assert down.value.why == ("refused_address" if found else "unreachable")
    assert server.requests == []


def test_an_address_that_takes_no_connection_is_passed_over(
    home: Vocabulary, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    resolving(monkeypatch, ["2001:db8::1", "203.0.113.7"])
    server = Server(httpx.ConnectError("no way"), lambda: wrote(GO))
    made = brain(server, tmp_path, url="http://models.example:8080/v1", allow_offhost=True)
    assert think(made, home).plan.kind == "plan"
    hosts = [(request.url.host, request.headers["host"]) for request in server.requests]
    assert hosts == [("2001:db8::1", "models.example:8080"), ("203.0.113.7", "models.example:8080")]


def test_the_address_that_answered_comes_first_and_a_number_is_not_looked_up(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    seven, eight = "203.0.113.7", "203.0.113.8"
    asked = resolving(monkeypatch, [seven, eight], [seven, eight], [eight])

    async def story() -> None:
        names = Names(Address.parse("http://models.example/v1"))
        _, second = await names.targets()
        names.answered(second)
        assert (await names.targets())[0] is second
        monkeypatch.setattr("planner.brain.endpoint.dns_pinning.RESOLVED_FOR_S", -1.0)
        assert [each.ip for each in await names.targets()] == [eight, seven]
        assert [each.ip for each in await names.targets()] == [eight]
        local = Names(Address.parse("http://127.0.0.1:1/v1"))
        assert [each.url for each in await local.targets()] == [
            "http://127.0.0.1:1/v1/chat/completions"
        ]

    asyncio.run(story())
    assert asked == ["models.example"] * 3


def test_a_mode_of_the_owner_is_kept_whatever_is_remembered(
    home: Vocabulary, tmp_path: Path
) -> None:
    think(brain(Server(lambda: wrote(GO)), tmp_path), HOME)
    for mode in Mode:
        server = Server(lambda: wrote(GO))
        think(brain(server, tmp_path, mode=mode), home)
        assert [rung(body) for body in server.bodies] == [mode.value]
