"""Check what the comparison of brains stands on: the instant endpoint, its plan, its shape."""

from __future__ import annotations

import asyncio
import json
import subprocess
import sys
from pathlib import Path

import httpx
import pytest
from pydantic import ValidationError

from planner.brain.endpoint import judge
from planner.plan import StepPlan, Vocabulary
from planner.site import Site
from planner.site.site_view import vocabulary_of
from tools.bench.instant_llm_server import PLAN, Instant
from tools.bench.measure import brains_compared as compared
from tools.bench.peers import environment
from tools.bench.peers.shape import PeerFacts, check, plan_model


def facts(folder: Path) -> PeerFacts:
    return PeerFacts.load(str(compared._facts(folder, "http://127.0.0.1:1/v1")))


def test_the_plan_is_one_for_us_and_for_the_others(tmp_path: Path) -> None:
    words: Vocabulary = vocabulary_of(Site.load(compared.SITE))
    assert isinstance(judge(json.dumps(PLAN), words), StepPlan)
    asked = facts(tmp_path)
    shape = plan_model(asked)
    check(shape.model_validate(PLAN), asked)
    with pytest.raises(ValueError, match="no plan"):
        check(shape.model_validate({"kind": "plan", "steps": []}), asked)
    with pytest.raises(ValidationError):
        shape.model_validate({"kind": "plan", "steps": [{"kind": "go_to", "place": "moon"}]})
    assert asked.said in asked.order


def test_the_endpoint_answers_at_once_plainly_and_streamed_and_counts() -> None:
    async def story() -> None:
        server = await asyncio.start_server(Instant().serve, "127.0.0.1", 0)
        url = f"http://127.0.0.1:{server.sockets[0].getsockname()[1]}"
        async with server, httpx.AsyncClient(trust_env=False, base_url=url) as client:
            body = {"model": "m", "messages": [{"role": "user", "content": "去"}]}
            whole = (await client.post("/v1/chat/completions", json=body)).json()
            assert json.loads(whole["choices"][0]["message"]["content"]) == PLAN
            streamed = await client.post("/v1/chat/completions", json={**body, "stream": True})
            assert streamed.text.endswith("data: [DONE]\n\n")
            found = (await client.get("/counts")).json()
            assert (found["calls"], found["bytes"]["m"] > 0) == ({"m": 2}, True)
            await client.post("/hang", json={"on": True})
            with pytest.raises(httpx.ReadTimeout):
                await client.post("/v1/chat/completions", json=body, timeout=0.05)
        await asyncio.sleep(0.05)  # for the last connection to be found closed

    asyncio.run(story())


def test_peers_that_cant_be_installed_are_said_and_leave_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(*words: str) -> None:
        raise subprocess.SubprocessError("pip: no route to host")

    monkeypatch.setattr(environment, "_run", fails)
    with pytest.raises(environment.NoPeers, match="no route"):
        environment.peers_python(tmp_path / "peers")
    assert not (tmp_path / "peers").exists()
    python = tmp_path / "peers" / "bin" / "python"
    python.parent.mkdir(parents=True)
    python.write_text("")
    wanted = "\n".join([sys.version.split()[0], *environment.WANTED])
    (tmp_path / "peers" / "wanted.txt").write_text(wanted)
    assert environment.peers_python(tmp_path / "peers") == python


def test_a_row_tells_its_rounds_and_versions() -> None:
    one = {"rounds_ms": [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]], "versions": {"x": "1.2"}}
    row = compared._row("pons", one)
    assert (row.goal, row.figures and row.figures.n) == ("p50 <= 8, p99 <= 25", 6)
    assert row.note == "medians of 2 rounds 2.00 - 5.00; x 1.2"
    assert compared._row("other", {**one, "versions": {}}).goal == ""
