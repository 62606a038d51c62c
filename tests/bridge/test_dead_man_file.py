"""What was seen of a base counts for that base alone, and nothing that can't be read counts."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from bridge.dead_man_file import MAX_BYTES, dead_man_path, load_dead_man, write_dead_man
from wire import RobotDescription


def ugv(**drive: object) -> RobotDescription:
    return RobotDescription.model_validate(
        {"drive": {"kind": "waveshare", "port": "/dev/x", **drive}}
    )


def test_nobody_has_tried_where_nothing_is_kept(tmp_path: Path) -> None:
    assert load_dead_man(tmp_path, ugv()) is None


def test_what_was_seen_is_read_again(tmp_path: Path) -> None:
    write_dead_man(tmp_path, ugv(), 0.31)
    assert load_dead_man(tmp_path, ugv()) == 0.31
    assert load_dead_man(tmp_path, ugv(lag_s=0.2)) == 0.31, "of the same base"


@pytest.mark.parametrize("other", [{"port": "/dev/y"}, {"timeout_s": 0.3}], ids=str)
def test_another_base_or_time_out_is_not_tried(
    tmp_path: Path, other: dict[str, object], caplog: pytest.LogCaptureFixture
) -> None:
    write_dead_man(tmp_path, ugv(), 0.31)
    assert load_dead_man(tmp_path, ugv(**other)) is None
    assert "dead_man_file_refused" in caplog.text


@pytest.mark.parametrize("silence_s", [-0.1, 61.0, "0.3", None])
def test_a_silence_that_is_none_is_refused(tmp_path: Path, silence_s: object) -> None:
    write_dead_man(tmp_path, ugv(), 0.31)
    path = dead_man_path(tmp_path, ugv())
    path.write_text(json.dumps({**json.loads(path.read_text()), "silence_s": silence_s}))
    assert load_dead_man(tmp_path, ugv()) is None


def test_what_can_not_be_read_is_refused(tmp_path: Path) -> None:
    path = dead_man_path(tmp_path, ugv())
    path.mkdir(parents=True)
    assert load_dead_man(tmp_path, ugv()) is None
    path.rmdir()
    path.write_bytes(b" " * (MAX_BYTES + 1))
    assert load_dead_man(tmp_path, ugv()) is None
