"""Know a robot by its certificate: its own authority's, and no other's."""

from __future__ import annotations

import asyncio
import ssl
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path

import pytest

from fleet.errors import FleetError
from fleet.link import FleetLink, RobotRefusal
from fleet.pin import Pin, clean_url, take_pin
from pons.authority import issue
from tests.fleet.robot_stub import make_server


@contextmanager
def tls_robot(folder: Path, name: str, *, gives_authority: bool = False) -> Iterator[str]:
    """Serve a robot over TLS, with an authority of its own; yield its URL."""
    home = folder / name
    home.mkdir()
    made = issue(home, "robot", {"127.0.0.1"}, {"localhost"}, datetime.now(UTC))
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(made.planner)
    authority = made.authority.read_bytes() if gives_authority else b""
    server = make_server(home, name, 0, context, authority)
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.05})
    thread.start()
    try:
        yield f"https://127.0.0.1:{server.server_address[1]}"
    finally:
        server.shutdown()
        thread.join()
        server.server_close()


def card_of(url: str, pin: Pin) -> str:
    async def ask() -> str:
        link = FleetLink("r1", url, "r1", pin, "token")
        try:
            return str((await link.prove())["robot_id"])
        finally:
            await link.close()

    return asyncio.run(ask())


@pytest.mark.parametrize(("gives_authority", "kind"), [(False, "leaf"), (True, "authority")])
def test_a_certificate_is_pinned_and_another_robots_is_refused(
    tmp_path: Path, *, gives_authority: bool, kind: str
) -> None:
    with (
        tls_robot(tmp_path, "r1", gives_authority=gives_authority) as url,
        tls_robot(tmp_path, "r2", gives_authority=gives_authority) as other,
    ):
        pin = take_pin(url)
        assert pin.kind == kind
        assert card_of(url, pin) == "r1"
        with pytest.raises(RobotRefusal) as refused:
            card_of(other, pin)
        assert refused.value.code == "pin_mismatch"


@pytest.mark.parametrize(
    ("given", "code"),
    [
        ("http://r3.local", "tls_needed"),
        ("ftp://r3.local", "invalid_request"),
        ("https://", "invalid_request"),
        ("https://a:b@r3.local", "invalid_request"),
        ("https://r3.local:99999", "invalid_request"),
    ],
)
def test_an_address_that_can_not_be_trusted_is_refused(given: str, code: str) -> None:
    with pytest.raises(FleetError) as refused:
        clean_url(given)
    assert refused.value.code == code


def test_an_address_is_kept_without_its_path() -> None:
    assert clean_url("r3.local:8420/page") == "https://r3.local:8420"
    assert clean_url("http://127.0.0.1:8420/") == "http://127.0.0.1:8420"
