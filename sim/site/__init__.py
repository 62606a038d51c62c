"""Make a site from one declaration, home.yaml, so that map, places, fence and world agree."""

from sim.site.files import FENCE_JSON, MAP_PGM, MAP_YAML, PLACES_YAML, site_files
from sim.site.generated_check import check_fresh, stale, write
from sim.site.load import load_home, parse_home
from sim.site.plan import solids
from sim.site.shapes import Disc, Rect, Shape, Solid
from sim.site.spec import Home, pose2

__all__ = [
    "FENCE_JSON",
    "MAP_PGM",
    "MAP_YAML",
    "PLACES_YAML",
    "Disc",
    "Home",
    "Rect",
    "Shape",
    "Solid",
    "check_fresh",
    "load_home",
    "parse_home",
    "pose2",
    "site_files",
    "solids",
    "stale",
    "write",
]
