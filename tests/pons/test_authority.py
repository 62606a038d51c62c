"""A robot's own authority signs for its own names, keeps its key, and renews in time."""

from __future__ import annotations

import os
import shutil
import ssl
import stat
import subprocess
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from cryptography import x509

from pons.authority import AUTHORITY_LIFE, CERTIFICATE_LIFE, RENEW_BEFORE, IssuedCertificate, issue
from wire import ConfigError

NOW = datetime(2026, 11, 23, 12, tzinfo=UTC)
FOUND = ("localhost", "127.0.0.1", "::1", "carrier", "carrier.local", "192.168.1.7", "fd00::2")


def issued(
    home: Path, *asked: str, now: datetime = NOW, machine: str = "carrier"
) -> IssuedCertificate:
    return issue(home, machine, asked, FOUND, now)


def refused(home: Path, *asked: str, now: datetime = NOW) -> str:
    with pytest.raises(ConfigError) as why:
        issued(home, *asked, now=now)
    return why.value.code


def certificate(file: Path) -> x509.Certificate:
    return x509.load_pem_x509_certificate(file.read_bytes())


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


def test_its_folder_and_keys_are_the_owners_alone(tmp_path: Path) -> None:
    was = os.umask(0)
    try:
        made = issued(tmp_path)
    finally:
        os.umask(was)
    assert mode(tmp_path / "tls") == 0o700
    assert mode(tmp_path / "tls" / "ca.key") == mode(made.planner) == 0o600
    assert b"PRIVATE" not in made.authority.read_bytes()
    assert made.made == ("ca.crt", "planner.pem")


