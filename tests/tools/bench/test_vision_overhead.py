"""Looks are timed on pictures that hold things, and count only where some of them are found."""

from __future__ import annotations

from typing import Any

import pytest

from planner.perception.process_client import DEFAULT_MODEL
from tools.bench.measure.vision_overhead import FRAMES, SIZE, Subject, _time_rows, drawn_frames
from wire.image_header import read_header

SUBJECT = Subject("default", DEFAULT_MODEL)
TIMED: dict[str, Any] = {
    "raw": [10.0], "bare": [], "look": [10.2], "jpeg": [10.4], "whole": [11.0],
    "opencv": [], "refused": "", "detections": 0.0,
}  # fmt: skip


@pytest.mark.parametrize(("found", "valid"), [(2.5, True), (0.0, False)])
def test_looks_that_find_nothing_stop_early_and_count_for_nothing(
    found: float, valid: bool
) -> None:
    rows = {row.what: row for row in _time_rows(SUBJECT, TIMED | {"detections": found})}
    look = rows["default: look over raw"]
    assert look.figures is not None
    assert look.figures.p50 == pytest.approx(2.0)
    assert look.valid == valid
    assert f"{found:.1f} detections a frame" in look.note
    assert rows["default: jpeg over raw"].valid == valid
    whole = rows["default: whole over raw"]
    assert whole.figures is not None
    assert whole.figures.p50 == pytest.approx(10.0)
    assert rows["default: raw session.run"].valid


def test_a_look_is_held_against_the_bare_network_too_where_that_was_timed() -> None:
    data = TIMED | {"bare": [8.0]}
    rows = {row.what: row for row in _time_rows(SUBJECT, data)}
    over = rows["default: look over bare net"]
    assert over.figures is not None
    assert over.figures.p50 == pytest.approx(27.5)
    assert (over.goal, over.valid) == ("", False)
    figures = rows["default: bare net"].figures
    assert figures is not None
    assert figures.p50 == 8.0
    assert "default: bare net" not in {row.what for row in _time_rows(SUBJECT, TIMED)}


def test_frames_are_drawn_as_the_camera_sends_them() -> None:
    made = drawn_frames()
    assert len(made) == len(set(made)) == FRAMES
    for shown in made:
        for kind, data in (("jpeg", shown.color), ("png", shown.depth)):
            header = read_header(data)
            assert header is not None
            assert (header.kind, header.width, header.height) == (kind, *SIZE)
