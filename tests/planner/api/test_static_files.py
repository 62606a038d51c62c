"""The built page is served from memory, its hashed files for good; where missing, / says so."""

from __future__ import annotations

import gzip
from collections.abc import Iterator
from pathlib import Path

import pytest
from starlette.testclient import TestClient

from planner.api import Access, build
from pons_assets.built_page import MAX_PAGE_BYTES, load_page
from tests.planner.api.fakes import FakeServices

BASE = "http://127.0.0.1:8420"
TOKEN = "a token of many characters"
SCRIPT = b"console.log('pons')\n" * 100


def built(where: Path) -> Path:
    dist = where / "dist"
    (dist / "assets").mkdir(parents=True)
    (dist / "index.html").write_text("<!doctype html><title>Pons</title>")
    (dist / "assets" / "index-abc123.js").write_bytes(SCRIPT)
    (dist / "assets" / "notes.txt").write_text("no page")
    return dist


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return built(tmp_path)


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    app = build(FakeServices(), Access("127.0.0.1"), page=built(tmp_path_factory.mktemp("page")))
    with TestClient(app, base_url=BASE) as made:
        yield made


def test_the_page_is_asked_for_anew_and_its_files_never_again(client: TestClient) -> None:
    page = client.get("/")
    assert page.headers["content-type"] == "text/html; charset=utf-8"
    assert page.headers["cache-control"] == "no-cache"
    script = client.get("/assets/index-abc123.js")
    assert script.content == SCRIPT
    assert script.headers["content-type"].startswith("text/javascript")
    assert "immutable" in script.headers["cache-control"]


def test_every_answer_carries_a_strict_policy(client: TestClient) -> None:
    for path in ("/", "/assets/index-abc123.js", "/assets/none.js"):
        policy = client.get(path).headers["content-security-policy"]
        assert "default-src 'none'" in policy
        assert "script-src 'self';" in policy
        assert "unsafe" not in policy
        assert "http" not in policy
        assert "*" not in policy


def test_the_authoritys_certificate_is_given_out_where_there_is_one(client: TestClient) -> None:
    assert client.get("/ca.crt").json()["code"] == "unknown_route"
    pem = b"-----BEGIN CERTIFICATE-----"
    app = build(FakeServices(), Access("127.0.0.1"), authority=pem)
    with TestClient(app, base_url=BASE) as other:
        answer = other.get("/ca.crt")
    assert answer.content == pem
    assert answer.headers["content-type"] == "application/x-x509-ca-cert"


def test_files_are_squeezed_for_who_takes_it(client: TestClient) -> None:
    plain = client.get("/assets/index-abc123.js", headers={"accept-encoding": "identity"})
    assert "content-encoding" not in plain.headers
    with client.stream(
        "GET", "/assets/index-abc123.js", headers={"accept-encoding": "gzip"}
    ) as answer:
        assert answer.headers["content-encoding"] == "gzip"
        assert gzip.decompress(b"".join(answer.iter_raw())) == SCRIPT


def test_what_a_browser_has_is_not_sent_again(client: TestClient) -> None:
    etag = client.get("/").headers["etag"]
    again = client.get("/", headers={"if-none-match": f'W/"x", {etag}'})
    assert (again.status_code, again.content) == (304, b"")
    assert client.get("/", headers={"if-none-match": '"other"'}).status_code == 200


@pytest.mark.parametrize(
    "path",
    [
        "/assets/none.js",
        "/assets/notes.txt",
        "/assets/../index.html",
        "/assets/..%2f..%2fpyproject.toml",
        "/assets/%2e%2e/%2e%2e/pyproject.toml",
        "/index.html",
    ],
)
def test_only_what_the_build_made_is_there(client: TestClient, path: str) -> None:
    answer = client.get(path)
    assert answer.status_code == 404
    assert answer.json()["code"] == "unknown_route"


def test_a_page_that_is_not_built_says_so_and_how_to_build_it(tmp_path: Path) -> None:
    app = build(FakeServices(), Access("127.0.0.1"), page=tmp_path)
    with TestClient(app, base_url=BASE) as client:
        answer = client.get("/")
    assert answer.status_code == 200
    assert "not built" in answer.text
    assert "尚未构建" in answer.text
    assert "make page" in answer.text


def test_links_and_what_is_too_much_are_left_out(folder: Path, tmp_path: Path) -> None:
    secret = tmp_path / "secret.js"
    secret.write_text("key")
    (folder / "assets" / "link.js").symlink_to(secret)
    (folder / "assets" / "zz.js").write_bytes(b"x" * (MAX_PAGE_BYTES + 1))
    assert sorted(load_page(folder)) == ["assets/index-abc123.js", "index.html"]


def test_the_page_needs_no_token_and_what_it_asks_for_does(folder: Path) -> None:
    access = Access("0.0.0.0", hosts=frozenset({"127.0.0.1"}), operator_token=TOKEN)
    app = build(FakeServices(), access, page=folder)
    with TestClient(app, base_url=BASE) as client:
        assert client.get("/").status_code == 200
        assert client.get("/assets/index-abc123.js").status_code == 200
        assert client.get("/v1/robot").status_code == 401
        assert client.get("/", headers={"host": "elsewhere.example"}).status_code == 403
