"""Put figures into words, in both languages."""

from __future__ import annotations

from math import degrees

from planner.language.catalogue import say
from planner.plan import Bilingual


def angle(radians: float) -> Bilingual:
    """Say an angle and its side."""
    code = "amount.turn_right" if radians < 0.0 else "amount.turn_left"
    return say(code, angle_deg=abs(degrees(radians)))


def metres(distance_m: float) -> Bilingual:
    """Say a distance and its direction."""
    code = "amount.backwards" if distance_m < 0.0 else "amount.forward"
    return say(code, distance_m=abs(distance_m))
