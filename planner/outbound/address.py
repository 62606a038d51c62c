"""Judge where a server that the owner named may be, and pin each call to an address judged before.

Link-local addresses hold the metadata services of clouds, which give out credentials to whoever
asks; no model, no recogniser and no voice lives there. Names are judged by what they are and,
before a call, by what they resolve to. A name that resolves to a harmless address now and to a
metadata service at the connection would otherwise pass: so the call goes to the very address that
was judged, with the name in the Host header and in the TLS handshake, where the certificate is held
against it.
"""

from __future__ import annotations

import asyncio
import ipaddress
import socket
import time
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import urlsplit

from planner.outbound.errors import CallFailure
from wire import ConfigError

MAX_URL = 2000
_METADATA_NAMES = frozenset(
    {
        *("metadata", "metadata.google.internal", "metadata.goog", "instance-data"),
        *("instance-data.ec2.internal", "metadata.tencentyun.com", "metadata.azure.internal"),
    }
)
_METADATA_ADDRESSES = frozenset(
    map(
        ipaddress.ip_address,
        ("100.100.100.200", "fd00:ec2::254", "168.63.129.16", "192.0.0.192"),
    )
)
_NAT64 = ipaddress.IPv6Network("64:ff9b::/96")
"""Holds an IPv4 address in its last 32 bits, RFC 6052; so does ::/96, the old mixed form."""
_MIXED = ipaddress.IPv6Network("::/96")
_BROADCAST = ipaddress.IPv4Address("255.255.255.255")
_LOOPBACK_NAMES = frozenset({"localhost", "localhost.localdomain", "ip6-localhost"})

Ip = ipaddress.IPv4Address | ipaddress.IPv6Address


@dataclass(frozen=True, slots=True)
class Address:
    """Hold the one URL that is asked."""

    url: str
    """Of the one route that is called, whole."""
    host: str
    port: int
    local: bool
    """On this machine."""
    literal: bool
    """The host is a number, so nothing needs to be resolved."""

    @classmethod
    def parse(cls, base: str, route: str = "/chat/completions", setting: str = "model") -> Address:
        """Return the address below a base URL.

        Args:
            base: as the owner wrote it, for example ``http://127.0.0.1:11434/v1``.
            route: what is called below it.
            setting: the table of settings.toml that names it, for errors.

        Raises:
            ConfigError: ``model_url`` (or that of another setting), with what is wrong; user names
                and passwords in it are not repeated.
        """
        if not (0 < len(base) <= MAX_URL and base.isascii() and base.isprintable()):
            raise _wrong(setting, "must be plain ASCII text without spaces")
        try:
            parts = urlsplit(base)
            port = parts.port
        except ValueError:
            raise _wrong(setting, "is no URL") from None
        if parts.scheme not in ("http", "https"):
            raise _wrong(setting, f"has the scheme {parts.scheme!r}; expected http or https")
        if parts.username is not None or parts.password is not None:
            raise _wrong(setting, "carries a user name or password; set the key apart from it")
        if parts.query or parts.fragment or " " in base or "\\" in base:
            raise _wrong(setting, "must end with the path: no query, no fragment, no spaces")
        host = (parts.hostname or "").rstrip(".")
        if not host:
            raise _wrong(setting, "names no host")
        number = _number(host)
        if _metadata_name(host) or (number is not None and not is_allowed(number)):
            raise _wrong(
                setting, f"leads to {host}: link-local and metadata addresses are never asked"
            )
        if port is None:
            port = 443 if parts.scheme == "https" else 80
        local = host in _LOOPBACK_NAMES or (number is not None and number.is_loopback)
        shown = f"[{host}]" if ":" in host else host
        url = f"{parts.scheme}://{shown}:{port}{_path(parts.path, route)}"
        return cls(url, host, port, local, number is not None)


def is_allowed(number: Ip) -> bool:
    """Tell whether an address may be asked at all."""
    if not all(map(is_allowed, _inner(number))):
        return False
    wrong = number.is_link_local or number.is_multicast or number.is_unspecified
    return not (wrong or number in _METADATA_ADDRESSES or number == _BROADCAST)


