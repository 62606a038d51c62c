"""Serve over TLS: take a certificate and its key, and bound how long a client may shake hands."""

from __future__ import annotations

import asyncio
import contextlib
import ssl
import stat
from typing import TYPE_CHECKING, Any

import uvloop

from wire import ConfigError

if TYPE_CHECKING:
    from pathlib import Path

HANDSHAKE_S = 5.0
"""A client that connects and stays silent holds a descriptor so long; the default is a minute."""
FAREWELL_S = 2.0
"""A client that does not answer the last record holds one so long; the default is half a minute."""
CIPHERS = "ECDHE+AESGCM:ECDHE+CHACHA20"
"""For TLS 1.2; TLS 1.3 has its own. All of them keep past talks secret when a key is stolen."""
MARK = "address"
"""A file in ``run/planner/``: scheme, host and port of this home's planner, so that the command
line asks it there and the same way (pons/settings.py)."""


class ServerLoop(uvloop.Loop):
    """Bound handshakes: the server library passes no limits of its own to the loop."""

    async def create_server(  # type: ignore[override]  # takes whatever the loop takes
        self, *given: Any, **named: Any
    ) -> asyncio.AbstractServer:
        """Listen as always; a TLS client must be quick."""
        if named.get("ssl") is not None:
            named.setdefault("ssl_handshake_timeout", HANDSHAKE_S)
            named.setdefault("ssl_shutdown_timeout", FAREWELL_S)
        return await super().create_server(*given, **named)


def context(certificate: Path | None, key: Path | None) -> ssl.SSLContext | None:
    """Return the TLS context of this certificate; None where none is given.

    Raises:
        ConfigError: half of the pair, an unreadable file, a key that others may read or that asks
            for a passphrase, or a key of another certificate.
    """
    if certificate is None and key is None:
        return None
    if certificate is None or key is None:
        given, missing = ("--tls-cert", "--tls-key") if key is None else ("--tls-key", "--tls-cert")
        raise ConfigError("tls_incomplete", f"{given} without {missing}; TLS needs both")
    for path in (certificate, key):
        _check_readable(path)
    _check_private(key)
    made = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    made.minimum_version = ssl.TLSVersion.TLSv1_2
    made.options |= ssl.OP_NO_RENEGOTIATION  # else a client may have keys agreed upon for ever
    made.set_ciphers(CIPHERS)
    try:
        made.load_cert_chain(certificate, key, password=_refuse_passphrase)
    except ssl.SSLError as error:
        if error.reason == "KEY_VALUES_MISMATCH":
            detail = f"{key} is not the key of the certificate in {certificate}"
            raise ConfigError("tls_mismatch", detail) from None
        detail = f"{certificate} and {key}: {error.reason or 'no PEM'}; expected PEM files"
        raise ConfigError("tls_malformed", detail) from None
    return made


def authority(path: Path | None) -> bytes:
    """Return the certificate of the authority, which devices fetch to trust it; empty for none.

    Raises:
        ConfigError: unreadable, or no certificate; a file with a private key is never given out.
    """
    if path is None:
        return b""
    _check_readable(path)
    data = path.read_bytes()
    if b"PRIVATE KEY" in data or b"-----BEGIN CERTIFICATE-----" not in data:
        detail = f"{path}: expected one certificate in PEM and nothing secret beside it"
        raise ConfigError("tls_malformed", detail)
    return data


def mark(home: Path, scheme: str, host: str, port: int) -> None:
    """Tell this machine's command line where the planner answers, unless the disk is full."""
    file = home / "run" / "planner" / MARK
    with contextlib.suppress(OSError):
        file.parent.mkdir(parents=True, exist_ok=True)
        new = file.with_suffix(".new")
        new.write_text(f"{scheme} {host} {port}\n", "ascii")
        new.chmod(0o644)
        new.replace(file)


def _check_readable(path: Path) -> None:
    try:
        with path.open("rb") as file:
            file.read(1)
    except OSError as error:
        raise ConfigError("tls_unreadable", f"{path}: {error.strerror}") from None


def _check_private(key: Path) -> None:
    mode = key.stat().st_mode
    if mode & stat.S_IRWXO:
        detail = f"{key} has mode {stat.S_IMODE(mode):04o}: all may use it; chmod 600 {key}"
        raise ConfigError("tls_key_open", detail)


def _refuse_passphrase() -> str:
    """Answer what OpenSSL would else ask a terminal, where a service has none."""
    raise ConfigError("tls_key_encrypted", "--tls-key asks for a passphrase; give it without one")
