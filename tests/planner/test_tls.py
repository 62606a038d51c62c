"""The planner serves TLS with a fitting pair alone, and no silent client holds a place for long."""

from __future__ import annotations

import asyncio
import os
import ssl
from datetime import UTC, datetime
from pathlib import Path

import pytest
from cryptography.hazmat.primitives import serialization

from planner import tls
from planner.__main__ import REFUSED, main
from pons.authority import issue
from wire import ConfigError


@pytest.fixture(scope="module")
def pems(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with two pairs, a key with a passphrase, and what is none of it."""
    folder = tmp_path_factory.mktemp("pems")
    for name in ("one", "two"):
        made = issue(folder / name, "carrier", (), ("localhost", "127.0.0.1"), datetime.now(UTC))
        (folder / f"{name}.pem").write_bytes(made.planner.read_bytes())
        (folder / f"{name}.pem").chmod(0o600)
    key = serialization.load_pem_private_key((folder / "one.pem").read_bytes(), None)
    pem, pkcs8 = serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8
    locked = key.private_bytes(pem, pkcs8, serialization.BestAvailableEncryption(b"secret"))
    (folder / "locked.pem").write_bytes(locked)
    (folder / "locked.pem").chmod(0o600)
    (folder / "noise.pem").write_text("noise")
    (folder / "noise.pem").chmod(0o600)
    return folder


@pytest.mark.parametrize(
    ("certificate", "key", "code"),
    [
        ("one.pem", None, "tls_incomplete"),
        (None, "one.pem", "tls_incomplete"),
        ("gone.pem", "one.pem", "tls_unreadable"),
        ("one.pem", "gone.pem", "tls_unreadable"),
        (".", "one.pem", "tls_unreadable"),
        ("one.pem", "two.pem", "tls_mismatch"),
        ("one.pem", "noise.pem", "tls_malformed"),
        ("noise.pem", "one.pem", "tls_malformed"),
        ("one.pem", "locked.pem", "tls_key_encrypted"),
    ],
)
def test_a_pair_that_does_not_fit_is_refused_in_one_line(
    pems: Path, capsys: pytest.CaptureFixture[str], certificate: str, key: str, code: str
) -> None:
    words = ["--home", str(pems), "--robot", "robot.toml", "--site", "nowhere"]
    words += ["--tls-cert", str(pems / certificate)] if certificate else []
    words += ["--tls-key", str(pems / key)] if key else []
    assert main(words) == REFUSED
    said = capsys.readouterr().err
    assert said.startswith(f"planner: {code}: ")
    assert said.count("\n") == 1


def test_a_key_that_all_may_read_is_refused(pems: Path, tmp_path: Path) -> None:
    key = tmp_path / "open.pem"
    key.write_bytes((pems / "one.pem").read_bytes())
    key.chmod(0o604)
    with pytest.raises(ConfigError) as refused:
        tls.context(key, key)
    assert refused.value.code == "tls_key_open"
    key.chmod(0o640)  # a group of its own, as distributions have it
    assert tls.context(key, key) is not None


def test_without_a_pair_there_is_no_tls() -> None:
    assert tls.context(None, None) is None


def test_a_private_key_is_never_given_out_as_the_authority(pems: Path) -> None:
    for name in ("one.pem", "noise.pem"):
        with pytest.raises(ConfigError) as refused:
            tls.authority(pems / name)
        assert refused.value.code == "tls_malformed"
    public = pems / "one" / "tls" / "ca.crt"
    assert tls.authority(public) == public.read_bytes()
    assert tls.authority(None) == b""


def test_the_mark_says_where_and_how_this_homes_planner_speaks(tmp_path: Path) -> None:
    for scheme, port in (("https", 8420), ("http", 8460)):
        tls.mark(tmp_path, scheme, "127.0.0.1", port)
        file = tmp_path / "run" / "planner" / tls.MARK
        assert file.read_text("ascii") == f"{scheme} 127.0.0.1 {port}\n"
        assert file.stat().st_mode & 0o777 == 0o644, "whoever may enter the folder may ask there"


def test_a_home_that_cannot_be_written_keeps_no_planner_from_starting(tmp_path: Path) -> None:
    (tmp_path / "home").write_text("a file")
    tls.mark(tmp_path / "home", "https", "127.0.0.1", 8420)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="a POSIX loop")
def test_a_client_that_never_shakes_hands_is_let_go(
    pems: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tls, "HANDSHAKE_S", 0.2)
    context = tls.context(pems / "one.pem", pems / "one.pem")

    async def silent() -> bytes:
        loop = asyncio.get_running_loop()
        server = await loop.create_server(asyncio.Protocol, "127.0.0.1", 0, ssl=context)
        reader, writer = await asyncio.open_connection(*server.sockets[0].getsockname())
        try:
            return await reader.read()  # ends when the server closes
        finally:
            writer.close()
            server.close()

    with asyncio.Runner(loop_factory=tls.ServerLoop) as runner:
        assert runner.run(silent()) == b""


def test_old_protocols_and_weak_ciphers_are_not_spoken(pems: Path) -> None:
    context = tls.context(pems / "one.pem", pems / "one.pem")
    assert context is not None
    assert context.minimum_version == ssl.TLSVersion.TLSv1_2
    assert context.options & ssl.OP_NO_RENEGOTIATION
    assert all("GCM" in c["name"] or "CHACHA20" in c["name"] for c in context.get_ciphers())
