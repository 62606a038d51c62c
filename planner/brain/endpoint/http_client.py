"""Own the HTTP of one endpoint: one client kept alive, one URL, second tries, typed failures.

The key leaves this file in one header to one host: redirects are not followed, proxies and netrc of
the environment are not used, and it is struck out of whatever a server says. The caller holds the
deadline; everything here is cut when it passes.
"""

from __future__ import annotations

import asyncio
import importlib
import importlib.util
import json
import logging
import socket
import sys
import time
from collections.abc import Callable
from typing import Any

import httpx

from planner.brain.endpoint.assembly import Assembly
from planner.brain.endpoint.metering import MeteredTransport
from planner.brain.endpoint.response import RetryableFailure, StreamBroken, Told, read
from planner.brain.errors import BrainDown
from planner.brain.usage_meter import Meter
from planner.outbound import Address, CallFailure, CallTarget, Secret, TargetResolver
from planner.settings import ModelSettings

KEEPALIVE_S = 600.0
"""A connection is kept through idle minutes; one that the server has closed is noticed and opened
anew, and one that a router on the way forgot is noticed by the probes."""
LOADING_S, LONGEST_LOADING_S = 1.0, 10.0
"""Between two questions to a server that says it is loading."""
PROBES = tuple(
    (level, int(getattr(socket, name)), value)
    for level, name, value in (
        (socket.SOL_SOCKET, "SO_KEEPALIVE", 1),
        (socket.IPPROTO_TCP, "TCP_KEEPIDLE", 30),  # [s]; Linux
        (socket.IPPROTO_TCP, "TCP_KEEPALIVE", 30),  # [s]; macOS
        (socket.IPPROTO_TCP, "TCP_KEEPINTVL", 10),  # [s]
        (socket.IPPROTO_TCP, "TCP_KEEPCNT", 3),
        (socket.IPPROTO_TCP, "TCP_NODELAY", 1),
    )
    if hasattr(socket, name)
)


def open_client(
    address: Address,
    settings: ModelSettings,
    key: dict[str, str],
    transport: httpx.AsyncBaseTransport | None,
    meter: Meter | None,
) -> httpx.AsyncClient:
    """Return the client.

    Args:
        address: where it will call.
        settings: its bounds.
        key: the header that carries the key, if there is one.
        transport: another than the network, for tests.
        meter: counts every call and may refuse it.
    """
    # Its lines for debugging quote a server's head as it came, with a key that is echoed in it.
    logging.getLogger("httpcore").setLevel(logging.WARNING)
    inner = transport or httpx.AsyncHTTPTransport(
        trust_env=False,
        verify=address.url.startswith("https:"),  # certificates cost 0.1 s and 10 MB to load
        limits=httpx.Limits(
            max_connections=settings.parallel + 2,
            max_keepalive_connections=settings.parallel,
            keepalive_expiry=KEEPALIVE_S,
        ),
        socket_options=PROBES,
    )
    return httpx.AsyncClient(
        headers={
            "Accept": "application/json, text/event-stream",
            "Accept-Encoding": "identity",  # a small body must not unpack into a large one
            "Content-Type": "application/json",
            "User-Agent": "pons",
            **key,
        },
        follow_redirects=False,
        trust_env=False,
        transport=inner if meter is None else MeteredTransport(inner, meter),
        timeout=httpx.Timeout(
            settings.timeout_s + settings.load_timeout_s, connect=settings.connect_timeout_s
        ),
    )


def warm_up() -> None:
    """Load what httpx loads at its first call (0.15 s), so that no goal pays for it.

    httpcore looks for sniffio at each of its locks; where that is not installed, each look searches
    the whole path (0.5 ms a call). None in ``sys.modules`` is Python's word for "there is none".
    """
    importlib.import_module("anyio._backends._asyncio")
    if "sniffio" not in sys.modules and importlib.util.find_spec("sniffio") is None:
        sys.modules["sniffio"] = None  # type: ignore[assignment]  # docs.python.org, "The module cache"


class _ConnectFailure(Exception):
    """Nobody took the connection at this address."""

    def __init__(self, down: BrainDown) -> None:
        super().__init__(str(down))
        self.down = down


