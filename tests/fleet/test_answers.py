"""Judge what robots answer: a true planner's passes, nonsense does not."""

from __future__ import annotations

import asyncio
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from fleet.answers import check_answer
from fleet.link import FleetLink, RobotAway
from fleet.pin import Pin
from tests.planner.api.test_real_missions import served
from tests.planner.mission.live import run

GOAL: dict[str, Any] = {"id": "g1", "state": "running", "plan": None, "outcome": None}


@pytest.mark.parametrize(
    ("method", "path", "content"),
    [
        ("POST", "/v1/goals", []),
        ("POST", "/v1/goals", {}),
        ("POST", "/v1/goals", {**GOAL, "id": ""}),
        ("POST", "/v1/goals", {**GOAL, "id": 7}),
        ("POST", "/v1/goals", {**GOAL, "state": {"x": 1}}),
        ("POST", "/v1/goals", {**GOAL, "state": "x" * 33}),
        ("GET", "/v1/goals/g1", {**GOAL, "plan": "go"}),
        ("GET", "/v1/goals/g1", {**GOAL, "plan": {"steps": ["ask"]}}),
        ("GET", "/v1/goals/g1", {**GOAL, "outcome": {"message": {"en": 7}}}),
        ("GET", "/v1/goals/g1", {**GOAL, "reason": "r" * 65}),
        ("POST", "/v1/goals/g1/cancel", "done"),
        ("GET", "/v1/goals", {"goals": [GOAL]}),
        ("GET", "/v1/goals", {"goals": [GOAL], "next": -1}),
        ("GET", "/v1/goals", {"goals": [GOAL], "next": 2**70}),
        ("GET", "/v1/goals", {"goals": [GOAL], "next": "abc"}),
        ("GET", "/v1/goals", {"goals": [GOAL] * 201, "next": 1}),
        ("GET", "/v1/robot", []),
        ("GET", "/v1/robot", {"status": "fine"}),
        ("GET", "/v1/robot", {"status": {"base_in_map": {"x_m": "0", "y_m": 0.0}}}),
        ("GET", "/v1/robot", {"status": {"base_in_map": {"x_m": float("nan"), "y_m": 0.0}}}),
        ("GET", "/v1/robot", {"status": {"drive": {"battery": "full"}}}),
        ("GET", "/v1/usage", {"today": {"money": -100.0}}),
        ("GET", "/v1/usage", {"today": {"money": float("nan")}}),
        ("GET", "/v1/skills", {"skills": [{"name": 3}]}),
        ("GET", "/v1/robot", {"status": {"drive": {"battery": 85}}}),
        ("GET", "/v1/robot", {"status": {"base_in_map": {"x_m": 0.0, "y_m": 0.0}}}),
        ("GET", "/v1/robot", {"status": {"base_in_map": {"x_m": 0, "y_m": 0, "yaw_rad": 1e9}}}),
        ("POST", "/v1/rehearsals", []),
        ("POST", "/v1/rehearsals", {"steps": [1], "length_m": 1.0}),
        ("POST", "/v1/rehearsals", {"steps": [{}], "length_m": 1.0}),
        ("POST", "/v1/rehearsals", {"steps": [{"does": "drives", "points": ["?"]}]}),
        ("POST", "/v1/rehearsals", {"steps": [{"does": "drives", "points": [[1.0]]}]}),
        ("POST", "/v1/rehearsals", {"steps": [], "length_m": -5.0}),
        ("POST", "/v1/rehearsals", {"steps": [], "length_m": float("nan")}),
    ],
)
def test_nonsense_is_no_answer(method: str, path: str, content: Any) -> None:
    with pytest.raises(ValueError, match=": "):
        check_answer(method, path, content)


def test_of_a_robots_state_the_fields_that_are_read_are_all_there() -> None:
    told = check_answer("GET", "/v1/robot", {"status": {"mode": "ACTIVE", "x": 1}, "more": "x"})
    status = {"mode": "ACTIVE", "base_in_map": None, "drive": None}
    assert told == {"status": status, "room": None, "map_id": None}


def test_a_true_planners_answers_pass(tmp_path: Path) -> None:
    async def story() -> None:
        async with served(tmp_path, by_grammar=True) as (world, operator, _):
            given = await operator.post("/v1/goals", {"text": "go to the kitchen and say hello"})
            goal_id = given.json()["id"]
            check_answer("POST", "/v1/goals", given.json())
            await world.until(lambda: world.missions.goal(goal_id).state == "succeeded")
            for path in (f"/v1/goals/{goal_id}", "/v1/robot"):
                told = await operator.ask("GET", path, None)
                check_answer("GET", path, told.json())
            body = {"text": "go to the living room"}
            told = await operator.post("/v1/rehearsals", body)
            check_answer("POST", "/v1/rehearsals", told.json())

    run(story())


@pytest.mark.parametrize("how", ["endless", "slow"])
def test_a_body_without_an_end_is_given_up(how: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its bytes are not gathered, and its slowness holds nobody."""
    monkeypatch.setattr("fleet.link.WHOLE_S", 0.5 if how == "slow" else 60.0)

    over, poured = asyncio.Event(), asyncio.Event()

    async def pour(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        await reader.readuntil(b"\r\n\r\n")
        writer.write(b"HTTP/1.1 200 OK\r\ntransfer-encoding: chunked\r\n\r\n")
        piece = b"10000\r\n" + b" " * 65_536 + b"\r\n" if how == "endless" else b"1\r\n \r\n"
        with suppress(OSError):
            while not over.is_set():
                writer.write(piece)
                await writer.drain()
                await asyncio.sleep(0.0 if how == "endless" else 0.05)
        writer.transport.abort()
        poured.set()

    async def story() -> None:
        server = await asyncio.start_server(pour, "127.0.0.1", 0)
        port = server.sockets[0].getsockname()[1]
        link = FleetLink("r1", f"http://127.0.0.1:{port}", "r1", Pin(), "")
        with pytest.raises(RobotAway):
            await asyncio.wait_for(link.get("/v1/robot"), 20.0)
        await link.close()
        over.set()
        await poured.wait()
        server.close()
        await server.wait_closed()

    asyncio.run(story())
