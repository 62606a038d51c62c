"""Decide on each request's rights: hosts, origins and tokens. Pure; knows no server.

Loopback needs no token, but Host and Origin are judged there too: a web page of another site, or a
name that somebody points at 127.0.0.1, must not drive the robot.
"""

from __future__ import annotations

import base64
import hmac
import ipaddress
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from planner.people import Person, Role

if TYPE_CHECKING:
    from collections.abc import Callable


class AccessError(Exception):
    """The request is refused; ``code`` is stable, ``status`` is HTTP's."""

    def __init__(self, status: int, code: str, detail: str, *, guessed: bool = False) -> None:
        super().__init__(f"{code}: {detail}")
        self.guessed = guessed  # a token came, and a wrong one
        self.status = status
        self.code = code
        self.detail = detail


LOOPBACK_NAMES = frozenset({"127.0.0.1", "localhost", "::1"})
AUTHORITY_PATH = "/ca.crt"
"""The certificate that a device must trust before anybody types a token there."""
SAFE_METHODS = frozenset({"GET", "HEAD", "OPTIONS"})
TYPED_METHODS = frozenset({"POST", "PUT", "PATCH", "DELETE"})
"""The methods that change something; no route takes any other, and the router says so (405)."""
STOPPING_PATHS = frozenset({"/v1/stop", "/v1/estop", "/v1/disarm"})
"""Whoever may look may also stop, and needs no content type to do it."""
OPERATORS_READING = re.compile(r"/v1/goals/[^/]*/replies/?|/v1/hand/?")
"""What a viewer may not even read: people's words and words out of pictures may stand in it. Nor
may one open the socket of a hand on the stick."""
_GOALS = r"/v1/goals|/v1/goals/[^/]+/(?:answer|cancel)|/v1/rehearsals"
_READING = r"/healthz|/readyz|/v1/(?:robot|map|places|camera\.jpg|objects|localization|events)"
_READING += r"|/v1/(?:goals|history|memory|usage|orders|people|capabilities|skills)"
_READING += r"|/v1/(?:goals|history)/[^/]+"
MAY: dict[Role, tuple[tuple[frozenset[str], re.Pattern[str]], ...]] = {
    Role.AGENT: (
        (SAFE_METHODS, re.compile(_READING)),
        (frozenset({"POST"}), re.compile(_GOALS)),
    ),
    Role.DISPATCHER: (
        (SAFE_METHODS, re.compile(rf"{_READING}|/v1/(?:fence|marks|obstacles|voice|voice/live)")),
        (
            frozenset({"POST"}),
            re.compile(rf"{_GOALS}|/v1/goals/[^/]+/(?:pause|resume|move|confirm)"),
        ),
        (frozenset({"POST"}), re.compile(r"/v1/voice(?:/hush)?")),
    ),
}
"""The routes of the roles that are listed; a route that is absent, and so a new one, is refused.
Everybody with a token may stop (``STOPPING_PATHS``)."""
PEOPLE_PATH = "/v1/people"
"""The owner's to change: who could add people could add a way in that outlives a removal."""
OWNERS_PATHS = ("/v1/settings", "/v1/wizard")
"""The owner's to see and to change: an address there is where people's words and a key go."""


FORWARDED = ("forwarded", "via")
FORWARDED_PREFIX = "x-forwarded-"
"""What a proxy adds. Behind one, everybody comes from loopback."""

JSON_TYPES = frozenset({"application/json"})
BODY_TYPES = {
    "/v1/voice": frozenset({"audio/wav", "audio/x-wav", "audio/wave", "audio/vnd.wave"}),
}
"""What a route's body is where it is not JSON. A form of another site can send none of these
types, so they guard as JSON does."""


SUBPROTOCOL = "pons.v1"
TOKEN_PREFIX = "bearer."
"""A browser can't set a header on a WebSocket: it offers ``pons.v1, bearer.TOKEN`` as subprotocols,
the token in unpadded base64url; only the first is ever chosen, so the token is not echoed."""