@pytest.mark.skipif(shutil.which("openssl") is None, reason="no openssl here")
def test_the_certificate_carries_every_name_and_is_believed_by_openssl(tmp_path: Path) -> None:
    made = issued(tmp_path, "robot.local", "10.1.2.3")
    assert set(made.names) == {*FOUND, "robot.local", "10.1.2.3"}
    for name in ("carrier.local", "192.168.1.7", "::1"):
        which = "-verify_ip" if name[0] in "1:" else "-verify_hostname"
        command = ["openssl", "verify", "-x509_strict", "-purpose", "sslserver"]
        command += ["-CAfile", str(made.authority), which, name, str(made.planner)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, (done.stdout, done.stderr)


def test_phones_take_its_length_and_kind(tmp_path: Path) -> None:
    made = issued(tmp_path)
    leaf, root = certificate(made.planner), certificate(made.authority)
    assert leaf.not_valid_after_utc - leaf.not_valid_before_utc <= timedelta(days=398)
    assert root.not_valid_after_utc - NOW == AUTHORITY_LIFE
    used = leaf.extensions.get_extension_for_class(x509.ExtendedKeyUsage).value
    assert [usage.dotted_string for usage in used] == ["1.3.6.1.5.5.7.3.1"]
    basic = root.extensions.get_extension_for_class(x509.BasicConstraints)
    assert (basic.critical, basic.value.ca, basic.value.path_length) == (True, True, 0)


def test_a_stolen_authority_signs_for_no_bank(tmp_path: Path) -> None:
    issued(tmp_path)
    for name in (
        "bank.example",
        "example.local.com",
        "8.8.8.8",
        "2001:4860:4860::8888",
        "notlocal",
    ):
        assert refused(tmp_path, name) == "tls_name_outside", name
    root = certificate(tmp_path / "tls" / "ca.crt")
    limits = root.extensions.get_extension_for_class(x509.NameConstraints)
    assert limits.critical
    names = [subtree.value for subtree in limits.value.permitted_subtrees or []]
    assert "carrier" in names
    assert "" not in names


def test_names_that_the_owner_asks_for_at_its_making_are_its_own(tmp_path: Path) -> None:
    assert "robot.example" in issued(tmp_path, "robot.example", "203.0.113.9").names
    assert refused(tmp_path, "other.example") == "tls_name_outside"
    assert refused(tmp_path, "203.0.113.8") == "tls_name_outside"


def test_found_names_outside_are_left_out(tmp_path: Path) -> None:
    issued(tmp_path)
    made = issue(tmp_path, "renamed", (), ("localhost", "renamed", "renamed.local", "8.8.8.8"), NOW)
    assert made.names == ("localhost", "renamed.local")


def test_what_lasts_is_kept_as_it_is(tmp_path: Path) -> None:
    first = issued(tmp_path)
    before = first.planner.read_bytes()
    again = issued(tmp_path, now=NOW + CERTIFICATE_LIFE - RENEW_BEFORE - timedelta(seconds=1))
    assert (again.made, again.planner.read_bytes()) == ((), before)
    assert again.fingerprint == first.fingerprint


def test_a_certificate_that_ends_within_a_month_is_renewed_by_the_same_authority(
    tmp_path: Path,
) -> None:
    first = issued(tmp_path)
    again = issued(tmp_path, now=NOW + CERTIFICATE_LIFE - RENEW_BEFORE + timedelta(seconds=1))
    assert again.made == ("planner.pem",)
    assert again.fingerprint == first.fingerprint
    assert again.ends > first.ends


def test_changed_names_renew_it(tmp_path: Path) -> None:
    issued(tmp_path)
    again = issued(tmp_path, "10.1.2.3")
    assert (again.made, "10.1.2.3" in again.names) == (("planner.pem",), True)
    assert issued(tmp_path).made == ("planner.pem",)


def test_no_certificate_outlives_the_authority_and_an_old_one_is_replaced(tmp_path: Path) -> None:
    first = issued(tmp_path)
    late = issued(tmp_path, now=NOW + AUTHORITY_LIFE - timedelta(days=60))
    root_ends = certificate(first.authority).not_valid_after_utc
    assert late.ends == root_ends
    new = issued(tmp_path, now=root_ends - timedelta(days=29))
    assert new.made == ("ca.crt", "planner.pem")
    assert new.fingerprint != first.fingerprint


def test_a_clock_before_the_authority_is_refused(tmp_path: Path) -> None:
    issued(tmp_path)
    assert refused(tmp_path, now=datetime(1970, 1, 1, tzinfo=UTC)) == "clock_before_authority"


@pytest.mark.parametrize(("file", "bits"), [("ca.key", 0o640), ("planner.pem", 0o604),
                                            ("ca.crt", 0o666)])  # fmt: skip
def test_files_that_others_could_have_used_are_refused(
    tmp_path: Path, file: str, bits: int
) -> None:
    issued(tmp_path)
    (tmp_path / "tls" / file).chmod(bits)
    assert refused(tmp_path, "10.1.2.3") == "tls_key_open"


def test_an_open_folder_and_links_are_refused(tmp_path: Path) -> None:
    issued(tmp_path)
    (tmp_path / "tls").chmod(0o750)
    assert refused(tmp_path) == "tls_folder_open"
    (tmp_path / "tls").chmod(0o700)
    (tmp_path / "tls" / "ca.key").rename(tmp_path / "elsewhere")
    (tmp_path / "tls" / "ca.key").symlink_to(tmp_path / "elsewhere")
    assert refused(tmp_path, "10.1.2.3") == "tls_unreadable"
    (tmp_path / "tls").rename(tmp_path / "other")
    (tmp_path / "tls").symlink_to(tmp_path / "other")
    assert refused(tmp_path) == "tls_folder_open"


def test_a_lost_or_wrong_authority_key_is_told_when_it_is_needed(tmp_path: Path) -> None:
    issued(tmp_path)
    key = tmp_path / "tls" / "ca.key"
    data = key.read_bytes()
    key.unlink()
    assert issued(tmp_path).made == ()  # it may lie in a safe
    assert refused(tmp_path, "10.1.2.3") == "authority_key_missing"
    issue(tmp_path / "b", "carrier", (), FOUND, NOW)
    key.write_bytes((tmp_path / "b" / "tls" / "ca.key").read_bytes())
    key.chmod(0o600)
    assert refused(tmp_path, "10.1.2.3") == "authority_key_wrong"
    key.write_bytes(b"noise")
    assert refused(tmp_path, "10.1.2.3") == "authority_key_wrong"
    key.write_bytes(data)
    assert issued(tmp_path, "10.1.2.3").made == ("planner.pem",)


def test_damaged_certificates_are_named_and_bad_names_too(tmp_path: Path) -> None:
    issued(tmp_path)
    (tmp_path / "tls" / "planner.pem").write_text("noise")
    assert refused(tmp_path) == "tls_malformed"
    assert refused(tmp_path / "b", "zürich.local") == "tls_bad_name"


def test_a_certificate_of_another_authority_is_replaced(tmp_path: Path) -> None:
    issued(tmp_path)
    issue(tmp_path / "b", "carrier", (), FOUND, NOW)
    ours, theirs = tmp_path / "tls", tmp_path / "b" / "tls"
    (ours / "planner.pem").write_bytes((theirs / "planner.pem").read_bytes())
    assert issued(tmp_path).made == ("planner.pem",)


def test_the_servers_own_library_takes_both_from_one_file(tmp_path: Path) -> None:
    made = issued(tmp_path)
    ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER).load_cert_chain(made.planner, made.planner)


def test_the_planner_may_be_asked_by_each_name(tmp_path: Path) -> None:
    allowed = issued(tmp_path).planner_environment({"robot.example"})["PONS_ALLOWED_HOSTS"]
    assert set(allowed.split(",")) == {*FOUND, "robot.example"}
