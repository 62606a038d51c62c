"""Metal moves only for somebody whose key others can't read."""

from __future__ import annotations

from pathlib import Path

import pytest

from bridge.operator_key import load_operator_key
from wire import VIRTUAL_KEY, Misconfigured


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
    with pytest.raises(Misconfigured, match=r"operator_key_missing: .*operator\.key"):
        load_operator_key(tmp_path, virtual=False)


def test_a_short_key_refuses_to_start(tmp_path: Path) -> None:
    key_file(tmp_path, b"0123456789abcde\n")
    with pytest.raises(Misconfigured, match=r"operator_key_short: .*15 bytes, expected"):
        load_operator_key(tmp_path, virtual=False)


@pytest.mark.parametrize("mode", [0o640, 0o604, 0o620, 0o644, 0o666])
def test_a_key_that_others_can_reach_refuses_to_start(tmp_path: Path, mode: int) -> None:
    key_file(tmp_path, b"0123456789abcdef", mode)
    with pytest.raises(Misconfigured, match=f"operator_key_exposed: .*mode 0{mode:o}"):
        load_operator_key(tmp_path, virtual=False)
