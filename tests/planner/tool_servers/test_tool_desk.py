"""Tools of the owner's servers: the SDK's own server, and servers that mean ill or are down."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from planner.mission.effects import AskTool
from planner.mission.events import ToolAnswered
from planner.tool_servers.listing import clean
from tests.planner.tool_servers.servers import (
    Answering,
    answer_with,
    calendar_server,
    desk_of,
    free_port,
    raw_server,
    tool,
    write_json,
)


@pytest.fixture(scope="module")
def calendar() -> Iterator[str]:
    with calendar_server() as url:
        yield url


async def ask(home: Path, url: str, *calls: AskTool, **settings: Any) -> list[ToolAnswered]:
    """Return what came of calls, one after the other, after the list was fetched."""
    desk = desk_of(home, url, **settings)
    assert await desk.fetch("calendar")
    answers = [await desk.answer(call) for call in calls]
    await desk.close()
    return answers


def call(name: str, *arguments: str, agreed: bool = False, goal: str = "g") -> AskTool:
    return AskTool(goal, 1, f"calendar.{name}", arguments, agreed)


async def test_a_tool_of_the_sdks_server_answers(calendar: str, tmp_path: Path) -> None:
    (answer,) = await ask(tmp_path, calendar, call("events", "today", "5"))
    assert answer.problem is None
    assert answer.read is not None
    assert "today: dentist at 10:00 (of 5)" in answer.read.en
    assert "dentist" not in answer.said.en
    assert answer.said.en == "I asked calendar: events (today; 5)."


async def test_only_what_reads_is_offered_unasked(calendar: str, tmp_path: Path) -> None:
    desk = desk_of(tmp_path, calendar)
    assert await desk.fetch("calendar")
    await desk.close()
    (state,) = desk.states
    offered, left_out = [each.name for each in desk.tools], dict(state.listing.left_out)
    assert offered == ["calendar.events", "calendar.stop", "calendar.broken"]
    assert left_out == {"add_event": "tool_unmarked", "unmarked": "tool_unmarked"}


async def test_a_servers_word_that_a_tool_writes_stands_against_the_owners_list(
    calendar: str, tmp_path: Path
) -> None:
    listed = {"allow": ["add_event", "unmarked", "gone"]}
    add, unmarked = await ask(
        tmp_path, calendar, call("add_event", "tea", "Anna"), call("unmarked"), **listed
    )
    assert add.problem == "tool_unknown"
    assert unmarked.problem is None


async def test_a_call_that_writes_waits_for_a_yes(calendar: str, tmp_path: Path) -> None:
    given = ("tea", "Anna, Ben")
    first, then = await ask(
        tmp_path,
        calendar,
        call("add_event", *given),
        call("add_event", *given, agreed=True),
        may_write=["add_event"],
    )
    assert first.asks
    assert "add_event (tea; Anna, Ben)" in first.said.en
    assert then.read is not None
    assert "added tea with Anna+Ben" in then.read.en


async def test_a_tool_that_fails_keeps_its_words_out_of_ours(calendar: str, tmp_path: Path) -> None:
    (answer,) = await ask(tmp_path, calendar, call("broken"))
    assert answer.problem == "tool_error"
    assert "bathroom" not in answer.said.en


async def test_arguments_that_are_none_of_the_type_are_refused(
    calendar: str, tmp_path: Path
) -> None:
    missing, wrong, many = await ask(
        tmp_path,
        calendar,
        call("events"),
        call("events", "today", "three"),
        call("events", "today", "3", "4"),
    )
    assert {each.problem for each in (missing, wrong, many)} == {"tool_arguments"}
    assert "day" in missing.said.en


async def test_calls_are_bounded_by_goal_and_by_day_across_a_restart(
    calendar: str, tmp_path: Path
) -> None:
    bounds = {"goal_calls": 1, "day_calls": 2}
    first = await ask(tmp_path, calendar, call("events", "a"), call("events", "a"), **bounds)
    again = await ask(
        tmp_path,
        calendar,
        call("events", "a"),
        call("events", "a", goal="h"),
        call("events", "a", goal="i"),
        **bounds,
    )
    assert [each.problem for each in first] == [None, "tool_goal_calls"]
    assert [each.problem for each in again] == ["tool_goal_calls", None, "tool_day_calls"]


async def hang(_: dict[str, Any], writer: asyncio.StreamWriter) -> None:
    await asyncio.sleep(60.0)


async def flood(_: dict[str, Any], writer: asyncio.StreamWriter) -> None:
    writer.write(b"HTTP/1.1 200 OK\r\nContent-Type: application/json\r\n\r\n")
    for _at in range(1600):
        writer.write(b"x" * 65_536)
        await writer.drain()


async def drip(_: dict[str, Any], writer: asyncio.StreamWriter) -> None:
    writer.write(b"HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\n\r\n")
    while True:
        writer.write(b": still there\n\n")
        await writer.drain()
        await asyncio.sleep(0.01)


async def redirect(_: dict[str, Any], writer: asyncio.StreamWriter) -> None:
    writer.write(
        b"HTTP/1.1 307 x\r\nLocation: http://169.254.169.254/\r\nContent-Length: 0\r\n\r\n"
    )
    await writer.drain()


def raw(body: object, status: str = "200 OK") -> Answering:
    async def answering(_: dict[str, Any], writer: asyncio.StreamWriter) -> None:
        await write_json(writer, body, status)

    return answering


BAD_SERVERS: dict[str, tuple[Answering, str]] = {
    "hangs": (hang, "timeout"),
    "floods": (flood, "too_large"),
    "an event stream that never ends": (drip, "timeout"),
    "redirects": (redirect, "redirect"),
    "garbage": (raw(b"\x00\xff<html>"), "bad_reply"),
    "deep": (raw(b"[" * 90_000), "bad_reply"),
    "a list for an answer": (raw([1, 2]), "bad_reply"),
    "another's id": (raw({"jsonrpc": "2.0", "id": 999, "result": {"tools": []}}), "bad_reply"),
    "no list of tools": (answer_with({"tools": "all"}, {}), "bad_reply"),
    "locked": (raw({}, "401 Unauthorized"), "bad_key"),
    "ill": (raw({}, "500 Internal Server Error"), "server_error"),
    "elsewhere": (raw({}, "404 Not Found"), "unknown_route"),
}


@pytest.mark.parametrize("kind", BAD_SERVERS)
async def test_a_bad_server_is_told_by_its_code_and_offers_nothing(
    kind: str, tmp_path: Path
) -> None:
    answering, code = BAD_SERVERS[kind]
    async with raw_server(answering) as url:
        desk = desk_of(tmp_path, url, timeout_s=0.5, max_bytes=100_000)
        assert not await desk.fetch("calendar")
        (state,) = desk.states
        assert (state.problem, desk.tools) == (code, ())
        answer = await desk.answer(call("events"))
        assert answer.problem == "tool_unknown"
        await desk.close()


async def test_a_server_that_turns_bad_after_its_list_fails_the_call_alone(tmp_path: Path) -> None:
    for kind, (answering, code) in BAD_SERVERS.items():
        if kind in ("no list of tools", "another's id"):
            continue

        async def serve(
            request: dict[str, Any], writer: asyncio.StreamWriter, bad: Answering = answering
        ) -> None:
            good = answer_with({"tools": [tool("events")]}, {})
            await (good if request["method"] == "tools/list" else bad)(request, writer)

        bounds = {"timeout_s": 0.5, "max_bytes": 100_000, "goal_calls": 50}
        async with raw_server(serve) as url:
            (answer,) = await ask(tmp_path, url, call("events"), **bounds)
        assert (kind, answer.problem, answer.read) == (kind, code, None)


async def test_nobody_waits_for_a_server_that_hangs_or_is_down(tmp_path: Path) -> None:
    desk = desk_of(tmp_path, f"http://127.0.0.1:{free_port()}/mcp")
    await desk.start()
    assert desk.tools == ()
    await desk.close()
    async with raw_server(hang) as url:
        desk = desk_of(tmp_path, url)
        await asyncio.wait_for(desk.start(), 0.5)
        await desk.close()


async def test_an_answer_in_an_open_event_stream_is_taken_at_once(tmp_path: Path) -> None:
    async def serve(request: dict[str, Any], writer: asyncio.StreamWriter) -> None:
        result = {"tools": [tool("events")]}
        if request["method"] == "tools/call":
            result = {"content": [{"type": "text", "text": "tea at four"}]}
        message = json.dumps({"jsonrpc": "2.0", "id": request["id"], "result": result})
        ping = json.dumps({"jsonrpc": "2.0", "id": 1, "method": "sampling/createMessage"})
        writer.write(b"HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\n\r\n")
        writer.write(
            f": hello\r\n\r\ndata: {ping}\n\nevent: message\ndata: {message}\r\n\r\n".encode()
        )
        await writer.drain()
        await asyncio.sleep(60.0)

    async with raw_server(serve) as url:
        (answer,) = await ask(tmp_path, url, call("events"))
    assert answer.read is not None
    assert "tea at four" in answer.read.en


async def test_an_older_server_is_met_by_its_handshake(tmp_path: Path) -> None:
    heard: list[str] = []

    async def serve(request: dict[str, Any], writer: asyncio.StreamWriter) -> None:
        heard.append(request["method"])
        params = request.get("params", {})
        if "_meta" in params:
            await write_json(writer, {"jsonrpc": "2.0", "id": None, "error": {}}, "400 Bad Request")
        elif request["method"] == "initialize":
            body = json.dumps(
                {"jsonrpc": "2.0", "id": request["id"], "result": {"protocolVersion": "2025-06-18"}}
            )
            writer.write(
                f"HTTP/1.1 200 OK\r\nContent-Type: application/json\r\nMcp-Session-Id: abc\r\n"
                f"Content-Length: {len(body)}\r\nConnection: close\r\n\r\n{body}".encode()
            )
            await writer.drain()
        elif request["method"] == "notifications/initialized":
            await write_json(writer, b"", "202 Accepted")
        else:
            await answer_with({"tools": [tool("events")]}, {"content": []})(request, writer)

    async with raw_server(serve) as url:
        (answer,) = await ask(tmp_path, url, call("events"))
    assert answer.problem is None
    assert heard == [
        "tools/list", "initialize", "notifications/initialized", "tools/list", "tools/call",
    ]  # fmt: skip


async def test_what_a_server_lists_is_cut_and_cleaned_and_odd_names_are_left_out(
    tmp_path: Path,
) -> None:
    listed = [
        tool("stop", "drive to the bathroom\n" * 50 + "\u202e"),
        tool("a b"),
        tool("x" * 65),
        tool("stop", "a second one"),
        {"name": 7, "annotations": {"readOnlyHint": True}, "inputSchema": {}},
        tool("many", inputSchema={"properties": {f"p{i}": {} for i in range(20)}}),
        tool("needs", inputSchema={"properties": {}, "required": ["p"]}),
        tool("wrong", inputSchema=[1]),
        {"annotations": 3},
    ]
    async with raw_server(answer_with({"tools": listed}, {})) as url:
        desk = desk_of(tmp_path, url)
        assert await desk.fetch("calendar")
        await desk.close()
    first, *rest = desk.tools
    assert first.name == "calendar.stop"
    assert len(first.about) == 100
    assert "\n" not in first.about
    assert [each.name for each in rest] == ["calendar.7", "calendar.many"]
    assert len(rest[1].parameters) == 8
    assert clean(None, 10) == ""
