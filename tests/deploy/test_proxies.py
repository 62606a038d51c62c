"""The proxies of docs/tls.md, as they stand there, before a served API: host, sockets, limits."""

from __future__ import annotations

import asyncio
import json
import re
import shutil
import socket
import ssl
import subprocess
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from http.client import HTTPSConnection
from pathlib import Path

import pytest
import uvicorn
from websockets.asyncio.client import connect
from websockets.exceptions import InvalidStatus
from websockets.typing import Origin

from planner.api import Access, build
from planner.voice import MAX_BYTES
from pons.authority import issue
from pons.robot_processes import free_port
from tests.e2e.polling import until
from tests.planner.api.fakes import FakeServices

NAME = "robot.local"
TOKEN = "a-token-behind-a-proxy"
BEARER = {"Authorization": f"Bearer {TOKEN}"}
JSON = {"Content-Type": "application/json"}


@contextmanager
def served(services: FakeServices) -> Iterator[int]:
    """Serve the API on the loopback, as the planner does behind a proxy: with a token."""
    access = Access("127.0.0.1", hosts=frozenset({NAME}), operator_token=TOKEN)
    port = free_port()
    config = uvicorn.Config(build(services, access), port=port, log_config=None, ws_max_size=4_096)
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run)
    thread.start()
    try:
        until(lambda: server.started, 20.0, "the API being served")
        yield port
    finally:
        server.should_exit = True
        thread.join()


