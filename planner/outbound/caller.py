"""Post to one server that the owner named, once, and read a bounded answer or a typed failure.

The key leaves this file in one header to one host: redirects are not followed, proxies and netrc of
the environment are not used, and it is struck out of whatever a server says. Nothing is sent twice:
whoever calls knows whether a second try is worth the wait.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import httpx

from planner.outbound.address import Address, CallTarget, TargetResolver
from planner.outbound.errors import CallFailure
from planner.outbound.secret import Secret

Transport = httpx.AsyncBaseTransport
MAX_TOLD = 200
"""Characters of a server's own words in a failure."""
_WHY = {
    **dict.fromkeys((401, 403), "bad_key"),
    **dict.fromkeys((408, 409, 425, 429), "rate_limited"),
    **dict.fromkeys((404, 405, 410), "unknown_route"),
}


@dataclass(frozen=True, slots=True)
class CallAnswer:
    """Hold what a server answered with a status of 2xx."""

    kind: str
    """The media type, without parameters, in lower case."""
    body: bytes
    headers: Mapping[str, str] = field(default_factory=dict)
    """The server's, by their names in lower case."""


class Caller:
    """Call one address. Knows what is sent; not what it means."""

    def __init__(
        self,
        address: Address,
        key: str = "",
        *,
        timeout_s: float,
        connect_timeout_s: float = 3.0,
        transport: Transport | None = None,
    ) -> None:
        """Open nothing yet.

        Args:
            address: where every call goes.
            key: sent as a bearer's; empty for none.
            timeout_s: of each wait of one call; the caller holds the deadline of the whole.
            connect_timeout_s: until the server takes the connection.
            transport: another than the network, for tests.
        """
        logging.getLogger("httpcore").setLevel(logging.WARNING)  # its debug lines quote headers
        logging.getLogger("httpx").setLevel(logging.WARNING)  # a line for each call is too much
        self.address = address
        self.secret = Secret(key)
        self._names = TargetResolver(address)
        self._http = httpx.AsyncClient(
            headers={
                "Accept-Encoding": "identity",  # a small body must not unpack into a large one
                "User-Agent": "pons",
                **self.secret.header,
            },
            follow_redirects=False,
            trust_env=False,
            transport=transport
            or httpx.AsyncHTTPTransport(
                trust_env=False,
                verify=address.url.startswith("https:"),  # certificates cost 0.1 s and 10 MB
                limits=httpx.Limits(max_connections=4, max_keepalive_connections=1),
            ),
            timeout=httpx.Timeout(timeout_s, connect=connect_timeout_s),
        )

    async def close(self) -> None:
        """Give the connections back."""
        await self._http.aclose()

    async def post(
        self,
        *,
        most_bytes: int,
        json: Mapping[str, Any] | None = None,
        content: bytes | None = None,
        form: Mapping[str, str] | None = None,
        files: Mapping[str, tuple[str, bytes, str]] | None = None,
        headers: Mapping[str, str] | None = None,
        is_whole: Callable[[bytes], bool] = lambda _: False,
    ) -> CallAnswer:
        """Return the server's answer.

        Args:
            most_bytes: a longer body is a failure.
            json: a body, or
            content: a body as it is, or
            form: fields, and with them
            files: name of a field -> file name, bytes and media type.
            headers: more of them.
            is_whole: is handed each piece as it comes; a yes ends the reading of a stream.

        Raises:
            CallFailure: ``unreachable``, ``refused_address``, ``timeout``, ``redirect``,
                ``bad_key``, ``rate_limited``, ``unknown_route``, ``bad_request``,
                ``server_error``, ``too_large`` or ``bad_reply``.
        """
        refused: CallFailure | None = None
        body = {"json": json, "content": content, "data": form, "files": files}
        given = {name: value for name, value in body.items() if value is not None}
        for target in await self._names.targets():
            try:
                answer = await self._post_once(
                    target, dict(headers or {}), given, most_bytes, is_whole
                )
            except (httpx.ConnectError, httpx.ConnectTimeout) as error:
                refused = self._failure("unreachable", error)
                continue
            self._names.prefer(target)
            return answer
        raise refused or CallFailure("there is no address", why="unreachable")

    async def _post_once(
        self,
        target: CallTarget,
        headers: dict[str, str],
        given: dict[str, Any],
        most: int,
        is_whole: Callable[[bytes], bool],
    ) -> CallAnswer:
        try:
            async with self._http.stream(
                "POST",
                target.url,
                headers={**headers, **target.headers},
                extensions=target.extensions,
                **given,
            ) as response:
                if not 200 <= response.status_code < 300:
                    raise await self._refusal(response)
                packed = response.headers.get("content-encoding", "identity").lower()
                if packed != "identity":
                    raise CallFailure(f"the answer is packed as {packed[:40]}", why="bad_reply")
                body = bytearray()
                async for piece in response.aiter_raw():
                    body += piece
                    if len(body) > most:
                        raise CallFailure(f"more than {most} bytes came", why="too_large")
                    if is_whole(piece):
                        break
        except (httpx.ConnectError, httpx.ConnectTimeout):
            raise
        except httpx.TimeoutException as error:
            raise self._failure("timeout", error) from None
        except httpx.TransportError as error:
            raise self._failure("unreachable", error) from None
        except (httpx.HTTPError, httpx.InvalidURL, httpx.StreamError, ValueError) as error:
            raise self._failure("bad_reply", error) from None
        kind = response.headers.get("content-type", "").partition(";")[0].strip().lower()
        told = {name.lower(): value for name, value in response.headers.items()}
        return CallAnswer(kind, self.secret.struck_bytes(bytes(body)), told)

    async def _refusal(self, response: httpx.Response) -> CallFailure:
        """Return the failure of a status that is no 2xx, with the beginning of its words."""
        status = response.status_code
        if 300 <= status < 400:
            return CallFailure(f"status {status}; redirects are not followed", why="redirect")
        raw = b""
        async for piece in response.aiter_raw():
            raw += piece
            if len(raw) >= 4 * MAX_TOLD:
                break
        words = self.secret.redact(" ".join(raw.decode("utf-8", "replace").split()))
        why = _WHY.get(status, "server_error" if status >= 500 else "bad_request")
        return CallFailure(f"status {status}: {words[:MAX_TOLD]}", why=why)

    def _failure(self, why: str, error: Exception) -> CallFailure:
        """Return a failure; the words of an error may quote what the server sent."""
        told = self.secret.redact_quoted(str(error))[:MAX_TOLD]
        return CallFailure(f"{type(error).__name__}: {told}", why=why)
