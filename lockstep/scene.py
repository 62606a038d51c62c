"""Load a site for a world once, however many worlds drive in it. Nothing here moves."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

from bridge.core.geometry.fence import FenceGrid
from bridge.fence_file import load_fence
from maps.growing_map import GROWING_MAP
from planner.navigation import RouteLimits
from planner.navigation.router import Router
from planner.plan import Vocabulary
from planner.site import Site
from planner.site.site_view import vocabulary_of
from pons_assets import SITES
from wire import RobotDescription

if TYPE_CHECKING:
    from pathlib import Path


@dataclass(frozen=True, slots=True)
class LockstepScene:
    """Hold one site as each part reads it from the same files."""

    folder: Path
    robot: RobotDescription
    site: Site
    vocabulary: Vocabulary
    fence: FenceGrid
    fence_hash: str
    router: Router

    @property
    def grows(self) -> bool:
        """Tell whether its map is made by driving."""
        return (self.folder / GROWING_MAP).is_file()


@lru_cache(maxsize=16)
def scene(folder: Path, robot: RobotDescription) -> LockstepScene:
    """Return the scene of a site's folder; routes depend on nothing else, so it may be shared."""
    site = Site.load(folder)
    fence, fence_hash = load_fence(folder / "fence.json")
    return LockstepScene(
        folder=folder,
        robot=robot,
        site=site,
        vocabulary=vocabulary_of(site),
        fence=fence,
        fence_hash=fence_hash,
        router=Router(site, RouteLimits.of(robot)),
    )


def folder_of(site: Path | str) -> Path:
    """Return a site's folder; a bare name is one of the checkout's own sites."""
    return SITES / site if isinstance(site, str) else site
