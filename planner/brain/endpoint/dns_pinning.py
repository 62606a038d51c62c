"""Look the endpoint's name up, and pin the call to what was found and judged.

A name that resolves to a harmless address now and to a metadata service at the connection would
otherwise pass: so the call goes to the very address that was judged, with the name in the Host
header and in the TLS handshake, where the certificate is held against it.
"""

from __future__ import annotations

import asyncio
import socket
import time
from dataclasses import dataclass, field
from typing import Any

from planner.brain.endpoint.url_policy import Address, refused_among
from planner.brain.errors import BrainDown

RESOLVED_FOR_S = 60.0
MAX_TRIED = 3
"""Addresses of one name; a host with more is not waited for that long."""


@dataclass(frozen=True, slots=True)
class Target:
    """Say where one call goes."""

    url: str
    headers: dict[str, str] = field(default_factory=dict)
    extensions: dict[str, Any] = field(default_factory=dict)
    ip: str = ""
    """Empty where nothing was looked up."""


class Names:
    """Turn one endpoint into targets; a name is looked up once a minute."""

    def __init__(self, address: Address) -> None:
        self._address = address
        self._resolved_s = float("-inf")
        self._targets: tuple[Target, ...] = (Target(address.url),)

    async def targets(self) -> tuple[Target, ...]:
        """Return where to call, the best first.

        Raises:
            BrainDown: ``refused_address`` or ``unreachable``.
        """
        now_s = time.monotonic()
        fixed = self._address.literal or self._address.local
        if fixed or now_s - self._resolved_s <= RESOLVED_FOR_S:
            return self._targets
        found = await self._look_up()
        wrong = refused_among(found)
        if wrong is not None:
            told = f"{self._address.host} resolves to {wrong}, which is never asked"
            raise BrainDown(told, why="refused_address")
        # Names of large services turn their addresses round at each look; a connection is kept.
        found.sort(key=lambda ip: ip != self._targets[0].ip)
        self._targets = tuple(map(self._pinned, found[:MAX_TRIED]))
        self._resolved_s = now_s
        return self._targets

    def answered(self, target: Target) -> None:
        """Try this one first from now on."""
        if target is not self._targets[0]:
            rest = tuple(each for each in self._targets if each is not target)
            self._targets = (target, *rest)

    async def _look_up(self) -> list[str]:
        loop = asyncio.get_running_loop()
        host, port = self._address.host, self._address.port
        try:
            found = await loop.getaddrinfo(host, port, type=socket.SOCK_STREAM)
        except OSError as error:
            raise BrainDown(f"{type(error).__name__}: {error}"[:200], why="unreachable") from None
        addresses = list(dict.fromkeys(str(entry[4][0]) for entry in found))
        if not addresses:
            raise BrainDown(f"{host} resolves to nothing", why="unreachable")
        return addresses

    def _pinned(self, ip: str) -> Target:
        host, port = self._address.host, self._address.port
        usual = 443 if self._address.url.startswith("https:") else 80
        shown = f"[{ip}]" if ":" in ip else ip
        return Target(
            self._address.url.replace(f"://{host}:{port}", f"://{shown}:{port}", 1),
            {"Host": host if port == usual else f"{host}:{port}"},
            {"sni_hostname": host},
            ip,
        )
