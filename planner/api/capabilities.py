"""Serve what this robot can do, so that whoever has several can tell which one to send."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fastapi import APIRouter

from planner.brain import mind_of
from planner.plan import Frozen, Language
from pons_assets.version import version_number
from wire import PROTOCOL

if TYPE_CHECKING:
    from planner.api.interfaces import Services


class Capabilities(Frozen):
    """Show what does not change while a robot runs, but for its places, its eyes and its brain."""

    release: str
    """The version of Pons."""
    wire_protocol: int
    robot_id: str
    robot_hash: str
    """Of robot.toml: two robots with the same one are built alike."""
    site: str
    map_id: str
    """Of the map's content: a place on two robots with the same one is the same spot."""
    places: tuple[dict[str, Any], ...]
    steps: tuple[str, ...]
    """The kinds of steps that a plan for this robot may hold now."""
    camera: str | None
    """Its kind; None: it sees nothing."""
    recognises: tuple[str, ...]
    """What the detector has a class for."""
    languages: tuple[Language, ...]
    """That orders may be written in."""
    hears: tuple[Language, ...]
    """That spoken orders may be in."""
    brain: str
    radius_m: float
    max_speed_mps: float


def routes(services: Services) -> APIRouter:
    """Return the route of what the robot can do."""
    router = APIRouter(prefix="/v1", tags=["robot"])

    @router.get("/capabilities", operation_id="get_capabilities")
    async def capabilities() -> Capabilities:
        """Tell what this robot can do: places, steps, eyes, languages, version, map."""
        robot = services.robot.description
        return Capabilities(
            release=version_number(),
            wire_protocol=PROTOCOL,
            robot_id=robot.id,
            robot_hash=robot.hash,
            site=services.site.folder.name,
            map_id=services.site.map_id,
            places=tuple(place.model_dump(mode="json") for place in services.memory.places),
            steps=tuple(sorted(services.goals.means.plannable)),
            camera=robot.camera.kind if services.goals.means.camera else None,
            recognises=tuple(services.eyes.classes),
            languages=tuple(Language),
            hears=services.voice.languages,
            brain=mind_of(services.brain).name,
            radius_m=robot.base.radius_m,
            max_speed_mps=robot.limits.max_speed_mps,
        )

    return router
