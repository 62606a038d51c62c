"""Own the HTTP of one endpoint: one client kept alive, one URL, second tries, typed failures.

The key leaves this file in one header to one host: redirects are not followed, proxies and netrc of
the environment are not used, and it is struck out of whatever a server says. The caller holds the
deadline; everything here is cut when it passes.
"""

from __future__ import annotations

import asyncio
import json
import time
from typing import Any

import httpx

from planner.brain.endpoint.connection import opened
from planner.brain.endpoint.dns_pinning import Names, Target
from planner.brain.endpoint.http_status import Again
from planner.brain.endpoint.key_redaction import Secret
from planner.brain.endpoint.response_reader import StreamBroken, Told, read
from planner.brain.endpoint.stream_assembler import Assembly
from planner.brain.endpoint.url_policy import Address
from planner.brain.errors import BrainDown
from planner.brain.usage_meter import Meter
from planner.settings import ModelSettings


class _Unconnected(Exception):
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
        self._names = Names(address)
        self._http = opened(address, settings, self.secret.header, transport, meter)

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
            if not isinstance(got, Again):
                return got
            tried = lost if got.lost else busy
            if tried or not got.after_s <= end_s - time.monotonic():
                raise got.down
            lost, busy = lost or got.lost, busy or not got.lost
            await asyncio.sleep(got.after_s)

    async def _anywhere(self, raw: bytes, told: Told | None) -> Any | Again:
        """Try the endpoint's addresses until one takes the connection."""
        refused: BrainDown | None = None
        for target in await self._names.targets():
            try:
                got = await self._once(target, raw, told)
            except _Unconnected as nobody:
                refused = nobody.down
                continue
            self._names.answered(target)
            return got
        raise refused or BrainDown("there is no address", why="unreachable")

    async def _once(self, target: Target, raw: bytes, told: Told | None) -> Any | Again:
        assembly = Assembly()
        try:
            async with self._http.stream(
                "POST",
                target.url,
                content=raw,
                headers=target.headers,
                extensions=target.extensions,
            ) as response:
                return await read(response, self.secret, assembly, told)
        except (httpx.RemoteProtocolError, httpx.ReadError, httpx.WriteError) as error:
            if assembly.begun:
                raise StreamBroken(type(error).__name__) from None
            # A connection that idled may have been closed by the server; a new one may be well.
            return Again(self._down("server_error", error), lost=True)
        except (httpx.ConnectError, httpx.ConnectTimeout) as error:
            raise _Unconnected(self._down("unreachable", error)) from None
        except httpx.TimeoutException as error:
            raise self._down("timeout", error) from None
        except httpx.TransportError as error:
            raise self._down("unreachable", error) from None
        except (httpx.HTTPError, httpx.InvalidURL, ValueError, TypeError, AttributeError) as error:
            # Whatever a reply trips over here is the server's: the offline brain must answer.
            raise self._down("bad_reply", error) from None

    def _down(self, why: str, error: Exception) -> BrainDown:
        """Return a failure; the words of an error may quote what the server sent."""
        told = self.secret.struck_quoted(str(error))[:200]
        return BrainDown(f"{type(error).__name__}: {told}", why=why)
