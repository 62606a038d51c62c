"""Be ``pons mock-llm``: take a port, print the URL, serve until Ctrl-C."""

from __future__ import annotations

import contextlib
import socket
import sys
from dataclasses import dataclass, field

import uvicorn

from pons.mock_llm.app import build
from pons.mock_llm.fault_switches import Switches

REFUSED = 2


@dataclass(frozen=True, slots=True)
class MockOptions:
    """Say where to listen and how to behave."""

    host: str = "127.0.0.1"
    port: int = 0
    """0: any free port."""
    switches: Switches = field(default_factory=Switches)


def run(options: MockOptions) -> int:
    """Serve; 2 when the address can't be had."""
    family = socket.AF_INET6 if ":" in options.host else socket.AF_INET
    with socket.socket(family, socket.SOCK_STREAM) as ears:
        ears.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            ears.bind((options.host, options.port))
        except OSError as error:
            where = f"{options.host}:{options.port}"
            print(f"pons mock-llm: port_in_use: {where}: {error.strerror}", file=sys.stderr)
            return REFUSED
        ears.listen(128)
        with contextlib.suppress(KeyboardInterrupt):
            _serve(options, ears)
    return 0


def _serve(options: MockOptions, ears: socket.socket) -> None:
    """Build the application, say where it is, and run it."""
    app = build(options.switches)
    config = uvicorn.Config(
        app,
        log_level="warning",
        access_log=False,
        server_header=False,
        timeout_graceful_shutdown=1,
    )
    server = uvicorn.Server(config)
    app.state.mock.ending = lambda: server.should_exit
    shown = f"[{options.host}]" if ":" in options.host else options.host
    print(f"pons mock-llm: http://{shown}:{ears.getsockname()[1]}/v1", flush=True)
    server.run(sockets=[ears])
