"""Put figures into words, in both languages."""

from __future__ import annotations

import re
from math import degrees
from typing import TYPE_CHECKING

from planner.language.catalogue import say

if TYPE_CHECKING:
    from planner.plan import Bilingual

_OWN_NAME = re.compile(r"[^a-z]|(?:the|my|our|where)\b|\S+['’]s? ")
"""A name that takes no article in English: one in capitals, or with an owner in it."""


def definite(name: Bilingual) -> Bilingual:
    """Return a known place's or thing's name: ``the kitchen``, ``Anna's room``."""
    return name if _OWN_NAME.match(name.en) else say("order.the", object=name)


def angle(radians: float) -> Bilingual:
    """Say an angle and its side."""
    code = "amount.turn_right" if radians < 0.0 else "amount.turn_left"
    return say(code, angle_deg=abs(degrees(radians)))


def metres(distance_m: float) -> Bilingual:
    """Say a distance and its direction."""
    code = "amount.backwards" if distance_m < 0.0 else "amount.forward"
    return say(code, distance_m=abs(round(distance_m, 2)))  # a hair's breadth is 0, and no 2e-05
