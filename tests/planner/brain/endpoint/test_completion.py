"""Replay what real servers have answered: each is read, repaired, fallen back from or refused."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path
from typing import Any

import httpx
import pytest

from planner.brain import (
    BadPlan,
    BrainDown,
)
from planner.brain.endpoint.completion import read_reply
from planner.plan import GoTo, StepPlan, Vocabulary
from tests.planner.brain.endpoint.servers import GO, Server, brain, raw, think, wrote

Exchange = dict[str, Any]


@pytest.fixture(scope="module")
def exchanges(shared_data: Path) -> list[Exchange]:
    """Return every recorded chat completion."""
    paths = sorted((shared_data / "llm_fixtures").glob("*.json"))
    found: list[Exchange] = [
        {**exchange, "file": path.name}
        for path in paths
        for exchange in json.loads(path.read_text("utf-8")).get("interactions", [])
        if exchange["url_path"].endswith("/chat/completions")
    ]
    assert len(found) >= 20, "the recordings are gone"
    return found


def expected(exchange: Exchange) -> str:
    """Return how a thought must end on this answer and no other; none of them holds our plan."""
    status, body = exchange["status"], exchange["response_body"]
    if status == 400:
        return "rejected" if "failed_generation" in body else "bad_request"
    if status != 200:
        return {404: "unknown_model", 429: "rate_limited"}[status]
    return "rejected"


def test_every_recorded_answer_ends_typed(
    exchanges: list[Exchange], home: Vocabulary, tmp_path: Path
) -> None:
    for exchange in exchanges:
        server = Server(partial(as_answer, exchange))
        made = brain(server, tmp_path, timeout_s=5.0, name=exchange["file"])
        with pytest.raises((BrainDown, BadPlan)) as failed:
            think(made, home)
        error = failed.value
        ended = error.why if isinstance(error, BrainDown) else "rejected"
        assert ended == expected(exchange), (exchange["file"], str(error))


def as_answer(exchange: Exchange) -> httpx.Response:
    headers = {"content-type": exchange["content_type"]}
    if exchange.get("retry_after"):
        headers["retry-after"] = exchange["retry_after"][0]
    return raw(exchange["response_body"].encode(), exchange["status"], headers)


def test_every_recorded_answer_may_be_the_first_of_two(
    exchanges: list[Exchange], home: Vocabulary, tmp_path: Path
) -> None:
    """What a repair turn or another try can mend is mended."""
    for number, exchange in enumerate(exchanges):
        if expected(exchange) in ("bad_reply", "unknown_model"):
            continue
        server = Server(partial(as_answer, exchange), partial(wrote, GO))
        thought = think(brain(server, tmp_path / str(number), timeout_s=5.0), home)
        assert thought.plan == StepPlan(steps=(GoTo(place="kitchen"),)), exchange["file"]


def test_text_is_read_and_reasoning_is_not(exchanges: list[Exchange]) -> None:
    read = 0
    for exchange in exchanges:
        if exchange["status"] != 200 or "event-stream" in exchange["content_type"]:
            continue
        message = json.loads(exchange["response_body"])["choices"][0]["message"]
        reply = read_reply(json.loads(exchange["response_body"]))
        assert reply.text == (message.get("content") or ""), exchange["file"]
        assert 0 < reply.tokens.prompt < reply.tokens.total
        if not reply.text:
            assert reply.trouble is not None
        read += 1
    assert read >= 10


def test_reported_failures_end_typed(shared_data: Path, home: Vocabulary, tmp_path: Path) -> None:
    listed = json.loads((shared_data / "llm_fixtures" / "reported_failures.json").read_text())
    ended: dict[int, set[str]] = {}
    for item in listed["items"]:
        if not isinstance(item["status"], int) or item["status"] == 200:
            continue
        body = item.get("body") or json.dumps({"error": {"message": item["message"]}})
        server = Server(partial(raw, body.encode(), item["status"]))
        with pytest.raises(BrainDown) as down:
            think(brain(server, tmp_path, timeout_s=5.0), home)
        ended.setdefault(item["status"], set()).add(down.value.why)
    assert ended == {503: {"loading"}, 500: {"server_error"}, 404: {"unknown_model"}}
