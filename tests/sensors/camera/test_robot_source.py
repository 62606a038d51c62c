"""Pictures of the node on a robot are unpacked by what their head says, or refused."""

from __future__ import annotations

import numpy as np
import pytest

from ros2.pictures import PictureHead
from sensors.camera.robot_source import color_of, depth_of
from sensors.camera.shot import CameraTrouble
from tests.sensors.camera.test_packed_picture import JPEG, PICTURE, PNG, packed

DEPTH = np.array([[0, 500, 65535]], np.uint16)


def raw(form: str, width: int = 3, height: int = 1) -> PictureHead:
    return PictureHead(kind="raw", format=form, width=width, height=height)


def test_packed_and_raw_colours_are_blue_green_red() -> None:
    assert np.abs(color_of(PictureHead(format="jpeg"), JPEG).astype(int) - PICTURE).mean() < 3
    pixels = bytes(range(12))
    for form, first in (("bgr8", [0, 1, 2]), ("rgb8", [2, 1, 0]), ("rgba8", [2, 1, 0]),
                        ("bgra8", [0, 1, 2]), ("mono8", [0, 0, 0])):  # fmt: skip
        wide = {"rgb8": 4, "bgr8": 4, "mono8": 12}.get(form, 3)
        assert color_of(raw(form, wide), pixels)[0, 0].tolist() == first


def test_depth_is_in_millimetres_whatever_it_came_as() -> None:
    assert depth_of(raw("16UC1"), DEPTH.tobytes()).tolist() == DEPTH.tolist()
    metres = np.array([[np.nan, 0.5, np.inf]], np.float32)
    assert depth_of(raw("32FC1"), metres.tobytes()).tolist() == [[0, 500, 0]]
    png = packed(".png", DEPTH)
    assert depth_of(PictureHead(format="16UC1; compressedDepth"), png).tolist() == DEPTH.tolist()


@pytest.mark.parametrize(
    ("head", "data"),
    [
        (raw("rgb8"), b"short"),
        (raw("bayer"), bytes(9)),
        (raw("mono8", 8192, 8192), b""),
        (raw("mono8", 0, 0), b""),
        (PictureHead(format="jpeg"), b"none"),
    ],
)
def test_what_is_no_picture_is_refused(head: PictureHead, data: bytes) -> None:
    with pytest.raises(CameraTrouble):
        color_of(head, data)


@pytest.mark.parametrize(
    ("head", "data"),
    [(raw("rgb8"), bytes(9)), (raw("16UC1"), b"x"), (PictureHead(), PNG), (PictureHead(), b"x")],
)
def test_what_is_no_depth_is_refused(head: PictureHead, data: bytes) -> None:
    with pytest.raises(CameraTrouble):
        depth_of(head, data)
