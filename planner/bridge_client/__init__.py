"""Be the planner's one way to the bridge. The door of this package.

For the API's handlers (``link`` is ``missions.link``):

- ``link.status -> Aged[Status] | None`` (``.value``, ``.age_s``), likewise ``localization``,
  ``odometry``, ``scan``; ``link.obstacles()`` gives lidar points in ``map``.
- ``await link.operate(kind, request) -> wire.Answer``: arm, disarm, estop, reset, resume, repeated
  until echoed; raises ``BridgeSilent`` after 2 s. ``answer.accepted`` is the verdict.
- Requests come signed: the API's handlers sign for a virtual drive, and relay a person's own proof
  otherwise. Nothing here can make a proof.
- ``await link.stop(source) -> StopResult``: never refused, never raises; but handlers call
  ``missions.stop`` so that the missions hear it too.
- ``link.teleop(wire.Velocity)``.
- ``link.tell(follower)``: all odometry and localization as it comes, for whoever keeps a history.

``LinkError`` carries ``code`` and ``message`` = {"en", "zh"}.
"""

from planner.bridge_client.client import Aged, Follower, Link, StopResult
from planner.bridge_client.errors import BridgeSilent, LinkError
from planner.bridge_client.ownership import (
    STANDING,
    Course,
    Identity,
    OwnerState,
    on_course,
    on_status,
    owns,
)
from planner.bridge_client.transport import Bus, WireBus

__all__ = [
    "STANDING",
    "Aged",
    "BridgeSilent",
    "Bus",
    "Course",
    "Follower",
    "Identity",
    "Link",
    "LinkError",
    "OwnerState",
    "StopResult",
    "WireBus",
    "on_course",
    "on_status",
    "owns",
]
