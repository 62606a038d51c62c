"""A box becomes a place on the map: by depth, by the floor, or not at all."""

from __future__ import annotations

from math import atan2, cos, hypot, inf, isfinite, nan, pi, sin

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.language.object_classes import kind_of
from planner.perception.interfaces import PointRefusal
from planner.perception.projection import (
    OFF_WALL_M,
    USUAL_SHARE,
    first_wall_m,
    place,
    point_on_map,
    spot_at,
)
from planner.site.polygon import border_distance_m
from tests.planner.perception.scenes import CAMERA, FOCAL_PX, box_of, seen, two_room, view
from wire import Pose2, transform

POSES = [Pose2(0.0, 0.0, 0.0), Pose2(2.0, -1.0, 2.5), Pose2(-3.0, 4.0, -pi / 2)]


@pytest.mark.parametrize("pose", POSES)
@pytest.mark.parametrize(("ahead_m", "left_m", "z_m"), [(2.0, 0.0, 0.1), (3.0, 0.8, 0.7)])
def test_depth_leads_back_to_where_it_was(
    pose: Pose2, ahead_m: float, left_m: float, z_m: float
) -> None:
    at = view(pose.x_m, pose.y_m, pose.yaw_rad)
    there = view(*transform(pose, ahead_m, left_m)).stance.base_in_map
    box, depth_m = box_of(at, there.x_m, there.y_m, z_m, 0.08)
    spot = place(at, seen("cup", box, depth_m - kind_of("cup").behind_m))
    assert spot is not None
    assert hypot(spot.x_m - there.x_m, spot.y_m - there.y_m) < 0.02
    assert spot.z_m == pytest.approx(z_m, abs=0.03)
    assert 0.02 < spot.sigma_m < 0.2


@pytest.mark.parametrize("pose", POSES)
def test_without_depth_the_floor_tells(pose: Pose2) -> None:
    at = view(pose.x_m, pose.y_m, pose.yaw_rad)
    x_m, y_m = transform(pose, 2.5, 0.3)
    foot, _ = box_of(at, x_m, y_m, 0.0, 0.02)
    u, v = (foot[0] + foot[2]) / 2, (foot[1] + foot[3]) / 2
    spot = place(at, seen("box", (u - 20, v - 40, u + 20, v), None))
    by_depth = spot_at(at, u, v, None)
    assert spot is not None
    assert by_depth is not None
    behind_m = kind_of("box").behind_m
    assert hypot(by_depth.x_m - x_m, by_depth.y_m - y_m) < 0.01
    assert hypot(spot.x_m - x_m, spot.y_m - y_m) == pytest.approx(behind_m, abs=0.01)
    cup = place(at, seen("cup", (u - 20, v - 40, u + 20, v), None))
    assert cup is not None
    assert cup.sigma_m > 2 * spot.sigma_m  # it may stand on a table


@pytest.mark.parametrize(
    ("box", "depth_m"),
    [
        ((100.0, 20.0, 140.0, 60.0), None),  # its foot is above the horizon
        ((100.0, 60.0, 140.0, 90.0), None),  # and here far beyond what the floor tells
        ((100.0, 100.0, 140.0, 240.0), None),  # its foot is below the picture
        ((100.0, 100.0, 140.0, 140.0), 0.0),
        ((100.0, 100.0, 140.0, 140.0), -1.0),
        ((100.0, 100.0, 140.0, 140.0), 50.0),
        ((100.0, 100.0, 140.0, 140.0), nan),
        ((140.0, 100.0, 100.0, 140.0), 2.0),
        ((100.0, nan, 140.0, 140.0), 2.0),
        ((100.0, 100.0, inf, 140.0), 2.0),
    ],
)
def test_what_does_not_work_out_is_nowhere(
    box: tuple[float, float, float, float], depth_m: float | None
) -> None:
    assert place(view(), seen("box", box, depth_m)) is None


def test_what_is_cut_off_is_less_sure() -> None:
    whole = place(view(), seen("sofa", (60.0, 80.0, 180.0, 160.0), 3.0))
    cut = place(view(), seen("sofa", (0.0, 80.0, 120.0, 160.0), 3.0))
    assert whole is not None
    assert cut is not None
    assert cut.sigma_m > whole.sigma_m


