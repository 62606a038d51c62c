"""Put figures into words, in both languages."""

from __future__ import annotations

from math import degrees

from planner.plan import Bilingual


def angle(radians: float) -> Bilingual:
    """Say an angle and its side."""
    amount = f"{abs(degrees(radians)):.0f}°"
    if radians < 0.0:
        return Bilingual(en=f"{amount} to the right", zh=f"右转 {amount}")
    return Bilingual(en=f"{amount} to the left", zh=f"左转 {amount}")


def metres(distance_m: float) -> Bilingual:
    """Say a distance and its direction."""
    amount = f"{abs(distance_m):.2f}"
    if distance_m < 0.0:
        return Bilingual(en=f"{amount} m backwards", zh=f"后退 {amount} 米")
    return Bilingual(en=f"{amount} m forward", zh=f"前进 {amount} 米")
