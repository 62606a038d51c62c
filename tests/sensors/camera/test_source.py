"""A camera is opened by what robot.toml names, and says why where it can't be."""

from __future__ import annotations

import os
from math import tan
from pathlib import Path

import numpy as np
import pytest

from sensors.camera.shot import CameraTrouble
from sensors.camera.source import open_source, without_password
from tests.sensors.camera.films import BOTTOM, HEIGHT, TOP, WIDTH, film
from wire import CameraConfig


def trouble(**keys: object) -> CameraTrouble:
    with pytest.raises(CameraTrouble) as told:
        open_source(CameraConfig.model_validate(keys))
    return told.value


def test_a_film_is_played_over_and_over_as_it_was_taken(tmp_path: Path) -> None:
    path = film(tmp_path / "rooms.avi", pictures=3, hz=200.0)
    source = open_source(CameraConfig(kind="stream", url=f"file://{path}", fov_rad=1.0))
    try:
        shots = [source.read() for _ in range(8)]
    finally:
        source.close()
    for shot in shots:
        assert shot.color.shape == (HEIGHT, WIDTH, 3)
        assert np.abs(shot.color[5, 5].astype(int) - TOP).max() < 30
        assert np.abs(shot.color[-5, 5].astype(int) - BOTTOM).max() < 30
        assert shot.focal_px == pytest.approx(WIDTH / 2 / tan(0.5))
        assert shot.center_px == (WIDTH / 2, HEIGHT / 2)
        assert shot.depth_mm is None
    assert not np.array_equal(shots[0].color, shots[1].color)


def test_one_that_hangs_with_its_head_down_is_turned(tmp_path: Path) -> None:
    path = film(tmp_path / "rooms.avi", hz=200.0)
    source = open_source(CameraConfig(kind="stream", url=f"file://{path}", upside_down=True))
    shot = source.read()
    source.close()
    assert np.abs(shot.color[5, 5].astype(int) - BOTTOM).max() < 30


def test_what_is_no_camera_says_so(tmp_path: Path) -> None:
    text = tmp_path / "notes.txt"
    text.write_text("no film")
    for keys, code in (
        ({"kind": "uvc", "device": str(tmp_path / "video9")}, "camera_missing"),
        ({"kind": "uvc", "device": str(text)}, "camera_not_video"),
        ({"kind": "uvc", "device": "/dev/null"}, "camera_not_video"),
        ({"kind": "stream", "url": f"file://{tmp_path}/none.avi"}, "camera_missing"),
        ({"kind": "stream", "url": f"file://{text}"}, "camera_not_video"),
        ({"kind": "stream", "url": "http://127.0.0.1:9/x"}, "camera_unreachable"),
    ):
        assert trouble(**keys).code == code, keys


def test_a_password_is_told_to_nobody() -> None:
    told = trouble(kind="stream", url="http://me:secret@127.0.0.1:9/x")
    assert told.code == "camera_unreachable"
    assert "secret" not in str(told)
    assert "127.0.0.1:9" in told.detail
    assert without_password("rtsp://a:b@c@host/1?x=2") == "rtsp://***@host/1?x=2"
    assert without_password("rtsp://host/1") == "rtsp://host/1"


def test_a_device_that_may_not_be_opened_is_told_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    """As the kernel would say it; no Video4Linux device is here."""
    monkeypatch.setattr(
        "sensors.camera.source.V4L2_MAJOR", os.major(Path("/dev/null").stat().st_rdev)
    )

    def refuse(*_: object) -> int:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(os, "open", refuse)
    assert trouble(kind="uvc", device="/dev/null").code == "camera_forbidden"
