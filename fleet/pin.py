"""Know a robot again by its certificate: pinned when it is added, asked for at each connection.

Pinned is the robot's own authority where it gives one (``/ca.crt``) that signed its certificate, so
that a renewed one passes; else the certificate itself. Trust is given once, when a
robot is added: the SHA-256 is shown then, to be compared with ``pons tls`` on the robot.
"""

from __future__ import annotations

import hashlib
import http.client
import ipaddress
import ssl
from dataclasses import dataclass
from typing import Literal
from urllib.parse import urlsplit

from fleet.errors import FleetError

PinKind = Literal["authority", "leaf", "none"]
TIMEOUT_S = 5.0
AUTHORITY_PATH = "/ca.crt"
MAX_CERTIFICATE_BYTES = 100_000


@dataclass(frozen=True, slots=True)
class Pin:
    """Hold what a robot is known by; of kind ``none`` for one on this machine without TLS."""

    kind: PinKind = "none"
    sha256: str = ""
    pem: str = ""

    def context(self) -> ssl.SSLContext:
        """Return what judges a connection; without a pin no certificate passes."""
        if self.kind == "none":
            return ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
        return _trusting(self.pem, is_leaf=self.kind == "leaf")


def clean_url(given: str) -> str:
    """Return a robot's address without a path.

    Raises:
        FleetError: ``invalid_request``, or ``tls_needed`` for http to another machine.
    """
    parts = urlsplit(given if "://" in given else f"https://{given}")
    try:
        port = parts.port
    except ValueError:
        port = -1
    if parts.scheme not in ("http", "https") or not parts.hostname or port == -1 or parts.username:
        raise FleetError("invalid_request", why=f"{given[:80]!r} is not https://HOST[:PORT]")
    if parts.scheme == "http" and not is_loopback(parts.hostname):
        raise FleetError("tls_needed", name=given[:80])
    return f"{parts.scheme}://{parts.netloc}"


def is_loopback(host: str) -> bool:
    """Return whether a host is this machine."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def take_pin(url: str) -> Pin:
    """Look at a robot's certificate for the first time.

    Raises:
        FleetError: ``robot_silent``.
    """
    parts = urlsplit(url)
    if parts.scheme == "http":
        return Pin()
    host, port = parts.hostname or "", parts.port or 443
    try:
        leaf = ssl.get_server_certificate((host, port), timeout=TIMEOUT_S)
        authority = _fetch_authority(host, port)
        if authority is not None and _passes(authority, host, port):
            return _pin("authority", authority)
    except (OSError, http.client.HTTPException) as error:
        raise FleetError("robot_silent", f"{url}: {error}", name=url) from None
    return _pin("leaf", leaf)


def _pin(kind: PinKind, pem: str) -> Pin:
    return Pin(kind, hashlib.sha256(ssl.PEM_cert_to_DER_cert(pem)).hexdigest(), pem)


def _fetch_authority(host: str, port: int) -> str | None:
    """Return the certificate of the authority that a robot offers; nothing secret is sent."""
    blind = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    blind.check_hostname, blind.verify_mode = False, ssl.CERT_NONE
    connection = http.client.HTTPSConnection(host, port, timeout=TIMEOUT_S, context=blind)
    try:
        connection.request("GET", AUTHORITY_PATH)
        answer = connection.getresponse()
        text = answer.read(MAX_CERTIFICATE_BYTES).decode("ascii", "replace")
    finally:
        connection.close()
    if answer.status != http.HTTPStatus.OK or "BEGIN CERTIFICATE" not in text:
        return None
    try:
        return ssl.DER_cert_to_PEM_cert(ssl.PEM_cert_to_DER_cert(text.strip()))
    except ValueError:
        return None


def _passes(pem: str, host: str, port: int) -> bool:
    """Return whether the server at an address shows a certificate of this authority."""
    context = _trusting(pem, is_leaf=False)
    connection = http.client.HTTPSConnection(host, port, timeout=TIMEOUT_S, context=context)
    try:
        connection.connect()
    except ssl.SSLError:
        return False
    finally:
        connection.close()
    return True


def _trusting(pem: str, *, is_leaf: bool) -> ssl.SSLContext:
    made = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    made.minimum_version = ssl.TLSVersion.TLSv1_2
    made.load_verify_locations(cadata=pem)
    if is_leaf:  # it is trusted for itself, whatever it names and whoever signed it
        made.check_hostname = False
        made.verify_flags |= ssl.VERIFY_X509_PARTIAL_CHAIN
    return made
