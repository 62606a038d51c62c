"""Make pictures, stances and boxes for tests of the eyes: a camera that sees what it is told."""

from __future__ import annotations

from functools import cache

from planner.perception import Box, Detection
from planner.perception.data_association import PlacedDetection
from planner.perception.interfaces import MapPoint
from planner.perception.pose_buffer import Stance
from planner.perception.projection import View, pixel_of
from planner.site import Site
from tests.conftest import ROOT
from wire import Image, ImageHeader, Pose2, RobotDescription

CAMERA = RobotDescription().camera
FOCAL_PX = 233.9
JPEG = b"\xff\xd8picture"


@cache
def two_room() -> Site:
    return Site.load(ROOT / "sites" / "two_room")


def header(seq: int = 1, stamp_s: float = 0.0, boot: str = "c1") -> ImageHeader:
    return ImageHeader(boot_id=boot, seq=seq, stamp_s=stamp_s, width=320, height=240,
                       focal_px=FOCAL_PX, center_x_px=160.0, center_y_px=120.0)  # fmt: skip


def image(seq: int = 1, stamp_s: float = 0.0, data: bytes | None = None, boot: str = "c1") -> Image:
    return Image(header(seq, stamp_s, boot), JPEG + str(seq).encode() if data is None else data)


def view(x_m: float = 0.0, y_m: float = 0.0, yaw_rad: float = 0.0) -> View:
    return View(header(), CAMERA, Stance(Pose2(x_m, y_m, yaw_rad)))


def box_of(at: View, x_m: float, y_m: float, z_m: float, size_m: float) -> tuple[Box, float]:
    """Return the box and the depth of a ball of this size whose middle is there."""
    seen = pixel_of(at, x_m, y_m, z_m)
    assert seen is not None
    u, v, depth_m = seen
    half = size_m / 2 * FOCAL_PX / depth_m
    return (u - half, v - half, u + half, v + half), depth_m


def seen(label: str, box: Box, depth_m: float | None, color: str | None = None) -> Detection:
    return Detection(label, 0.9, box, color, depth_m, 0.01)


def placed(
    label: str = "cup",
    x_m: float = 1.0,
    y_m: float = 0.0,
    *,
    index: int = 0,
    score: float = 0.9,
    color: str | None = "red",
    sigma_m: float = 0.05,
    box: Box | None = None,
) -> PlacedDetection:
    left = 40.0 * index
    spot = MapPoint(x_m, y_m, 0.5, sigma_m)
    return PlacedDetection(index, label, score, color, box or (left, 0.0, left + 30.0, 30.0), spot)
