"""Give the router of the map as it is known and drawn on now, as the route process does."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.navigation import RouteLimits
from planner.navigation.process_main import GrowingRouter
from planner.navigation.router import Router

if TYPE_CHECKING:
    from collections.abc import Callable

    from lockstep.scene import LockstepScene
    from planner.site import KnownPlaces


class MarkedRouter:
    """Give the router of the map less what people drew on it, as the route process does."""

    def __init__(self, scene: LockstepScene) -> None:
        self._scene, self._router = scene, scene.router
        self.places: KnownPlaces | None = None
        """Of the planner; no closure, which a copy of the world would not take along."""
        self._fence = scene.site.fence

    def __call__(self) -> Router:
        """Return the router of now."""
        site = self.places.site if self.places is not None else self._scene.site
        if site.fence.record != self._fence.record:
            self._router, self._fence = Router(site, RouteLimits.of(self._scene.robot)), site.fence
        return self._router


def routers_of(scene: LockstepScene) -> Callable[[], Router]:
    """Return what gives the router of the map as it is known now."""
    if not scene.grows:
        return MarkedRouter(scene)
    growing = GrowingRouter(scene.site, RouteLimits.of(scene.robot))
    return lambda: growing.router


def note_places(newest: Callable[[], Router], places: KnownPlaces) -> None:
    """Let a router follow what is drawn on the map that a planner knows."""
    if isinstance(newest, MarkedRouter):
        newest.places = places
