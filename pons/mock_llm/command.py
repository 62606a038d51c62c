"""Be ``pons mock-llm``: read its words, take a port, print the URL, serve until Ctrl-C."""

from __future__ import annotations

import argparse
import contextlib
import socket
import sys

import uvicorn
from pydantic import ValidationError

from pons.mock_llm.app import build
from pons.mock_llm.server import FAULTS, MockServer, Switches

REFUSED = 2


def main(words: list[str]) -> int:
    """Serve as told until Ctrl-C; 2 where that makes no sense, or the address can't be had."""
    grammar = _grammar()
    said = grammar.parse_args(words)
    chosen = {name: getattr(said, name) for name in Switches.model_fields if name in said}
    if said.status is not None:
        chosen["fault"] = "status"
    try:
        switches = Switches.model_validate({k: v for k, v in chosen.items() if v is not None})
    except ValidationError as wrong:
        told = "; ".join(f"{e['loc'][0] if e['loc'] else ''}: {e['msg']}" for e in wrong.errors())
        grammar.error(told)
    family = socket.AF_INET6 if ":" in said.host else socket.AF_INET
    with socket.socket(family, socket.SOCK_STREAM) as ears:
        ears.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            ears.bind((said.host, said.port))
        except OSError as error:
            where = f"{said.host}:{said.port}"
            print(f"pons mock-llm: port_in_use: {where}: {error.strerror}", file=sys.stderr)
            return REFUSED
        ears.listen(128)
        with contextlib.suppress(KeyboardInterrupt):
            _serve(MockServer(switches), said.host, ears)
    return 0


def _serve(mock: MockServer, host: str, ears: socket.socket) -> None:
    """Build the application, say where it is, and run it."""
    config = uvicorn.Config(
        build(mock), log_level="warning", access_log=False, server_header=False,
        timeout_graceful_shutdown=1,
    )  # fmt: skip
    server = uvicorn.Server(config)
    mock.ending = lambda: server.should_exit
    shown = f"[{host}]" if ":" in host else host
    print(f"pons mock-llm: http://{shown}:{ears.getsockname()[1]}/v1", flush=True)
    server.run(sockets=[ears])


def _grammar() -> argparse.ArgumentParser:
    grammar = argparse.ArgumentParser(
        prog="pons mock-llm",
        description="Serve the offline brain over the OpenAI protocol, with faults on demand.",
        epilog="Example: pons mock-llm --port 8421. "
        'While it runs, POST /mock {"fault": "hang", "times": 1} changes it.',
    )
    option = grammar.add_argument
    option("--host", default="127.0.0.1")
    option("--port", type=_port, default=0, help="0 takes a free one")
    option("--delay", dest="delay_s", type=float, metavar="S", help="before each reply")
    option("--tokens-per-s", type=float, metavar="N", help="how fast it writes")
    option("--times", type=int, metavar="N", help="calls until the fault is gone")
    option("--retry-after", metavar="S", help="the header, with --status")
    faults = grammar.add_mutually_exclusive_group()
    faults.add_argument("--status", type=int, metavar="CODE", help=FAULTS["status"])
    for name, what in FAULTS.items():
        if name != "status":
            flag = f"--{name.replace('_', '-')}"
            faults.add_argument(flag, dest="fault", action="store_const", const=name, help=what)
    return grammar


def _port(text: str) -> int:
    if text.isdecimal() and int(text) <= 65_535:
        return int(text)
    raise argparse.ArgumentTypeError(f"{text!r} is no port from 0 to 65535")
