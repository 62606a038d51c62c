"""Metal moves only for somebody whose key others can't read."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from bridge.operator_key import load_operator_key
from wire import VIRTUAL_KEY, ConfigError


def key_file(home: Path, content: bytes, mode: int = 0o600) -> Path:
    path = home / "operator.key"
    path.write_bytes(content)
    path.chmod(mode)
    return path


def test_a_virtual_drive_has_the_published_key(tmp_path: Path) -> None:
    key_file(tmp_path, b"something else entirely")
    assert load_operator_key(tmp_path, virtual=True) == VIRTUAL_KEY


def test_hardware_has_its_own(tmp_path: Path) -> None:
    key_file(tmp_path, b"0123456789abcdef\n")
    assert load_operator_key(tmp_path, virtual=False) == b"0123456789abcdef"


def test_a_missing_key_refuses_to_start(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=r"operator_key_missing: .*operator\.key"):
        load_operator_key(tmp_path, virtual=False)


def test_a_short_key_refuses_to_start(tmp_path: Path) -> None:
    key_file(tmp_path, b"0123456789abcde\n")
    with pytest.raises(ConfigError, match=r"operator_key_short: .*15 bytes, expected"):
        load_operator_key(tmp_path, virtual=False)


@pytest.mark.parametrize("mode", [0o640, 0o604, 0o620, 0o644, 0o666])
def test_a_key_that_others_can_reach_refuses_to_start(tmp_path: Path, mode: int) -> None:
    key_file(tmp_path, b"0123456789abcdef", mode)
    with pytest.raises(ConfigError, match=f"operator_key_exposed: .*mode 0{mode:o}"):
        load_operator_key(tmp_path, virtual=False)


def test_a_key_that_is_a_link_refuses_to_start(tmp_path: Path) -> None:
    """To another user's secret, or to what this very process was given."""
    (tmp_path / "operator.key").symlink_to("/proc/self/environ")
    with pytest.raises(ConfigError, match=r"operator_key_linked: .*link to /proc/self/environ"):
        load_operator_key(tmp_path, virtual=False)


def test_a_link_put_there_between_two_looks_is_not_followed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "other").mkdir()
    (tmp_path / "operator.key").symlink_to(key_file(tmp_path / "other", b"0123456789abcdef"))
    monkeypatch.setattr(Path, "is_symlink", lambda _: False)
    with pytest.raises(ConfigError, match=r"operator_key_missing: .*symbolic links"):
        load_operator_key(tmp_path, virtual=False)


def test_a_pipe_or_a_folder_is_no_key_and_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "operator.key", 0o600)
    with pytest.raises(ConfigError, match=r"operator_key_no_file: .* is a pipe"):
        load_operator_key(tmp_path, virtual=False)
    (tmp_path / "operator.key").unlink()
    (tmp_path / "operator.key").mkdir()
    with pytest.raises(ConfigError, match=r"operator_key_no_file: .* is a folder"):
        load_operator_key(tmp_path, virtual=False)


@pytest.mark.skipif(os.geteuid() != 0, reason="only root may give a file away")
def test_a_key_of_another_user_refuses_to_start(tmp_path: Path) -> None:
    """In a sticky folder whoever comes first may make it."""
    os.chown(key_file(tmp_path, b"0123456789abcdef"), 61_002, 61_002)
    with pytest.raises(ConfigError, match=r"operator_key_not_yours: .*user 61002, expected 0"):
        load_operator_key(tmp_path, virtual=False)
