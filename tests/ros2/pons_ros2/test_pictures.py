"""Pictures go as they came, or are refused by what is wrong with them."""

from __future__ import annotations

from types import SimpleNamespace as Made
from typing import Any

import pytest

from ros2.pons_ros2.pons_ros2.pictures import MOST_BYTES, read_picture
from ros2.pons_ros2.pons_ros2.readings import UnusableMessage

HEADER = Made(stamp=Made(sec=7, nanosec=0))


def packed(form: str = "jpeg", data: bytes = b"abc") -> Any:
    return Made(header=HEADER, format=form, data=data)


def raw(**more: Any) -> Any:
    made = {"encoding": "rgb8", "width": 2, "height": 1, "step": 6, "is_bigendian": 0}
    return Made(header=HEADER, **{"data": b"abcdef"} | made | more)


def test_packed_bytes_go_as_they_came_and_depth_loses_its_head() -> None:
    assert read_picture(packed(), depth=False) == (
        {"kind": "packed", "format": "jpeg", "stamp_s": 7.0}, b"abc",
    )  # fmt: skip
    depth = packed("16UC1; compressedDepth png", b"h" * 12 + b"png")
    assert read_picture(depth, depth=True)[1] == b"png"


def test_raw_rows_lose_their_padding() -> None:
    head, data = read_picture(raw(height=2, step=8, data=b"abcdef..ghijkl.."), depth=False)
    assert (head["format"], head["width"], head["height"]) == ("rgb8", 2, 2)
    assert data == b"abcdefghijkl"


@pytest.mark.parametrize(
    ("message", "depth"),
    [
        (packed("16UC1; compressedDepth png"), False),
        (packed("jpeg"), True),
        (packed("32FC1; compressedDepth png"), True),
        (packed(data=b""), False),
        (packed(data=bytes(MOST_BYTES + 1)), False),
        (raw(encoding="bayer_rggb8"), False),
        (raw(), True),
        (raw(data=b"abc"), False),
        (raw(width=0, step=0, data=b"x"), False),
        (raw(encoding="16UC1", step=4, data=b"abcd", is_bigendian=1), True),
    ],
)
def test_what_is_no_such_picture_is_refused(message: Any, *, depth: bool) -> None:
    with pytest.raises(UnusableMessage):
        read_picture(message, depth=depth)