def _inner(number: Ip) -> list[ipaddress.IPv4Address]:
    """Return the IPv4 addresses that an IPv6 address leads to, by any way of wrapping one."""
    if isinstance(number, ipaddress.IPv4Address):
        return []
    wrapped = [number.ipv4_mapped, number.sixtofour, *(number.teredo or ())]
    if number in _NAT64 or (number in _MIXED and int(number) > 1):
        wrapped.append(ipaddress.IPv4Address(int(number) & 0xFFFFFFFF))
    return [each for each in wrapped if each is not None]


def refused_among(found: list[str]) -> str | None:
    """Return the first resolved address that may not be asked, or None."""
    for text in found:
        try:
            number = ipaddress.ip_address(text.split("%", maxsplit=1)[0])
        except ValueError:
            return text
        if not is_allowed(number):
            return text
    return None


def _number(host: str) -> Ip | None:
    """Return the address that a host's text is, in any spelling that a resolver accepts."""
    try:
        return ipaddress.ip_address(host.split("%", maxsplit=1)[0])
    except ValueError:
        pass
    try:  # 0xA9FEA9FE, 2852039166, 0251.0376.0251.0376 and 169.254.43518 are all one address
        return ipaddress.IPv4Address(socket.inet_aton(host))
    except OSError:
        return None


def _metadata_name(host: str) -> bool:
    return host.lower() in _METADATA_NAMES


def _path(path: str, route: str) -> str:
    path = path.rstrip("/")
    return path if path.endswith(route) else f"{path or '/v1'}{route}"


def _wrong(setting: str, what: str) -> ConfigError:
    return ConfigError(f"{setting}_url", f"the URL under [{setting}] {what}")


RESOLVED_FOR_S = 60.0
MAX_TRIED = 3
"""Addresses of one name; a host with more is not waited for that long."""


@dataclass(frozen=True, slots=True)
class CallTarget:
    """Say where one call goes."""

    url: str
    headers: dict[str, str] = field(default_factory=dict)
    extensions: dict[str, Any] = field(default_factory=dict)
    ip: str = ""
    """Empty where nothing was looked up."""


class TargetResolver:
    """Turn one endpoint into targets; a name is looked up once a minute."""

    def __init__(self, address: Address) -> None:
        self._address = address
        self._resolved_s = float("-inf")
        self._targets: tuple[CallTarget, ...] = (CallTarget(address.url),)

    async def targets(self) -> tuple[CallTarget, ...]:
        """Return where to call, the best first.

        Raises:
            CallFailure: ``refused_address`` or ``unreachable``.
        """
        now_s = time.monotonic()
        fixed = self._address.literal or self._address.local
        if fixed or now_s - self._resolved_s <= RESOLVED_FOR_S:
            return self._targets
        found = await self._look_up()
        wrong = refused_among(found)
        if wrong is not None:
            told = f"{self._address.host} resolves to {wrong}, which is never asked"
            raise CallFailure(told, why="refused_address")
        # Names of large services turn their addresses round at each look; a connection is kept.
        found.sort(key=lambda ip: ip != self._targets[0].ip)
        self._targets = tuple(map(self._pin, found[:MAX_TRIED]))
        self._resolved_s = now_s
        return self._targets

    def prefer(self, target: CallTarget) -> None:
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
            raise CallFailure(f"{type(error).__name__}: {error}"[:200], why="unreachable") from None
        addresses = list(dict.fromkeys(str(entry[4][0]) for entry in found))
        if not addresses:
            raise CallFailure(f"{host} resolves to nothing", why="unreachable")
        return addresses

    def _pin(self, ip: str) -> CallTarget:
        host, port = self._address.host, self._address.port
        usual = 443 if self._address.url.startswith("https:") else 80
        shown = f"[{ip}]" if ":" in ip else ip
        return CallTarget(
            self._address.url.replace(f"://{host}:{port}", f"://{shown}:{port}", 1),
            {"Host": host if port == usual else f"{host}:{port}"},
            {"sni_hostname": host},
            ip,
        )
