"""Run the fleet's service, on the loopback or over TLS: one process a file, or more on Postgres."""

from __future__ import annotations

import fcntl
import os
import sys
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

import uvicorn

from fleet.access import LOOPBACK_NAMES, FleetAccess
from fleet.api import build_app
from fleet.carrier import CarrierLock
from fleet.desk import Desk
from fleet.pin import is_loopback
from fleet.store import FleetStore
from wire import ConfigError

if TYPE_CHECKING:
    from collections.abc import Mapping

DEFAULT_PORT = 8440


def database_url(home: Path, environment: Mapping[str, str]) -> str:
    """Return where the fleet keeps its rows: ``PONS_FLEET_DB``, else a file in its folder.

    Raises:
        ConfigError: another kind of database.
    """
    given = environment.get("PONS_FLEET_DB", "").strip()
    if not given:
        return f"sqlite:///{home / 'fleet.sqlite'}"
    if not given.startswith(("postgresql://", "postgres://", "sqlite:///")):
        detail = "PONS_FLEET_DB is no postgresql:// URL; leave it out for an SQLite file"
        raise ConfigError("fleet_db_unknown", detail)
    return given.replace("postgres://", "postgresql://", 1)


def own_home(home: Path) -> Path:
    """Return the fleet's folder, made for its owner alone."""
    folder = home / "fleet"
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    return folder


def serve(
    home: Path,
    host: str,
    port: int,
    environment: Mapping[str, str],
    certificate: Path | None = None,
    key: Path | None = None,
) -> None:
    """Serve until a signal comes.

    Raises:
        ConfigError: the address is open to others without TLS or a token, or it runs already.
    """  # fmt: skip
    # Else httpcore 1 seeks it on the disk with each request, a fifth of the loop's time.
    sys.modules.setdefault("sniffio", None)  # type: ignore[arg-type]
    folder = own_home(home)
    token = environment.get("PONS_FLEET_TOKEN", "")
    if not is_loopback(host) and not (token and certificate and key):
        detail = f"{host} can be reached from outside; set PONS_FLEET_TOKEN and give --tls-cert"
        raise ConfigError("tls_needed", f"{detail} and --tls-key, or listen at 127.0.0.1")
    url = database_url(folder, environment)
    # Services on one Postgres may share a folder, which holds the tokens; a file has one service.
    held = _lock_folder(folder / "up.lock") if url.startswith("sqlite") else nullcontext()
    with held:
        store = FleetStore(url)
        lock = CarrierLock(store.engine)
        names = {name for name in environment.get("PONS_ALLOWED_HOSTS", "").split(",") if name}
        access = FleetAccess(
            frozenset({*LOOPBACK_NAMES, host, *names} - {"0.0.0.0", "::"}), token,
            environment.get("PONS_FLEET_VIEWER_TOKEN", ""), certificate is not None,
        )  # fmt: skip
        app = build_app(Desk(store, folder), access, url, lock)
        try:
            uvicorn.run(
                app, host=host, port=port, log_level="warning", access_log=False,
                server_header=False, timeout_graceful_shutdown=2, limit_concurrency=256,
                ssl_certfile=certificate, ssl_keyfile=key,
            )  # fmt: skip
        finally:
            lock.close()
            store.close()


def _lock_folder(file: Path) -> TextIO:
    """Return the lock of a folder, held until it is closed.

    Raises:
        ConfigError: ``already_running``.
    """
    opened = file.open("a+")
    try:
        fcntl.flock(opened, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        opened.seek(0)
        holder = opened.read().strip() or "unknown"
        opened.close()
        raise ConfigError("already_running", f"pid {holder} serves {file.parent}") from None
    opened.truncate(0)
    opened.write(str(os.getpid()))
    opened.flush()
    return opened
