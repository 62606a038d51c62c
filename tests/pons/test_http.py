"""The command line speaks to the planner over TLS, and only to the one that it can trust."""

from __future__ import annotations

import http.server
import ssl
import threading
from collections.abc import Iterator
from dataclasses import replace
from datetime import UTC, datetime
from functools import partial
from pathlib import Path

import pytest

from planner.tls import MARK, mark
from pons import operator, places
from pons.authority import issue
from pons.http import AUTHORITY, PlannerDown, call
from pons.settings import PLANNER_MARK, BadSetting, LaunchSettings, load


class Answers(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def do_GET(self) -> None:
        body = b'{"secure": true}'
        self.send_response(200)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_request(self, code: object = "-", size: object = "-") -> None:
        """Say nothing."""


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("home")
    issue(folder, "carrier", (), ("localhost", "127.0.0.1"), datetime.now(UTC))
    return folder


@pytest.fixture(scope="module")
def planner(home: Path) -> Iterator[LaunchSettings]:
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(home / "tls" / "planner.pem")
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Answers)
    server.handle_error = lambda *_: None  # type: ignore[method-assign]
    server.socket = context.wrap_socket(server.socket, server_side=True)
    thread = threading.Thread(target=server.serve_forever, args=(0.01,))
    thread.start()
    yield LaunchSettings(home, home, home, "127.0.0.1", server.server_address[1], tls=True)
    server.shutdown()
    thread.join()
    server.server_close()


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "0.0.0.0"])
def test_the_homes_own_authority_is_trusted(planner: LaunchSettings, host: str) -> None:
    assert call(replace(planner, host=host), "GET", "/") == {"secure": True}


def test_a_copy_of_the_authority_serves_elsewhere(planner: LaunchSettings, tmp_path: Path) -> None:
    copy = tmp_path / "ca.crt"
    copy.write_bytes((planner.home / AUTHORITY).read_bytes())
    assert call(replace(planner, home=tmp_path, authority=copy), "GET", "/") == {"secure": True}


def test_an_authority_that_is_not_known_is_not_trusted(
    planner: LaunchSettings, tmp_path: Path
) -> None:
    with pytest.raises(PlannerDown, match=r"not trusted.*PONS_CA"):
        call(replace(planner, home=tmp_path), "GET", "/")
    issue(tmp_path, "carrier", (), ("localhost",), datetime.now(UTC))
    with pytest.raises(PlannerDown, match=r"not trusted.*PONS_CA"):
        call(replace(planner, home=tmp_path), "GET", "/")


def test_a_file_that_is_no_authority_is_named(planner: LaunchSettings, tmp_path: Path) -> None:
    for wrong in (tmp_path / "gone.crt", tmp_path / "noise.crt"):
        (tmp_path / "noise.crt").write_text("noise")
        with pytest.raises(PlannerDown, match=wrong.name):
            call(replace(planner, authority=wrong), "GET", "/")


def test_nothing_is_said_in_clear_to_a_planner_that_speaks_tls(planner: LaunchSettings) -> None:
    with pytest.raises(PlannerDown):
        call(replace(planner, tls=False), "GET", "/")


def test_settings_follow_the_environment_and_then_the_planner(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert Path("run", "planner", MARK) == PLANNER_MARK
    monkeypatch.setenv("PONS_HOME", str(tmp_path))
    assert load().url == "http://127.0.0.1:8420"
    mark(tmp_path, "https", "0.0.0.0", 8460)
    assert (load().tls, load().url) == (True, "https://127.0.0.1:8460")
    assert load(starts=True).url == "http://127.0.0.1:8420", "not where the last one answered"
    for wrong in ("", "ftp r 1\n", "http r\n", "http r 0\n", "http r x\n", "é", "http r 1 2"):
        (tmp_path / PLANNER_MARK).write_text(wrong, "utf-8")
        assert load().url == "http://127.0.0.1:8420"
    mark(tmp_path, "https", "127.0.0.1", 8460)
    monkeypatch.setenv("PONS_PORT", "8461")
    assert load().url == "https://127.0.0.1:8461"
    monkeypatch.setenv("PONS_TLS", "0")
    assert not load().tls
    monkeypatch.setenv("PONS_TLS", "yes")
    with pytest.raises(BadSetting, match="bad_tls"):
        load()


@pytest.mark.parametrize(
    ("host", "url"),
    [("0.0.0.0", "http://127.0.0.1:1"), ("::", "http://[::1]:1"), ("r.local", "http://r.local:1")],
)
def test_a_planner_that_listens_everywhere_is_asked_here(
    tmp_path: Path, host: str, url: str
) -> None:
    assert LaunchSettings(tmp_path, tmp_path, tmp_path, host, 1).url == url


def test_where_nothing_answers_a_person_is_told_what_to_look_at_in_both_languages(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    nobody = LaunchSettings(tmp_path, tmp_path, tmp_path, "127.0.0.1", 9)
    asked = (
        partial(operator.status, nobody, as_json=False),
        partial(places.run, nobody, "list", None),
    )
    for ask in asked:
        assert ask() != 0
        [english] = capsys.readouterr().err.splitlines()
        assert english.startswith("planner_down: http://127.0.0.1:9/v1/")
        assert english.endswith(". Is `pons up` running?")
        with monkeypatch.context() as patched:
            patched.setenv("LC_ALL", "zh_CN.UTF-8")
            ask()
        assert capsys.readouterr().err.endswith(". 没有应答：`pons up` 是否在运行？\n")
