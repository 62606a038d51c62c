"""The relay's key is read where it is a secret and long enough, or the start is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2.__main__ import KEY_FILE, relay_key
from wire import ConfigError


def test_the_key_is_read_without_its_line_feed_and_may_be_missing(tmp_path: Path) -> None:
    assert relay_key(tmp_path) == b""
    (tmp_path / KEY_FILE).write_bytes(b"0123456789abcdef\n")
    (tmp_path / KEY_FILE).chmod(0o600)
    assert relay_key(tmp_path) == b"0123456789abcdef"


@pytest.mark.parametrize(
    ("text", "mode", "code"),
    [
        (b"short", 0o600, "relay_key_unfit"),
        (b"0" * 16, 0o640, "relay_key_unfit"),
        (b"0" * 5_000, 0o600, "relay_key_unreadable"),
    ],
)
def test_a_key_that_is_no_secret_refuses_the_start(
    tmp_path: Path, text: bytes, mode: int, code: str
) -> None:
    (tmp_path / KEY_FILE).write_bytes(text)
    (tmp_path / KEY_FILE).chmod(mode)
    with pytest.raises(ConfigError) as refused:
        relay_key(tmp_path)
    assert refused.value.code == code
