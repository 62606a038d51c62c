"""Hold the robot's means of sight: its camera, its detector's classes, whether a model is there."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, cos, pi, sin, tan
from typing import TYPE_CHECKING

from planner.language.questions import Relation
from planner.plan import Bilingual, Means

if TYPE_CHECKING:
    from wire import CameraConfig, Pose2

OVERLAP = 0.9
"""Of the field of view is turned between two looks, so that nothing is seen in halves only."""
WELL_INSIDE = 0.85
"""Of half the field of view: what is nearer to the border may be cut off."""


@dataclass(frozen=True, slots=True)
class WantedObject:
    """Name a kind of thing, of one colour or of any; by a neighbour where one is named."""

    label: str
    color: str | None = None
    relation: Relation | None = None
    by: WantedObject | None = None
    """What it stands on, under or near; it has no neighbour itself."""


@dataclass(frozen=True, slots=True)
class PictureCost:
    """Hold what one question about a picture costs."""

    tokens: int = 0
    money: float = 0.0


@dataclass(frozen=True, slots=True)
class PictureLimits:
    """Bound the pictures of one search, and price them."""

    most: int = 0
    each: PictureCost = PictureCost()
    """What one costs, at a guess that is rather too high."""
    currency: str | None = None
    """None: no price is set."""
    by_site: bool = False
    """The site's size bounds them, too: the owner has set no number."""


@dataclass(frozen=True, slots=True)
class ImageAnswer:
    """Hold what came of a question about the picture: words, or a point in ``map``, or neither."""

    text: Bilingual | None = None
    """What a vision model says: it may describe, it never commands."""
    seen: bool | None = None
    """Whether it says that what was asked for is there; tainted as its words are."""
    shown: int = 1
    """Pictures that it was shown: one of each direction of this look, or the newest alone."""
    at: tuple[float, float, float] | None = None
    """x, y, height above the floor [m]."""
    failure: str | None = None
    counts: tuple[int, int, int] | None = None
    """How many of what was sought it sees on the left, in the middle and on the right."""
    sure: float = 0.0
    """Of that, 0 to 1."""
    cost: PictureCost | None = None
    """What the question has cost."""


@dataclass(frozen=True, slots=True)
class Eyesight:
    """Hold what the robot sees with."""

    camera: CameraConfig | None = None
    classes: tuple[str, ...] = ()
    """What the detector can find; empty: not known yet."""
    model: bool = False
    """A vision model may be asked."""
    pictures: PictureLimits = PictureLimits()
    """Of one search by it; most 0: it searches nothing."""

    def means(self, blind: str | None, *, grows: bool = False) -> Means:
        """Return the robot's means by this.

        Args:
            blind: why it sees nothing; None: it sees.
            grows: its map is being made.
        """
        if self.camera is None or self.camera.kind == "none" or blind == "no_camera":
            return Means(growing_map=grows)
        detector = blind != "no_detector"
        return Means(camera=True, detector=detector, model=self.model, growing_map=grows)

    @property
    def searches(self) -> bool:
        """Tell whether the vision model may look for what the detector does not know."""
        return self.model and self.pictures.most > 0

    @property
    def views(self) -> int:
        """Return in how many directions to look for a whole turn."""
        fov_rad = self.camera.fov_rad if self.camera is not None else 1.0
        return max(3, ceil(2.0 * pi / (OVERLAP * fov_rad)))

    def should_see(self, pose: Pose2, at: tuple[float, float, float]) -> bool:
        """Tell whether a point is well inside the picture taken from a pose; walls are not asked.

        Pinhole: half the width spans half the field of view, half the height as many pixels as it
        has; a positive pitch looks down.
        """
        camera = self.camera
        if camera is None:
            return False
        c, s = cos(pose.yaw_rad), sin(pose.yaw_rad)
        dx, dy = at[0] - pose.x_m, at[1] - pose.y_m
        ahead, aside = c * dx + s * dy - camera.x_m, c * dy - s * dx - camera.y_m
        c, s = cos(camera.yaw_rad), sin(camera.yaw_rad)
        ahead, aside, up = c * ahead + s * aside, c * aside - s * ahead, at[2] - camera.z_m
        c, s = cos(camera.pitch_rad), sin(camera.pitch_rad)
        deep, up = c * ahead - s * up, c * up + s * ahead
        half = WELL_INSIDE * tan(camera.fov_rad / 2.0)
        if not camera.depth_min_m <= deep <= camera.depth_max_m:
            return False
        high = half * camera.height_px / camera.width_px
        return abs(aside) <= half * deep and abs(up) <= high * deep


NO_EYES = Eyesight()
NO_PICTURES = PictureLimits()