@pytest.mark.parametrize("left_m", [-1.6, 1.6])
def test_the_middle_of_what_is_cut_off_at_a_side_is_beyond_what_shows(left_m: float) -> None:
    wide_m, depth_m = 2 * USUAL_SHARE * kind_of("sofa").reach_m, 2.0
    (left, top, right, bottom), _ = box_of(view(), CAMERA.x_m + depth_m, left_m, 0.4, wide_m)
    shown = (max(0.0, left), top + 20.0, min(320.0, right), bottom)
    assert 60.0 < shown[2] - shown[0] < 0.8 * (right - left)
    spot = place(view(), seen("sofa", shown, depth_m))
    assert spot is not None
    bearing_rad = atan2(spot.y_m, spot.x_m - CAMERA.x_m)
    assert bearing_rad == pytest.approx(atan2(left_m, depth_m), abs=0.03)


_any = st.floats(width=32)


@settings(max_examples=50)
@given(st.tuples(_any, _any, _any, _any), st.none() | _any, st.sampled_from(["cup", "bed", "x"]))
def test_no_box_leads_to_nan(
    box: tuple[float, float, float, float], depth_m: float | None, label: str
) -> None:
    spot = place(view(), seen(label, box, depth_m))
    if spot is not None:
        assert all(map(isfinite, (spot.x_m, spot.y_m, spot.z_m, spot.sigma_m)))
        assert spot.sigma_m > 0.0


def pointed(x: float, y: float, depth_m: float | None, yaw_rad: float = 0.0) -> str:
    """Point from the middle of the two rooms' first one; return what came of it."""
    try:
        point_on_map(view(1.0, 1.5, yaw_rad), two_room(), x, y, depth_m)
    except PointRefusal as refused:
        return refused.code
    return "ok"


@pytest.mark.parametrize(
    ("x", "y", "depth_m", "code"),
    [
        (500, 900, None, "ok"),
        (500, 100, None, "point_no_depth"),  # the sky
        (500, 500, 9.0, "point_on_wall"),  # behind whatever stands there
        (500, 500, 11.0, "point_too_far"),
        (500, 1001, 1.0, "point_malformed"),
        (float("nan"), 500, 1.0, "point_malformed"),
    ],
)
def test_a_pointed_pixel_leads_to_floor_or_is_refused(
    x: float, y: float, depth_m: float | None, code: str
) -> None:
    assert pointed(x, y, depth_m) == code


def test_no_wall_is_pointed_at_and_furniture_by_its_near_side() -> None:
    """All round, at eye height: whatever the depth of a wall says, no wall is driven at.

    What stands inside a room, away from its outline, is furniture: the point is its near side.
    """
    site, walls, furniture = two_room(), 0, 0
    for degrees in range(0, 360, 5):
        yaw = degrees * pi / 180
        at = view(1.0, 1.5, yaw).camera_in_map
        wall_m = first_wall_m(site.grid, (at.x_m, at.y_m), yaw, 8.0)
        assert wall_m is not None
        hit = at.x_m + wall_m * cos(yaw), at.y_m + wall_m * sin(yaw)
        room = site.room_at(*hit)
        off_wall_m = border_distance_m(room.polygon, *hit) if room and room.polygon else 0.0
        row = 500 - 1000 * FOCAL_PX * CAMERA.pitch_rad / 240  # about level with the camera
        for off_m in (-0.05, 0.0, 0.03):
            told = pointed(500, row, wall_m + off_m, yaw)
            if off_wall_m < OFF_WALL_M - 0.05:
                assert told != "ok", degrees
                walls += 1
            elif told == "ok":
                furniture += 1
                spot = point_on_map(view(1.0, 1.5, yaw), site, 500, row, wall_m + off_m)
                assert hypot(spot.x_m - hit[0], spot.y_m - hit[1]) < 0.15
                assert spot.z_m >= 0.3
    assert walls > 150
    assert furniture > 3
