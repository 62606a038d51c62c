"""Know a site: its map, its rooms and places, its fence. The one door of this package."""

from maps import FREE, OCCUPIED, UNKNOWN, GridMap, LoadedMap, SiteError, load_map
from planner.site.fence import Fence, SpeedZone
from planner.site.fence_check import FenceRefusal, check_fence
from planner.site.fence_diff import FenceDiff, fence_diff
from planner.site.fence_store import FenceProposal, FenceProposals
from planner.site.known_places import KeptPlace, KnownPlaces, Lesson
from planner.site.places import Place, normalise, owner_of
from planner.site.site import Site
from planner.site.site_view import SiteView, Target, facts_of, vocabulary_of
from planner.site.taught_place_check import check_not_order, check_spot, plain_name, reserved_names
from planner.site.taught_place_errors import PlaceRefusal
from planner.site.taught_places import MAX_HERE, TaughtPlace, TaughtPlaces

__all__ = [
    "FREE",
    "MAX_HERE",
    "OCCUPIED",
    "UNKNOWN",
    "Fence",
    "FenceDiff",
    "FenceProposal",
    "FenceProposals",
    "FenceRefusal",
    "GridMap",
    "KeptPlace",
    "KnownPlaces",
    "Lesson",
    "LoadedMap",
    "Place",
    "PlaceRefusal",
    "Site",
    "SiteError",
    "SiteView",
    "SpeedZone",
    "Target",
    "TaughtPlace",
    "TaughtPlaces",
    "check_fence",
    "check_not_order",
    "check_spot",
    "facts_of",
    "fence_diff",
    "load_map",
    "normalise",
    "owner_of",
    "plain_name",
    "reserved_names",
    "vocabulary_of",
]