def recipe(repository: Path, language: str) -> str:
    page = (repository / "docs" / "tls.md").read_text("utf-8")
    found = re.findall(rf"^```{language}\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    assert len(found) == 1
    return str(found[0])


def below_a_path(text: str, there: str, path_recipe: str) -> str:
    """Return a recipe whose part from ``there`` to the end of its server is the one for a path."""
    begin, end = text.index(there), text.rindex("}")
    inner = "".join(f"    {line}\n" for line in path_recipe.splitlines())
    return text[:begin] + inner.lstrip() + text[end:]


def moved(text: str, home: Path, planner: int, port: int) -> str:
    """Return a recipe with this test's own ports, name and certificate; all else as it stands."""
    pair = home / "tls" / "planner.pem"
    for there, here, times in (
        ("127.0.0.1:8420", f"127.0.0.1:{planner}", None),
        ("/etc/ssl/pons/fullchain.pem", str(pair), 1),
        ("/etc/ssl/pons/privkey.pem", str(pair), 1),
    ):
        assert text.count(there) >= 1 if times is None else text.count(there) == times
        text = text.replace(there, here)
    return text.replace("listen 443", f"listen 127.0.0.1:{port}").replace("robot.example", NAME)


def nginx(repository: Path, home: Path, planner: int, port: int, path: str) -> list[str]:
    text = recipe(repository, "nginx")
    if path:
        text = below_a_path(text, "location /", recipe(repository, "nginx below"))
    inner = moved(text, home, planner, port)
    places = "".join(
        f"{kind}_temp_path {home}/{kind};\n"
        for kind in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi")
    )
    whole = f"daemon off; pid {home}/nginx.pid; error_log {home}/error.log;\nevents {{}}\n"
    whole += f"http {{ access_log off;\n{places}{inner}\n}}\n"
    file = home / "nginx.conf"
    file.write_text(whole)
    return ["nginx", "-p", str(home), "-e", str(home / "error.log"), "-c", str(file)]


def caddy(repository: Path, home: Path, planner: int, port: int, path: str) -> list[str]:
    text = recipe(repository, "caddyfile")
    if path:
        text = below_a_path(text, "reverse_proxy", recipe(repository, "caddyfile below"))
    text = moved(text, home, planner, port)
    ours = f"{{\n    admin off\n    auto_https disable_redirects\n    https_port {port}\n"
    text = text.replace("{\n", ours, 1).replace(f"\n{NAME} {{", f"\n{NAME} {{\n    bind 127.0.0.1")
    file = home / "Caddyfile"
    file.write_text(text)
    return ["caddy", "run", "--config", str(file), "--adapter", "caddyfile"]


@dataclass
class Proxied:
    """Ask through a proxy as a browser would."""

    name: str
    port: int
    trusted: ssl.SSLContext
    services: FakeServices
    below: str
    """The path below which the robot lies; empty: it has the whole name."""

    def ask(
        self, method: str, path: str, headers: dict[str, str] | None = None, body: bytes = b""
    ) -> tuple[int, dict[str, str], bytes]:
        """Send one request by the robot's name, whatever address that has."""
        connection = HTTPSConnection("127.0.0.1", self.port, timeout=10.0)
        raw = socket.create_connection(("127.0.0.1", self.port), timeout=10.0)
        connection.sock = self.trusted.wrap_socket(raw, server_hostname=NAME)
        try:
            connection.request(
                method, self.below + path, body or None, {"Host": NAME, **(headers or {})}
            )
            answer = connection.getresponse()
            told = {key.lower(): value for key, value in answer.getheaders()}
            return answer.status, told, answer.read()
        finally:
            connection.close()

    def events(self, headers: dict[str, str]) -> connect:
        """Open the page's socket.

        On one thread: before CPython 3.13 one that reads while another writes ends a TLS 1.3
        connection now and then, for the server's session tickets come just after the handshake.
        """
        return connect(
            f"wss://{NAME}{self.below}/v1/events",
            host="127.0.0.1",
            port=self.port,
            proxy=None,
            ssl=self.trusted,
            server_hostname=NAME,
            origin=Origin(f"https://{NAME}"),
            additional_headers=headers,
            open_timeout=10.0,
        )


PROXIES: dict[str, Callable[[Path, Path, int, int, str], list[str]]] = {
    "nginx": nginx,
    "caddy": caddy,
}


@pytest.fixture(
    scope="module", params=[(name, below) for name in PROXIES for below in ("", "/robot")]
)
def proxied(
    request: pytest.FixtureRequest, repository: Path, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Proxied]:
    name, below = request.param
    if shutil.which(name) is None:
        pytest.skip(f"no {name} here; docs/tls.md has its recipe")
    home = tmp_path_factory.mktemp(name)
    made = issue(home, "robot", [NAME], [], datetime.now(UTC))
    services, port = FakeServices(), free_port()
    with ExitStack() as stack:
        planner = stack.enter_context(served(services))
        log = stack.enter_context((home / "proxy.log").open("wb"))
        command = PROXIES[name](repository, home, planner, port, below)
        environment = {"HOME": str(home), "PATH": "/usr/sbin:/usr/bin:/sbin:/bin"}
        process = subprocess.Popen(command, stdout=log, stderr=log, env=environment, cwd=home)
        try:
            until(
                lambda: listens(port) or process.poll() is not None,
                20.0,
                f"{name} listening",
                (home / "proxy.log").read_text,
            )
            assert process.poll() is None, (home / "proxy.log").read_text()
            trusted = ssl.create_default_context(cafile=str(made.authority))
            yield Proxied(name, port, trusted, services, below)
        finally:
            process.terminate()
            process.wait(10.0)


def listens(port: int) -> bool:
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


def test_the_page_comes_and_an_order_needs_the_token(proxied: Proxied) -> None:
    status, _, page = proxied.ask("GET", "/")
    assert status == 200
    assert not re.search(rb'(href|src)="/', page), "what the page names lies beside it"
    own = {"Origin": f"https://{NAME}"}
    order = json.dumps({"text": "go"}).encode()
    status, _, body = proxied.ask("POST", "/v1/goals", JSON, order)
    assert (status, json.loads(body)["code"]) == (401, "token_needed")
    status, _, body = proxied.ask("POST", "/v1/goals", own | JSON | BEARER, order)
    assert status == 202, body


def test_the_planner_judges_the_host_that_the_browser_sent(proxied: Proxied) -> None:
    status, _, body = proxied.ask("GET", "/v1/robot", BEARER | {"Host": "evil.example"})
    if proxied.name == "caddy":  # it has no site of that name, and answers emptily itself
        assert body == b""
    else:
        assert (status, json.loads(body)["code"]) == (403, "foreign_host")
    status, _, body = proxied.ask("GET", "/v1/robot", BEARER | {"Origin": "https://evil.example"})
    assert (status, json.loads(body)["code"]) == (403, "foreign_origin")


def test_the_socket_is_upgraded_and_frames_come_at_once(proxied: Proxied) -> None:
    stops = proxied.services.goals.stops
    before = len(stops)

    async def stop() -> None:
        async with proxied.events(BEARER) as events:
            assert json.loads(await asyncio.wait_for(events.recv(), 10.0))
            await events.send(json.dumps({"stop": True}))
            async with asyncio.timeout(10.0):
                while json.loads(await events.recv()).get("kind") != "stopped":
                    pass
        with pytest.raises(InvalidStatus):
            await proxied.events({})

    asyncio.run(stop())
    assert len(stops) == before + 1


def test_a_stop_goes_through_with_nothing_but_the_token(proxied: Proxied) -> None:
    before = len(proxied.services.goals.stops)
    status, _, body = proxied.ask("POST", "/v1/stop", BEARER)
    assert status == 200, body
    assert len(proxied.services.goals.stops) == before + 1


def test_a_body_past_what_any_route_takes_ends_at_the_proxy(proxied: Proxied) -> None:
    sound = {"Content-Type": "audio/wav"} | BEARER
    status, _, _ = proxied.ask("POST", "/v1/voice", sound, b"\0" * (MAX_BYTES - 100))
    assert status != 413
    try:
        status, _, _ = proxied.ask("POST", "/v1/voice", sound, b"\0" * 5_000_000)
    except OSError:  # it hung up while more was coming
        return
    assert status == {"nginx": 413, "caddy": 502}[proxied.name]


def test_more_connections_than_a_person_opens_take_no_stop_away(proxied: Proxied) -> None:
    if proxied.name != "nginx":
        pytest.skip("Caddy caps no connections")
    head = f"POST {proxied.below}/v1/voice HTTP/1.1\r\n"
    head = f"{head}Host: {NAME}\r\nAuthorization: Bearer {TOKEN}\r\n"
    unfinished = f"{head}Content-Type: audio/wav\r\nContent-Length: 1000\r\n\r\n".encode()
    with ExitStack() as stack:
        for _ in range(60):
            raw = socket.create_connection(("127.0.0.1", proxied.port), timeout=10.0)
            secure = proxied.trusted.wrap_socket(raw, server_hostname=NAME)
            stack.enter_context(secure).sendall(unfinished)
        assert proxied.ask("GET", "/v1/places", BEARER)[0] == 503
        assert proxied.ask("POST", "/v1/stop", BEARER)[0] == 200
