"""Put figures into words, in both languages."""

from __future__ import annotations

from math import degrees

from planner.language.catalogue import say
from planner.plan import Bilingual


def angle(radians: float) -> Bilingual:
    """Say an angle and its side."""
    amount = f"{abs(degrees(radians)):.0f}°"
    if radians < 0.0:
        return say("amount.turn_right", amount=amount)
    return say("amount.turn_left", amount=amount)


def metres(distance_m: float) -> Bilingual:
    """Say a distance and its direction."""
    amount = f"{abs(distance_m):.2f}"
    if distance_m < 0.0:
        return say("amount.backwards", amount=amount)
    return say("amount.forward", amount=amount)
