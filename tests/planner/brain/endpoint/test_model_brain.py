"""Check one thought: prompt, judgement, repair, ladder, deadline, and a key that stays hidden."""

from __future__ import annotations

import asyncio
import json
import logging
from pathlib import Path

import httpx
import pytest

from planner.brain import BadPlan, BrainDown, FallbackBrain, OfflineBrain, ThinkRequest
from planner.brain.endpoint import EndpointBrain
from planner.brain.endpoint.dialect import FILE
from planner.plan import (
    AnswerPlan,
    Bilingual,
    Clarify,
    Code,
    Plan,
    Refuse,
    Vocabulary,
)
from tests.planner.brain.endpoint.servers import (
    GO,
    KEY,
    Server,
    answer,
    brain,
    raw,
    settings,
    think,
    wrote,
)
from wire import ConfigError

BAD = '{"kind":"plan","steps":[{"kind":"go_to","place":"wine_cellar"}]}'


def refused(words: str) -> httpx.Response:
    return answer({"error": {"message": words}}, 400)


def test_what_is_asked(home: Vocabulary, tmp_path: Path) -> None:
    server = Server(wrote(GO))
    think(brain(server, tmp_path), home)
    (body,) = server.bodies
    assert [message["role"] for message in body["messages"]] == ["system", "user"]
    schema = body["response_format"]["json_schema"]["schema"]
    place = schema["properties"]["steps"]["items"]["properties"]["place"]
    assert place == {"type": "string", "enum": list(home.by_id)}
    system = body["messages"][0]["content"]
    assert all(f"{place_id}: " in system for place_id in place["enum"])
    assert (body["stream"], body["temperature"], "tools" in body) == (False, 0.0, False)
    (request,) = server.requests
    assert request.headers["authorization"] == f"Bearer {KEY}"
    assert str(request.url) == "http://127.0.0.1:9/v1/chat/completions"


def test_without_a_key_none_is_sent(home: Vocabulary, tmp_path: Path) -> None:
    server = Server(wrote(GO))
    think(brain(server, tmp_path, key=None, temperature=None), home)
    assert "authorization" not in server.requests[0].headers
    assert "temperature" not in server.bodies[0]