@dataclass(frozen=True, slots=True)
class Access:
    """Hold the rules of one planner."""

    bind_host: str
    hosts: frozenset[str] = LOOPBACK_NAMES
    origins: frozenset[str] = frozenset()
    operator_token: str = ""
    viewer_token: str = ""
    find_person: Callable[[str], Person | None] = lambda _: None
    """Gives the person of a token, or None."""
    speaks_tls: bool = False
    """A page that came without TLS may then not ask: who is on the path could have written it."""

    @property
    def loopback(self) -> bool:
        """Say whether only this machine can reach us."""
        return is_loopback(self.bind_host)

    def judge(
        self, method: str, path: str, headers: dict[str, str], *, websocket: bool = False
    ) -> Role:
        """Return the asker's role.

        Raises:
            AccessError: foreign host or origin, no valid token, a role that may not, or a body of
                another type than the path takes: JSON, or sound for /v1/voice.
        """
        host = headers.get("host", "")
        self._check_host(host)
        self._check_origin(headers.get("origin"), host)
        self._check_proxy(path, headers)
        if method in SAFE_METHODS and not websocket and _is_page(path):
            return Role.VIEWER  # the page holds no secret, and a browser asks for it without token
        token = _token_of(headers, websocket=websocket)
        role = self._role(token)
        if not _may(role, method, path):
            raise AccessError(403, "person_needed", f"{method} {path[:80]} is not the {role}'s")
        changes = method not in SAFE_METHODS
        owners = path.startswith(OWNERS_PATHS) or (changes and path.startswith(PEOPLE_PATH))
        if owners and not self._is_owner(token):
            raise AccessError(403, "owner_needed", f"{method} {path[:80]} is the owner's alone")
        if role is not Role.OPERATOR and OPERATORS_READING.fullmatch(path):
            detail = f"the viewer's token came; {method} {path[:80]} needs the operator's"
            raise AccessError(403, "operator_needed", detail)
        if not websocket and method not in SAFE_METHODS and path not in STOPPING_PATHS:
            if method in TYPED_METHODS:
                _check_type(headers.get("content-type", ""), BODY_TYPES.get(path, JSON_TYPES))
            if role is Role.VIEWER:
                raise AccessError(403, "operator_needed", _viewers_limit(method, path))
        return role

    def person(self, headers: dict[str, str], *, websocket: bool = False) -> Person | None:
        """Return the person whose token came; None for the owner's, the viewer's and none."""
        return self.find_person(_token_of(headers, websocket=websocket))

    def _is_owner(self, token: str) -> bool:
        """Say whether the owner asks: with the operator's token, or from here where none is set."""
        if self.find_person(token) is not None:
            return False
        return self._trusts_loopback or _is_same(token, self.operator_token)

    def _check_host(self, host: str) -> None:
        name = _hostname(f"//{host}")
        if name not in self.hosts:
            known = ", ".join(sorted(self.hosts))
            raise AccessError(403, "foreign_host", f"host {host[:80]!r}; allowed: {known}")

    def _check_origin(self, origin: str | None, host: str) -> None:
        if origin is None or origin in self.origins:
            return
        scheme, _, rest = origin.partition("://")
        schemes = ("https",) if self.speaks_tls else ("http", "https")  # a proxy may add the TLS
        if scheme in schemes and rest == host and _hostname(origin):
            return
        known = ", ".join(sorted({f"{schemes[0]}://{host}", *self.origins}))
        raise AccessError(403, "foreign_origin", f"origin {origin[:80]!r}; allowed: {known}")

    def _check_proxy(self, path: str, headers: dict[str, str]) -> None:
        """Refuse what a proxy hands on where no token tells its askers apart; never a stop."""
        if not self._trusts_loopback or path in STOPPING_PATHS:
            return
        for name in headers:
            if name in FORWARDED or name.startswith(FORWARDED_PREFIX):
                detail = (
                    f"the header {name[:80]!r} says that a proxy stands in front, so anybody may "
                    "ask; set PONS_OPERATOR_TOKEN for the planner"
                )
                raise AccessError(403, "proxy_without_token", detail)

    @property
    def _trusts_loopback(self) -> bool:
        return self.loopback and not self.operator_token

    def _role(self, token: str) -> Role:
        person = self.find_person(token)
        if person is not None:
            return person.role
        if self._trusts_loopback:
            return Role.OPERATOR
        if _is_same(token, self.operator_token):
            return Role.OPERATOR
        if _is_same(token, self.viewer_token):
            return Role.VIEWER
        came = "the token that came is not one of this planner's" if token else "no token came"
        detail = f"{came}; send Authorization: Bearer with the operator's or the viewer's token"
        raise AccessError(401, "token_needed", detail, guessed=bool(token))


def _may(role: Role, method: str, path: str) -> bool:
    """Return whether the table of a role has a route; a role without one is judged by kinds."""
    if role not in MAY or (path in STOPPING_PATHS and method == "POST"):
        return True
    rows = MAY[role]
    return any(method in methods and paths.fullmatch(path) for methods, paths in rows)


def _viewers_limit(method: str, path: str) -> str:
    """Say what came, what it needs, and what a viewer may do instead."""
    needed = f"the viewer's token came; {method} {path[:80]} needs the operator's"
    return f"{needed}; a viewer may GET, and POST {', '.join(sorted(STOPPING_PATHS))}"


def is_loopback(host: str) -> bool:
    """Say whether an address or name is this machine's own."""
    if host in LOOPBACK_NAMES:
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def _hostname(address: str) -> str:
    """Return an address's host; empty where it is none."""
    try:
        return urlsplit(address).hostname or ""
    except ValueError:
        return ""


def _is_page(path: str) -> bool:
    return path in ("/", AUTHORITY_PATH) or path.startswith("/assets/")


def _token_of(headers: dict[str, str], *, websocket: bool) -> str:
    """Return the token that came, in a header or as a WebSocket's subprotocol; empty if none."""
    token = _bearer(headers.get("authorization", ""))
    if websocket and not token:
        token = _find_token(headers.get("sec-websocket-protocol", ""))
    return token


def _bearer(authorization: str) -> str:
    scheme, _, token = authorization.partition(" ")
    return token if scheme.lower() == "bearer" else ""


def _find_token(subprotocols: str) -> str:
    """Return the token among the subprotocols that a browser offers; empty if there is none."""
    for offer in subprotocols.split(","):
        name = offer.strip()
        if name.startswith(TOKEN_PREFIX):
            text = name.removeprefix(TOKEN_PREFIX)
            try:
                return base64.b64decode(text + "=" * (-len(text) % 4), b"-_", True).decode()
            except ValueError:
                return ""
    return ""


def _is_same(given: str, expected: str) -> bool:
    return bool(expected) and hmac.compare_digest(given.encode(), expected.encode())


def _check_type(content_type: str, expected: frozenset[str]) -> None:
    kind = content_type.partition(";")[0].strip().lower()
    if kind not in expected:
        known = " or ".join(sorted(expected))
        found = f"content type {content_type[:80]!r}" if content_type else "no content type"
        text = f"{found}; expected {known}"
        raise AccessError(415, "unsupported_media_type", text)
