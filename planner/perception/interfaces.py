"""Define perception's interface, and its demands on a detector. Protocols and data only.

Missions, routes and lockstep stand behind these, so that no test needs a camera or a model.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from planner.perception.snapshot import LookResult, Sight

if TYPE_CHECKING:
    from collections.abc import Callable

    from wire import Image


@dataclass(frozen=True, slots=True)
class Picture:
    """Hold one picture as it came, with its depth where there is some."""

    color: Image
    depth: Image | None
    taken_s: float
    """On this planner's clock; never later than when it came."""


@dataclass(frozen=True, slots=True)
class MapPoint:
    """Name a point of the world that a pixel shows."""

    x_m: float
    y_m: float
    """In ``map``."""
    z_m: float
    sigma_m: float


class PointRefusal(Exception):
    """A pixel leads to no point that one can drive up to; ``code`` is stable.

    ``point_no_pose``, ``point_no_depth``, ``point_too_far``, ``point_on_wall``, ``point_off_map``.
    """

    def __init__(self, code: str, detail: str = "") -> None:
        super().__init__(f"{code}: {detail}" if detail else code)
        self.code = code


class Eyes(Protocol):
    """Define perception for its users. All but ``spot`` answer at once."""

    @property
    def sight(self) -> Sight:
        """Return the newest look and all that is remembered."""

    @property
    def classes(self) -> tuple[str, ...]:
        """Return the class ids that can be seen now; none where nothing can be."""

    @property
    def open_classes(self) -> tuple[str, ...]:
        """Return those of these that a wide look alone finds."""

    @property
    def picture(self) -> Picture | None:
        """Return the newest picture; None before one came, and while nobody wants any."""

    @property
    def looked_picture(self) -> Picture | None:
        """Return the picture of the newest look; None before there was one."""

    async def fresh(self) -> Picture | None:
        """Return the newest picture; where nobody wanted any so far, wait a moment for one."""

    def listen(self, told: Callable[[Sight], None]) -> None:
        """Have something called after each look and when ``blind`` changes. It must be quick."""

    def attend(self, who: str, wanted: bool, *, wide: bool = False) -> None:
        """Say that somebody needs eyes now, or no longer: looks come at the full rate meanwhile.

        While somebody needs wide ones, each look is one; they may come slower.
        """

    async def spot(self, picture: Picture, x: float, y: float) -> MapPoint:
        """Return the point of the map at a point of a picture (x right, y down, each 0 to 1000).

        Raises:
            PointRefusal: nothing there can be driven up to.
        """


class Detector(Protocol):
    """Find things in pictures, in a process of its own."""

    @property
    def classes(self) -> tuple[str, ...]:
        """Return the ids of the known classes; none until it is ready."""

    @property
    def open_classes(self) -> tuple[str, ...]:
        """Return the ids of the classes that a wide look alone finds."""

    async def look(self, color: Image, depth: Image | None, *, wide: bool = False) -> LookResult:
        """Think upon one picture. Never raises for its content.

        Raises:
            VisionFailure: the detector itself is down, or there is none.
        """

    async def depth_at(self, depth: Image, u_px: float, v_px: float) -> float | None:
        """Return the depth measured around a pixel [m]; None where nothing was."""
