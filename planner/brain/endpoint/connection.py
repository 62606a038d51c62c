"""Open the one HTTP client of an endpoint: no redirects, no environment, kept alive, metered."""

from __future__ import annotations

import logging
import socket

import httpx

from planner.brain.endpoint.metered_transport import Metered
from planner.brain.endpoint.url_policy import Address
from planner.brain.usage_meter import Meter
from planner.settings import ModelSettings

KEEPALIVE_S = 600.0
"""A connection is kept through idle minutes; one that the server has closed is noticed and opened
anew, and one that a router on the way forgot is noticed by the probes."""
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


def opened(
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
        transport=inner if meter is None else Metered(inner, meter),
        timeout=httpx.Timeout(settings.timeout_s, connect=settings.connect_timeout_s),
    )
