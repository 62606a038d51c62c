"""What the camera shows lies where it is: pixels put back into space fall onto the home."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.camera import Renderer, focal_px
from tests.sim.camera.gallery import CAMERA, MIDDLE, WALL_M, hall, points
from wire import CameraConfig, Pose2

BALL = {"class": "ball", "at": [6.0, 4.0], "size": [0.4, 0.4, 0.4], "on": 0.8}


def test_a_wall_straight_ahead_has_one_depth() -> None:
    frame = Renderer(hall(), CAMERA).render(MIDDLE)
    middle = frame.depth_m[CAMERA.height_px // 2]
    assert middle == pytest.approx(np.full(CAMERA.width_px, WALL_M - 4.0), abs=1e-4)
    assert np.all(frame.ids == 0)


@pytest.mark.parametrize(("yaw", "pitch", "side", "height"), [
    (0.0, 0.0, 0, 0), (0.2, 0.0, 1, 0), (-0.2, 0.0, -1, 0), (0.0, 0.2, 0, -1), (0.0, -0.2, 0, 1),
])  # fmt: skip
def test_a_ball_appears_where_a_pinhole_puts_it(
    yaw: float, pitch: float, side: int, height: int
) -> None:
    camera = CAMERA.model_copy(update={"pitch_rad": pitch})
    renderer = Renderer(hall(objects={"ball": BALL}), camera)
    frame = renderer.render(Pose2(4.0, 4.0, yaw))
    rows, columns = np.nonzero(frame.ids)
    u = columns.mean() + 0.5 - camera.width_px / 2
    v = rows.mean() + 0.5 - camera.height_px / 2
    # Turned left by yaw it is seen to the right; looking down by pitch it is seen higher.
    assert u == pytest.approx(focal_px(camera) * np.tan(yaw), abs=1.0)
    assert v == pytest.approx(-focal_px(camera) * np.tan(pitch), abs=1.0)
    assert (np.sign(round(u)), np.sign(round(v))) == (side, height)
    if side == height == 0:
        assert frame.depth_m[frame.ids > 0].min() == pytest.approx(2.0 - 0.2, abs=0.005)


@settings(max_examples=15)
@given(
    x=st.floats(1.0, 3.0), y=st.floats(1.0, 7.0), yaw=st.floats(-pi, pi),
    pitch=st.floats(-0.6, 0.9), mount=st.floats(-1.0, 1.0),
)  # fmt: skip
def test_every_pixel_lies_on_what_it_shows(
    x: float, y: float, yaw: float, pitch: float, mount: float
) -> None:
    camera = CameraConfig(
        x_m=0.2, y_m=-0.1, z_m=1.1, yaw_rad=mount, pitch_rad=pitch, width_px=48, height_px=36,
        depth_min_m=0.0, depth_max_m=50.0,
    )  # fmt: skip
    base = Pose2(x, y, yaw)
    frame = Renderer(hall(objects={"ball": BALL}), camera).render(base)
    found = points(frame, camera, base)
    bare = found[frame.ids == 0]
    assert np.all(frame.depth_m > 0.0), "a hall is closed all around"
    walls = np.abs(bare[:, :2] - 4.0).max(axis=1)
    off = np.minimum(np.abs(bare[:, 2]), np.abs(bare[:, 2] - 2.4))
    off = np.minimum(off, np.abs(walls - (WALL_M - 4.0)))
    assert off.max(initial=0.0) < 2e-3
    ball = found[frame.ids > 0] - (6.0, 4.0, 1.0)
    assert np.abs(np.linalg.norm(ball, axis=1) - 0.2).max(initial=0.0) < 2e-3


def test_depth_out_of_range_is_none_but_the_picture_goes_on() -> None:
    camera = CAMERA.model_copy(update={"depth_max_m": 3.0})
    frame = Renderer(hall(objects={"ball": BALL}), camera).render(MIDDLE)
    assert set(np.unique(frame.ids[frame.depth_m > 0.0])) >= {1}
    assert np.all(frame.depth_m[36, :20] == 0.0)
    assert np.all(frame.color[36, :20] > 0)


def test_doorways_have_a_lintel() -> None:
    # A door of 2.05 m in a wall of 2.4 m: through it one sees far, above it one does not.
    name = {"en": "hall", "zh": "厅"}
    rooms = {
        "hall": {"name": name, "box": [0.0, 0.0, 8.0, 8.0], "pose": [1.0, 1.0, 0]},
        "far": {"name": {"en": "far", "zh": "远"}, "box": [8.0, 2, 12, 6], "pose": [10, 4, 0]},
    }
    doors = [{"between": ["hall", "far"], "at": [8.0, 4.0], "width_m": 1.2}]
    frame = Renderer(hall(rooms=rooms, doors=doors), CAMERA).render(MIDDLE)
    assert frame.depth_m[36, 48] == pytest.approx(11.95 - 4.0, abs=1e-3)
    assert frame.depth_m[12, 48] == pytest.approx(WALL_M - 4.0, abs=1e-3)
