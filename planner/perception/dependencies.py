"""Hold what eyes are made of. Data only."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from planner.perception.frame_source import Camera
    from planner.perception.frame_update import Scenery
    from planner.perception.interfaces import Detector
    from planner.perception.object_store import ThingStore
    from planner.perception.pose_buffer import Poses


@dataclass(frozen=True, slots=True)
class PerceptionParts:
    """Hold what eyes are made of."""

    scenery: Scenery
    camera: Camera
    detector: Detector | None
    poses: Poses
    store: ThingStore | None = None
    has_model: bool = True
    """The detector has something to detect with, as far as is known before it starts."""
    rate_hz: float = 10.0
    """Of looks, while somebody needs eyes."""
