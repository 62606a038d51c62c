"""Read maps: the ground that planner, localization and simulator share. The one door of reading.

Knows Nav2's format and cells; no robot, no routes, no sockets. The bridge knows a map by its
fingerprint alone and stays free of this package (:mod:`wire.site_map`).
"""

from maps.errors import SiteError
from maps.grid import FREE, OCCUPIED, UNKNOWN, GridMap
from maps.map_file import LoadedMap, MapRecord, load_map

__all__ = [
    "FREE",
    "OCCUPIED",
    "UNKNOWN",
    "GridMap",
    "LoadedMap",
    "MapRecord",
    "SiteError",
    "load_map",
]