class Client:
    """Send bodies to one endpoint."""

    def __init__(
        self,
        address: Address,
        settings: ModelSettings,
        transport: httpx.AsyncBaseTransport | None = None,
        meter: Meter | None = None,
    ) -> None:
        self.secret = Secret(settings.key.get_secret_value() if settings.key is not None else "")
        self._names = TargetResolver(address)
        self._http = open_client(address, settings, self.secret.header, transport, meter)
        self.patient = False
        """A server that says it is loading is asked again until the caller's deadline."""
        self.heard_s = float("-inf")
        """When the server last said a word, on the monotonic clock; that it loads is none."""
        self.listeners: set[Callable[[], None]] = set()
        """Called, once each, at its next word."""

    async def close(self) -> None:
        """Give the connections back."""
        await self._http.aclose()

    async def post(self, body: dict[str, Any], left_s: float, told: Told | None = None) -> Any:
        """Return the JSON of a reply, put together where it is a stream; None where it is none.

        A busy or failing server gets one more try inside ``left_s``, and so does a connection that
        was lost before anything came.

        Args:
            body: what to send.
            left_s: how long there is to wait for the second try.
            told: takes what the model has written so far, where the reply is a stream.

        Raises:
            BadRequest: the server does not take the body.
            StreamBroken: the stream ended before the reply did.
            BrainDown: everything else that is no reply, with ``why``.
        """
        end_s = time.monotonic() + left_s
        raw = json.dumps(body, ensure_ascii=False, separators=(",", ":")).encode("utf-8", "replace")
        lost = busy = False
        while True:
            got = await self._anywhere(raw, told)
            if not isinstance(got, RetryableFailure):
                return got
            if got.down.why == "loading" and self.patient:
                await asyncio.sleep(max(LOADING_S, min(got.after_s, LONGEST_LOADING_S)))
                continue
            tried = lost if got.lost else busy
            if tried or not got.after_s <= end_s - time.monotonic():
                raise got.down
            lost, busy = lost or got.lost, busy or not got.lost
            await asyncio.sleep(got.after_s)

    async def _anywhere(self, raw: bytes, told: Told | None) -> Any | RetryableFailure:
        """Try the endpoint's addresses until one takes the connection."""
        refused: BrainDown | None = None
        try:
            targets = await self._names.targets()
        except CallFailure as failure:
            raise BrainDown(str(failure), why=failure.why) from None
        for target in targets:
            try:
                got = await self._post_once(target, raw, told)
            except _ConnectFailure as nobody:
                refused = nobody.down
                continue
            self._names.prefer(target)
            return got
        raise refused or BrainDown("there is no address", why="unreachable")

    async def _post_once(
        self, target: CallTarget, raw: bytes, told: Told | None
    ) -> Any | RetryableFailure:
        assembly = Assembly()
        try:
            async with self._http.stream(
                "POST",
                target.url,
                content=raw,
                headers=target.headers,
                extensions=target.extensions,
            ) as response:
                return await read(response, self.secret, assembly, told, self._hear)
        except (httpx.RemoteProtocolError, httpx.ReadError, httpx.WriteError) as error:
            if assembly.begun:
                raise StreamBroken(type(error).__name__) from None
            # A connection that idled may have been closed by the server; a new one may be well.
            return RetryableFailure(self._wrap_error("server_error", error), lost=True)
        except (httpx.ConnectError, httpx.ConnectTimeout) as error:
            raise _ConnectFailure(self._wrap_error("unreachable", error)) from None
        except httpx.TimeoutException as error:
            raise self._wrap_error("timeout", error) from None
        except httpx.TransportError as error:
            raise self._wrap_error("unreachable", error) from None
        except (httpx.HTTPError, httpx.InvalidURL, ValueError, TypeError, AttributeError) as error:
            # Whatever a reply trips over here is the server's: the offline brain must answer.
            raise self._wrap_error("bad_reply", error) from None

    def _hear(self) -> None:
        self.heard_s = time.monotonic()
        while self.listeners:
            self.listeners.pop()()

    def _wrap_error(self, why: str, error: Exception) -> BrainDown:
        """Return a failure; the words of an error may quote what the server sent."""
        told = self.secret.redact_quoted(str(error))[:200]
        return BrainDown(f"{type(error).__name__}: {told}", why=why)
