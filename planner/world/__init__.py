"""Know a site: its map, its rooms and places, its fence. The one door of this package."""

from planner.world.errors import SiteError
from planner.world.fence import Fence, SpeedZone
from planner.world.fence_check import FenceRefused, check_fence
from planner.world.fence_diff import FenceDiff, fence_diff
from planner.world.fence_store import FenceProposal, FenceProposals
from planner.world.grid import FREE, OCCUPIED, UNKNOWN, GridMap
from planner.world.map_file import LoadedMap, load_map
from planner.world.places import Place, normalised
from planner.world.site import Site
from planner.world.taught import MAX_HERE, TaughtPlace, TaughtPlaces
from planner.world.taught_check import check_spot, plain_name
from planner.world.taught_errors import PlaceRefused

__all__ = [
    "FREE",
    "MAX_HERE",
    "OCCUPIED",
    "UNKNOWN",
    "Fence",
    "FenceDiff",
    "FenceProposal",
    "FenceProposals",
    "FenceRefused",
    "GridMap",
    "LoadedMap",
    "Place",
    "PlaceRefused",
    "Site",
    "SiteError",
    "SpeedZone",
    "TaughtPlace",
    "TaughtPlaces",
    "check_fence",
    "check_spot",
    "fence_diff",
    "load_map",
    "normalised",
    "plain_name",
]