def test_a_disk_that_refuses_costs_no_plan(home: Vocabulary, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no folder")
    assert think(brain(Server(wrote(GO)), tmp_path / "file"), home).plan.kind == "plan"


def test_a_bad_plan_is_repaired_once_with_the_reasons(home: Vocabulary, tmp_path: Path) -> None:
    server = Server(wrote(BAD), wrote(GO))
    thought = think(brain(server, tmp_path), home)
    assert (thought.plan.kind, thought.calls, thought.tokens) == ("plan", 2, 22)
    *_, shown, told = server.bodies[1]["messages"]
    assert shown == {"role": "assistant", "content": BAD}
    assert "wine_cellar" in told["content"]


OFFER = (
    '{"kind":"clarify","code":"ambiguous","en":"Shall I?","zh":"要吗？",'
    '"options":["yesterday at eight go to the kitchen"]}'
)


def test_an_offer_that_could_not_be_kept_goes_back_once(home: Vocabulary, tmp_path: Path) -> None:
    def refuses(text: str) -> Bilingual | None:
        return Bilingual(en="That time is over.", zh="过去了。") if "yesterday" in text else None

    def ask(server: Server) -> Plan:
        request = ThinkRequest(text="it is a mess at eight", vocabulary=home, refuse_offer=refuses)
        return asyncio.run(brain(server, tmp_path).think(request)).plan

    server = Server(wrote(OFFER), wrote(OFFER.replace("yesterday", "tomorrow")))
    plan = ask(server)
    assert isinstance(plan, Clarify)
    assert [option.text for option in plan.options] == ["tomorrow at eight go to the kitchen"]
    assert "That time is over." in server.bodies[1]["messages"][-1]["content"]
    stubborn = Server(wrote(OFFER))
    assert ask(stubborn).kind == "clarify", "it is taken back behind the brain, with its reason"
    assert len(stubborn.requests) == 2


def test_two_bad_plans_are_rejected_and_no_third_is_asked(home: Vocabulary, tmp_path: Path) -> None:
    server = Server(wrote(BAD))
    with pytest.raises(BadPlan, match="wine_cellar"):
        think(brain(server, tmp_path), home)
    assert len(server.requests) == 2


def test_a_model_that_declines_is_a_refusal(home: Vocabulary, tmp_path: Path) -> None:
    plan = think(brain(Server(wrote(None, refusal="I can't do that.")), tmp_path), home).plan
    assert isinstance(plan, Refuse)
    assert plan.code is Code.UNSAFE
    assert "I can't do that." in plan.reason.en
    for finish in ("content_filter", "refusal"):
        for content in (None, GO):  # what was written before a filter stepped in counts for nothing
            choice = {"message": {"content": content}, "finish_reason": finish}
            server = Server(answer({"choices": [choice]}))
            assert think(brain(server, tmp_path), home).plan.kind == "refuse"


def test_a_reply_that_was_cut_off_is_told_so(home: Vocabulary, tmp_path: Path) -> None:
    cut = answer({"choices": [{"message": {"content": GO[:-9]}, "finish_reason": "length"}]})
    server = Server(cut, wrote(GO))
    assert think(brain(server, tmp_path), home).calls == 2
    assert "token limit" in server.bodies[1]["messages"][-1]["content"]


@pytest.mark.parametrize(
    ("complaint", "check"),
    [
        ("response_format is not supported", lambda b: "response_format" not in b),
        ("Unsupported value: 'temperature' does not support 0", lambda b: "temperature" not in b),
        ("Use 'max_completion_tokens' instead", lambda b: "max_completion_tokens" in b),
        ("'messages[0].role' does not support 'system' with this model",
         lambda b: [m["role"] for m in b["messages"]] == ["user"]),
    ],
)  # fmt: skip
def test_what_a_server_does_not_know_is_left_out_and_remembered(
    complaint: str, check: object, home: Vocabulary, tmp_path: Path
) -> None:
    assert callable(check)
    first = Server(refused(complaint), wrote(GO))
    think(brain(first, tmp_path), home)
    assert [check(body) for body in first.bodies] == [False, True]
    later = Server(wrote(GO))
    think(brain(later, tmp_path), home)
    assert [check(body) for body in later.bodies] == [True]
    other = Server(wrote(GO))
    think(brain(other, tmp_path, name="another"), home)
    assert [check(body) for body in other.bodies] == [False]


def test_the_ladder_ends(home: Vocabulary, tmp_path: Path) -> None:
    server = Server(refused("no"))
    with pytest.raises(BrainDown) as down:
        think(brain(server, tmp_path), home)
    assert (down.value.why, len(server.requests)) == ("bad_request", 4)
    assert not (tmp_path / FILE).exists()


def test_a_mode_that_the_owner_chose_is_kept_when_refused(home: Vocabulary, tmp_path: Path) -> None:
    fixed = Server(refused("response_format is not supported"))
    with pytest.raises(BrainDown):
        think(brain(fixed, tmp_path, mode="json_schema"), home)
    assert len(fixed.requests) == 1


@pytest.mark.parametrize("text", ["", "{", "[]", '{"x":7}', "\xff", "[" * 9000])
def test_a_broken_memory_of_dialects_is_found_out_anew(
    text: str, home: Vocabulary, tmp_path: Path
) -> None:
    (tmp_path / FILE).write_text(text, "latin-1")
    server = Server(wrote(GO))
    think(brain(server, tmp_path), home)
    assert "response_format" in server.bodies[0]
    assert len(json.loads((tmp_path / FILE).read_text())) >= 1


def test_a_generation_that_the_server_refuses_is_repaired(home: Vocabulary, tmp_path: Path) -> None:
    said = {"error": {"code": "json_validate_failed", "message": "no", "failed_generation": BAD}}
    server = Server(answer(said, 400), wrote(GO))
    assert think(brain(server, tmp_path), home).plan.kind == "plan"
    assert ["response_format" in body for body in server.bodies] == [True, True]


def test_a_host_elsewhere_needs_a_second_yes(tmp_path: Path) -> None:
    with pytest.raises(ConfigError) as wrong:
        EndpointBrain(settings(url="https://api.example.com/v1"), tmp_path)
    assert wrong.value.code == "model_offhost"
    assert KEY not in str(wrong.value)
    EndpointBrain(settings(url="https://api.example.com/v1", allow_offhost=True), tmp_path)


async def test_cancelling_takes_effect_at_once_and_frees_the_turn(
    home: Vocabulary, tmp_path: Path
) -> None:
    hung = asyncio.Event()

    async def hang(_: httpx.Request) -> httpx.Response:
        hung.set()
        await asyncio.Event().wait()
        raise AssertionError

    made = EndpointBrain(settings(parallel=1), tmp_path, transport=httpx.MockTransport(hang))
    request = ThinkRequest(text="go to the kitchen", vocabulary=home)
    for _ in range(2):  # the second gets the only turn, so the first gave it back
        hung.clear()
        task = asyncio.create_task(made.think(request))
        await hung.wait()
        task.cancel()
        async with asyncio.timeout(1.0):
            await asyncio.gather(task, return_exceptions=True)
        assert task.cancelled()
    await made.close()


async def test_waiting_for_a_turn_counts_against_the_deadline(
    home: Vocabulary, tmp_path: Path
) -> None:
    async def hang(_: httpx.Request) -> httpx.Response:
        await asyncio.Event().wait()
        raise AssertionError

    asked = settings(parallel=1, timeout_s=0.5)
    made = EndpointBrain(asked, tmp_path, transport=httpx.MockTransport(hang))
    request = ThinkRequest(text="go to the kitchen", vocabulary=home)
    async with asyncio.timeout(2.0):
        thoughts = (made.think(request) for _ in range(5))
        ended = await asyncio.gather(*thoughts, return_exceptions=True)
    assert [each.why for each in ended if isinstance(each, BrainDown)] == ["timeout"] * 5
    await made.close()


@pytest.mark.parametrize("status", [200, 400, 401, 404, 429, 500])
def test_the_key_shows_nowhere(
    status: int, home: Vocabulary, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    """A server that echoes the key puts it into no thought, no error, no log and no file."""
    caplog.set_level(logging.DEBUG)
    words = f"your key is Bearer {KEY}"
    echo = json.dumps({"kind": "answer", "en": words, "zh": words})
    escaped = echo.replace("sk-", "\\u0073k-")
    for text in (echo, escaped):  # as it is, and as no search for it would find it
        told = json.dumps({"error": {"message": words}}).encode()
        if text == escaped:
            told = told.replace(b"sk-", b"\\u0073k-")
        given = wrote(text) if status == 200 else raw(told, status)
        model = brain(Server(given), tmp_path, timeout_s=1.0)
        seen = [repr(model), str(settings()), repr(settings())]

        async def story(model: EndpointBrain = model, seen: list[str] = seen) -> None:
            request = ThinkRequest(text="what is your key", vocabulary=home)
            for each in (model, FallbackBrain(model, OfflineBrain())):
                try:
                    thought = await each.think(request)
                except (BrainDown, BadPlan) as failed:
                    seen.append(f"{failed} {failed!r} {failed.brain}")
                else:
                    seen.append(thought.model_dump_json())
                    assert status != 200 or isinstance(thought.plan, AnswerPlan)
            await model.close()

        asyncio.run(story())
        files = [path.read_text() for path in tmp_path.rglob("*") if path.is_file()]
        assert KEY not in "\n".join([*seen, *files, caplog.text])
        assert len(seen) == 5
