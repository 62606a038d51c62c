"""Own the HTTP of one endpoint: one client kept alive, one URL, bounded replies, typed failures.

The key leaves this file in one header to one host: redirects are not followed, proxies and netrc of
the environment are not used, and it is struck out of whatever a server says. The caller holds the
deadline; everything here is cut when it passes.
"""

from __future__ import annotations

import asyncio
import json
import logging
import socket
import time
from typing import Any

import httpx

from planner.brain.endpoint.address import Address, refused_among
from planner.brain.endpoint.metered import Metered
from planner.brain.endpoint.reply import complaint_of, generated_by, read_json
from planner.brain.errors import BrainDown
from planner.brain.meter import Meter
from planner.settings import ModelSettings

log = logging.getLogger(__name__)

MAX_REPLY_BYTES = 1_000_000
MAX_ERROR_BYTES = 64_000
KEEPALIVE_S = 300.0
RESOLVED_FOR_S = 60.0
BUSY = frozenset({408, 409, 425, 429})
PAUSE_S = 0.5
"""Before the second try, where the server names no time."""
_STRUCK = "***"
MIN_STRUCK = 6
"""Characters; a shorter key protects nothing, and striking it out would break every reply."""


class BadRequest(Exception):
    """The server refused the body: perhaps a simpler one pleases it. Holds its words.

    ``generated``: the model did reply, and the server itself found that it does not fit (Groq).
    """

    def __init__(self, said: str, generated: str | None = None) -> None:
        super().__init__(said)
        self.generated = generated


