"""Run ``pons mcp``: on stdio for a desktop assistant, or with ``--http`` for several."""

from __future__ import annotations

import argparse
import asyncio
import logging
import os
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import uvicorn

from pons.command_parser import CommandParser
from pons.mcp.http_door import LOOPBACK, PATH, build_app
from pons.mcp.planner_door import TOKEN, DoorError, PlannerDoor
from pons.mcp.server import build_server
from pons.settings import port_of
from pons.tls import prepare
from pons_assets.version import version_line
from wire import ConfigError

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

DEFAULT_PORT = 8430
EXIT_DONE, EXIT_USAGE, EXIT_REFUSED, EXIT_DOWN = 0, 2, 3, 6
VARIABLE = "PONS_AGENT_TOKEN"


def main(settings: LaunchSettings, words: list[str]) -> int:
    """Serve until the client goes or a signal comes."""
    logging.basicConfig(level=logging.WARNING, stream=sys.stderr)  # stdout is the protocol's
    given = _options(words)
    door = PlannerDoor.of(settings)
    try:
        if given.http:
            return _serve_http(settings, door, given)
        return asyncio.run(_serve_stdio(door, _token(given.token_file)))
    except ConfigError as wrong:
        print(wrong, file=sys.stderr)
        return EXIT_USAGE
    except KeyboardInterrupt:
        return EXIT_DONE


def _options(words: list[str]) -> argparse.Namespace:
    parser = CommandParser(
        prog="pons mcp",
        examples=["pons mcp --token-file agent.token", "pons mcp --http --port 8430"],
        description="Serve this robot over MCP (docs/mcp.md). Without options on stdio, with the "
        f"agent's token in {VARIABLE}; `pons people add NAME --role agent` makes one.",
    )
    parser.add_argument("--token-file", type=Path, metavar="FILE", help="holds the token instead")
    parser.add_argument("--http", action="store_true", help=f"Streamable HTTP at {PATH}")
    parser.add_argument("--host", default="127.0.0.1", help="to listen at; others need --tls")
    parser.add_argument("--port", type=port_of, default=DEFAULT_PORT)
    parser.add_argument("--tls", action="store_true", help="with this robot's certificate")
    return parser.parse_args(words)


def _token(file: Path | None) -> str:
    """Return the agent's token.

    Raises:
        ConfigError: the file can't be read.
    """
    if file is None:
        return os.environ.pop(VARIABLE, "").strip()
    try:
        return file.read_text("utf-8").strip()
    except (OSError, ValueError) as error:
        raise ConfigError("token_unreadable", f"{file}: {error}") from None


async def _serve_stdio(door: PlannerDoor, token: str) -> int:
    """Serve one client on stdin and stdout, in the name of one agent."""
    TOKEN.set(token)
    try:
        await door.name_agent()
    except DoorError as refused:
        if refused.code != "planner_down":  # the robot may be started later
            print(refused, file=sys.stderr)
            return EXIT_REFUSED
        print(refused, file=sys.stderr)
    try:
        await build_server(door, version_line()).run_stdio_async()
    finally:
        await door.close()
    return EXIT_DONE


def _serve_http(settings: LaunchSettings, door: PlannerDoor, given: argparse.Namespace) -> int:
    """Serve many clients; each request carries its agent's token."""
    if not given.tls and given.host not in (*LOOPBACK, "::1"):
        detail = f"{given.host} can be reached from outside; add --tls, or listen at 127.0.0.1"
        raise ConfigError("tls_needed", detail)
    issued = prepare(replace(settings, host=given.host)) if given.tls else None
    names = (given.host, *(issued.names if issued else ()))
    app = build_app(build_server(door, version_line()), door, names, tls=given.tls)
    scheme = "https" if given.tls else "http"
    print(f"MCP at {scheme}://{given.host}:{given.port}{PATH}", file=sys.stderr)
    uvicorn.run(
        app, host=given.host, port=given.port, log_level="warning", access_log=False,
        server_header=False, timeout_graceful_shutdown=2, limit_concurrency=64,
        ssl_certfile=issued.planner if issued else None,  # with its key in the same file
    )  # fmt: skip
    return EXIT_DONE
