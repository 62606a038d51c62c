"""Say why a place can't be taught or forgotten, with a code that stays, in both languages."""

from __future__ import annotations

from planner.language.catalogue import say

CODES = frozenset(
    {
        "place_name_malformed",
        "place_name_mixed",
        "place_name_reserved",
        "place_name_taken",
        "places_full",
        "pose_unknown",
        "robot_moving",
        "map_mismatch",
        "other_map",
        "place_outside_map",
        "place_in_obstacle",
        "place_outside_fence",
        "place_unreachable",
        "route_unavailable",
        "unknown_room",
        "unknown_taught_place",
        "place_of_site",
        "disk_full",
        "places_unwritable",
    }
)
"""Every code; the catalogue has the sentence of each as ``taught_place.<code>``."""


class PlaceRefusal(Exception):
    """Refuse to teach or to forget; nothing changed."""

    def __init__(self, code: str, detail: str = "") -> None:
        """Keep the code and the sentence: the value, the expectation, the choices."""
        self.why = say(f"taught_place.{code}")
        en = self.why.en
        super().__init__(f"{code}: {en}" + (f" ({detail})" if detail else ""))
        self.code = code
        self.detail = detail or en
