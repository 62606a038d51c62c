"""A packed picture is read as each transport hands it over, and what is none says why."""

from __future__ import annotations

import base64
from math import isfinite
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2.compressed_image import MOST_PACKED_BYTES, CompressedPicture, read_compressed_image
from ros2.trouble import CODES, TopicFailure

DATA = b"\xff\xd8\xff\xe0"
STAMP = {"stamp": {"sec": 12, "nanosec": 500_000_000}, "frame_id": "camera"}
FORMAT = "rgb8; jpeg compressed bgr8"


def message(**more: object) -> dict[str, Any]:
    return {"header": STAMP, "format": FORMAT, "data": DATA} | more


def refusal(said: dict[str, Any]) -> str:
    with pytest.raises(TopicFailure) as told:
        read_compressed_image(said, "/camera/compressed")
    assert "/camera/compressed" in told.value.trouble.found
    return told.value.trouble.code


@pytest.mark.parametrize("data", [DATA, base64.b64encode(DATA).decode(), list(DATA)])
def test_bytes_base64_and_numbers_are_the_same_picture(data: object) -> None:
    found = read_compressed_image(message(data=data), "/camera/compressed")
    assert found == CompressedPicture(FORMAT, DATA, 12.5)


@pytest.mark.parametrize("header", [None, {}, {"stamp": {"sec": 0, "nanosec": 0}}, {"stamp": 7}])
def test_a_picture_without_a_stamp_is_a_picture(header: object) -> None:
    assert read_compressed_image(message(header=header), "/c").stamp_s is None


@pytest.mark.parametrize("form", ["16UC1; compressedDepth", "32FC1; compressedDepth png"])
def test_depth_is_told_apart(form: str) -> None:
    assert refusal(message(format=form)) == "ros2_image_depth"


@pytest.mark.parametrize(
    "more",
    [
        {"format": None}, {"format": 7}, {"data": None}, {"data": b""}, {"data": ""},
        {"data": []}, {"data": "no base64!"}, {"data": "QUJ"}, {"data": "ÄÖ"}, {"data": [256]},
        {"data": ["a"]}, {"data": [1.5]}, {"data": {"0": 1}},
    ],
)  # fmt: skip
def test_what_is_no_picture_is_refused(more: dict[str, object]) -> None:
    assert refusal(message(**more)) == "ros2_unreadable"


@pytest.mark.parametrize(
    "data", [bytes(MOST_PACKED_BYTES + 1), "A" * (4 * MOST_PACKED_BYTES // 3 + 8)]
)
def test_one_that_is_too_large_is_not_copied(data: object) -> None:
    assert refusal(message(data=data)) == "ros2_message_too_large"
    assert read_compressed_image(message(data=bytes(MOST_PACKED_BYTES)), "/c").data


def picture_or_code(said: dict[str, Any]) -> CompressedPicture | str:
    try:
        return read_compressed_image(said, "/c")
    except TopicFailure as why:
        return why.trouble.code


ANYTHING = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=20)
    | st.binary(max_size=20),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner),
    max_leaves=8,
)  # fmt: skip


@given(
    st.dictionaries(st.sampled_from(["header", "format", "data"]), ANYTHING)
    | st.builds(message, data=ANYTHING)
    | st.builds(message, header=st.fixed_dictionaries({"stamp": ANYTHING}))
)
def test_whatever_came_is_a_picture_or_a_code(said: dict[str, Any]) -> None:
    found = picture_or_code(said)
    if isinstance(found, str):
        assert found in CODES
    else:
        assert 0 < len(found.data) <= MOST_PACKED_BYTES
        assert found.stamp_s is None or isfinite(found.stamp_s)
