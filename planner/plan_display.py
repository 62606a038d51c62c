"""Tell the ROS 2 process what people may look at in RViz: way and places. Moves nothing."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from wire import PlaceView, PlanView, Status
from wire.nav2_dialogue import MAX_SHOWN

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.mission.engine import Leg
    from planner.mission.event_hub import Message
    from planner.site import Place

EVERY_S = 0.5


class PlanPublisher(Protocol):
    """Take what is to be shown."""

    def put(self, message: PlanView) -> None:
        """Send it; never waits."""


class PlanDisplay:
    """Listen to the missions' hub, and say twice a second what there is to see."""

    def __init__(
        self,
        publisher: PlanPublisher,
        leg: Callable[[], Leg | None],
        places: Callable[[], tuple[Place, ...]],
        clock: Callable[[], float],
    ) -> None:
        self._publisher, self._leg, self._places, self._clock = publisher, leg, places, clock
        self._said_s, self._seq = float("-inf"), 0

    def offer(self, message: Message) -> None:
        """Take the newest event; a status is the occasion to say what there is to see."""
        status, now_s = message[1].get("status"), self._clock()
        if isinstance(status, Status) and now_s - self._said_s >= EVERY_S:
            self._said_s = now_s
            self._seq += 1
            self._publisher.put(self._view(status))

    def close(self) -> None:
        """Hear no more."""

    def _view(self, status: Status) -> PlanView:
        leg = self._leg()
        points = () if leg is None else leg.points
        each = -(-len(points) // (MAX_SHOWN - 1)) or 1
        shown = [*points[:-1:each], *points[-1:]]
        return PlanView(
            seq=self._seq,
            mode=status.mode.value,
            held="" if status.held is None else status.held.reason.value,
            mission=None if leg is None else leg.mission,
            path=tuple((round(point.x_m, 3), round(point.y_m, 3)) for point in shown),
            places=tuple(
                PlaceView(name=place.name.en[:64], x_m=place.pose.x_m, y_m=place.pose.y_m)
                for place in self._places()[:MAX_SHOWN]
            ),
        )
