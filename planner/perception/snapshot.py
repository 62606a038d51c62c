"""Own the eyes' reports: detections in a picture, things on the map, one look whole. Data only.

Pixels: x right, y down, from the picture's upper left corner. Positions: metres in ``map``. Times:
``*_s`` on this planner's monotonic clock. No numpy: missions and routes read these too.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from wire import Pose2

Box = tuple[float, float, float, float]
"""Left, top, right, bottom [px]."""


@dataclass(frozen=True, slots=True)
class Detection:
    """Hold one thing that a detector found in one picture."""

    label: str
    """The class's id: lower case, words joined by ``_``."""
    score: float
    """0 to 1."""
    box: Box
    color: str | None = None
    """The id of its prevailing colour, where it has one."""
    depth_m: float | None = None
    """Along the optical axis, the median of the inner box; None where nothing was measured."""
    depth_spread_m: float = 0.0
    """Half the distance between the quartiles of what was measured there."""


@dataclass(frozen=True, slots=True)
class Thing:
    """Remember one thing on the map."""

    id: str
    """Minted here, the same for as long as it is remembered: ``cup_3``."""
    label: str
    color: str | None
    x_m: float
    y_m: float
    z_m: float
    """Height of its middle above the floor."""
    sigma_m: float
    """One standard deviation of where it stands, on the floor plane."""
    confidence: float
    """0 to 1: how sure we are that it is there at all."""
    seen_s: float
    """When it was seen last."""
    first_s: float
    sightings: int
    room: str | None = None
    """The room it lies in, where it lies in one."""


@dataclass(frozen=True, slots=True)
class LookSnapshot:
    """Report one picture that was thought upon."""

    seq: int
    """Of the picture, as the camera numbers them."""
    taken_s: float
    """When it was taken."""
    base_in_map: Pose2 | None
    """Where the robot was at that instant; None where it did not know."""
    width: int
    height: int
    detections: tuple[Detection, ...]
    here: tuple[str, ...] = ()
    """Ids of the things on the map that are in this picture, one per detection or ''."""


@dataclass(frozen=True, slots=True)
class Sight:
    """Hold perception's knowledge now: the newest look and all remembered things."""

    look: LookSnapshot | None = None
    things: tuple[Thing, ...] = ()
    blind: str | None = None
    """Why nothing is seen now (a stable code: ``no_camera``, ``no_detector``, ``camera_silent``,
    ``camera_frozen``, ``camera_unusable``, ``detector_down``, or what the detector was refused
    for); None while pictures are thought upon."""
