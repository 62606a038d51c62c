"""Where a lidar sits is read along the chain of frames, and what hangs head down is refused."""

from __future__ import annotations

import json
from math import cos, pi, sin
from typing import Any

import pytest

from ros2.mounting import NoMounting, find_mounting
from ros2.robot_words import FrameWords, Unreadable, read_frames


def transform(
    parent: str, child: str, at: tuple[float, float, float] = (0.0, 0.0, 0.0),
    yaw_rad: float = 0.0, roll_rad: float = 0.0,
) -> dict[str, Any]:  # fmt: skip
    """Return one of /tf_static: first a roll, then a yaw."""
    cy, sy, cr, sr = cos(yaw_rad / 2), sin(yaw_rad / 2), cos(roll_rad / 2), sin(roll_rad / 2)
    turned = [cy * sr, sy * sr, sy * cr, cy * cr]
    return {"parent": parent, "child": child, "at_m": list(at), "turned": turned}


def said(*transforms: dict[str, Any]) -> tuple[FrameWords, ...]:
    return read_frames(json.dumps(transforms).encode())


def test_a_chain_adds_up_whichever_message_says_which_part() -> None:
    found = find_mounting(
        said(
            transform("mast", "laser", (0.1, 0.0, 0.05), yaw_rad=pi / 2),
            transform("base_link", "mast", (0.2, 0.3, 0.1), yaw_rad=pi / 2),
            transform("base_footprint", "base_link", (0.0, 0.0, 0.08)),
        ),
        "laser",
    )
    assert found.base == "base_link"
    assert (found.x_m, found.y_m, found.z_m) == pytest.approx((0.2, 0.4, 0.15))
    assert abs(found.yaw_rad) == pytest.approx(pi)


def test_without_base_link_the_footprint_serves() -> None:
    found = find_mounting(said(transform("base_footprint", "laser", (0.1, 0.0, 0.2))), "/laser")
    assert (found.base, found.x_m, found.yaw_rad) == ("base_footprint", 0.1, 0.0)


def test_a_lidar_in_the_bases_own_frame_sits_in_its_middle() -> None:
    found = find_mounting([], "base_link")
    assert (found.x_m, found.y_m, found.yaw_rad) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("transforms", "says"),
    [
        ([], "laser leads to none of base_link, base_footprint"),
        ([transform("mast", "laser")], "laser > mast leads to none"),
        ([transform("mast", "laser"), transform("laser", "mast")], "leads to none"),
        ([transform("base_link", "laser", roll_rad=pi)], "head down"),
        ([transform("base_link", "laser", roll_rad=0.5)], "tilted"),
        ([transform("base_link", "laser") | {"turned": [0.0] * 4}], "is none"),
    ],
)
def test_what_says_no_place_is_refused(transforms: list[dict[str, Any]], says: str) -> None:
    with pytest.raises(NoMounting, match=says):
        find_mounting(said(*transforms), "laser")


@pytest.mark.parametrize(
    "wrong",
    [
        7, {}, [7], [{}], [transform("a", "b") | {"at_m": [0.0, 0.0]}],
        [transform("a", "b", (1e9, 0.0, 0.0))], [transform("a", "b") | {"child": None}],
    ],
)  # fmt: skip
def test_what_is_no_transform_is_refused(wrong: Any) -> None:
    with pytest.raises(Unreadable):
        read_frames(json.dumps(wrong).encode())