class Client:
    """Send bodies to one endpoint."""

    def __init__(
        self,
        address: Address,
        settings: ModelSettings,
        transport: httpx.AsyncBaseTransport | None = None,
        meter: Meter | None = None,
    ) -> None:
        self._address = address
        self._key = settings.key.get_secret_value() if settings.key is not None else ""
        self._resolved_s = float("-inf")
        headers = {
            "Accept": "application/json",
            "Accept-Encoding": "identity",  # a small body must not unpack into a large one
            "Content-Type": "application/json",
            "User-Agent": "pons",
        }
        if self._key:
            headers["Authorization"] = f"Bearer {self._key}"
        inner = transport or httpx.AsyncHTTPTransport(
            trust_env=False,
            verify=address.url.startswith("https:"),  # certificates cost 0.1 s and 10 MB to load
            limits=httpx.Limits(
                max_connections=settings.parallel + 2,
                max_keepalive_connections=settings.parallel,
                keepalive_expiry=KEEPALIVE_S,
            ),
        )
        self._http = httpx.AsyncClient(
            headers=headers,
            follow_redirects=False,
            trust_env=False,
            transport=inner if meter is None else Metered(inner, meter),
            timeout=httpx.Timeout(settings.timeout_s, connect=settings.connect_timeout_s),
        )

    async def close(self) -> None:
        """Give the connections back."""
        await self._http.aclose()

    async def post(self, body: dict[str, Any], left_s: float) -> bytes:
        """Return the bytes of a 200; a busy or failing server gets one more try inside ``left_s``.

        Raises:
            BadRequest: 400 or 422.
            BrainDown: everything else that is no 200, with ``why``.
        """
        end_s = time.monotonic() + left_s
        raw = json.dumps(body, ensure_ascii=False, separators=(",", ":")).encode("utf-8", "replace")
        await self._check_name()
        first = await self._once(raw)
        if isinstance(first, bytes):
            return first
        if not first.again_after_s <= end_s - time.monotonic():
            raise first.down
        await asyncio.sleep(first.again_after_s)
        second = await self._once(raw)
        if isinstance(second, bytes):
            return second
        raise second.down

    async def _once(self, raw: bytes) -> bytes | _Again:
        try:
            async with self._http.stream("POST", self._address.url, content=raw) as response:
                cap = MAX_REPLY_BYTES if response.status_code == 200 else MAX_ERROR_BYTES
                return self._judged(response, self._struck(await _read(response, cap)))
        except (httpx.RemoteProtocolError, httpx.ReadError, httpx.WriteError) as error:
            # A connection that idled may have been closed by the server; a new one may be well.
            return _Again(_down("server_error", error), 0.0)
        except httpx.TimeoutException as error:
            slow_to_connect = isinstance(error, httpx.ConnectTimeout)
            raise _down("unreachable" if slow_to_connect else "timeout", error) from None
        except httpx.TransportError as error:
            raise _down("unreachable", error) from None
        except (httpx.HTTPError, httpx.InvalidURL, ValueError) as error:
            raise _down("bad_reply", error) from None

    def _judged(self, response: httpx.Response, raw: bytes) -> bytes | _Again:
        """Class an answer by its status.

        Raises:
            BadRequest, BrainDown: see ``post``.
        """
        status = response.status_code
        if 200 <= status < 300:
            return raw
        content = read_json(raw)
        said = self.struck(f"status {status}: {complaint_of(content)}")
        if status in (400, 422):
            raise BadRequest(said, generated_by(content))
        if status in (401, 403):
            raise BrainDown(said, why="bad_key")
        if status in (404, 405, 410):
            raise BrainDown(said, why="unknown_model")
        if 300 <= status < 400:
            raise BrainDown(f"status {status}; redirects are not followed", why="redirect")
        if status in BUSY:
            return _Again(BrainDown(said, why="rate_limited"), _wait_s(response))
        if status >= 500:
            return _Again(BrainDown(said, why="server_error"), _wait_s(response))
        raise BrainDown(said, why="bad_request")

    def struck(self, text: str) -> str:
        """Strike the key out: what a server echoes must reach neither a log nor a goal."""
        return text.replace(self._key, _STRUCK) if len(self._key) >= MIN_STRUCK else text

    def _struck(self, raw: bytes) -> bytes:
        key = self._key.encode("ascii")
        return raw.replace(key, _STRUCK.encode()) if len(key) >= MIN_STRUCK else raw

    async def _check_name(self) -> None:
        """Refuse a name that resolves to where nothing may be asked; looked up once a minute.

        Raises:
            BrainDown: ``refused_address`` or ``unreachable``.
        """
        now_s = time.monotonic()
        if self._address.literal or self._address.local:
            return
        if now_s - self._resolved_s <= RESOLVED_FOR_S:
            return
        loop = asyncio.get_running_loop()
        try:
            found = await loop.getaddrinfo(
                self._address.host, self._address.port, type=socket.SOCK_STREAM
            )
        except OSError as error:
            raise _down("unreachable", error) from None
        wrong = refused_among([str(entry[4][0]) for entry in found])
        if wrong is not None:
            told = f"{self._address.host} resolves to {wrong}, which is never asked"
            raise BrainDown(told, why="refused_address")
        self._resolved_s = now_s


class _Again:
    """Hold a failure that another try may mend."""

    def __init__(self, down: BrainDown, again_after_s: float) -> None:
        self.down = down
        self.again_after_s = again_after_s


async def _read(response: httpx.Response, cap: int) -> bytes:
    """Return a body of at most ``cap`` bytes, as it is on the wire.

    Raises:
        BrainDown: ``too_large``, as soon as it is; ``bad_reply``: it is packed unasked.
    """
    if response.headers.get("content-encoding", "identity").lower() not in ("identity", ""):
        raise BrainDown("the reply is packed, though that was not asked for", why="bad_reply")
    body = bytearray()
    async for chunk in response.aiter_raw():
        if len(body) + len(chunk) > cap:
            if response.status_code != 200:
                break
            raise BrainDown(f"the reply is over {cap} bytes", why="too_large")
        body += chunk
    return bytes(body)


def _wait_s(response: httpx.Response) -> float:
    """Return the pause before the next try [s]; a time that is no number counts as for ever."""
    asked = response.headers.get("retry-after")
    if asked is None:
        return PAUSE_S
    try:
        seconds = float(asked)
    except ValueError:
        return float("inf")
    return seconds if seconds >= 0.0 else float("inf")


def _down(why: str, error: Exception) -> BrainDown:
    return BrainDown(f"{type(error).__name__}: {str(error)[:200]}", why=why)
