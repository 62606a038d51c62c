"""Make the parts of every drawn thing: boxes, tubes, balls and rods with a colour.

A thing's own frame: origin on the floor under its middle, x where its front looks, y to its left,
z up; metres. Knows no home and no MuJoCo model beyond how a geom is written.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

Rgb = tuple[float, float, float]
"""Red, green, blue, 0 to 255."""


@dataclass(frozen=True, slots=True)
class GeomPart:
    """Hold one geom: its form and size as MJCF writes them, and its colour."""

    form: str
    paint: Rgb
    labelled: bool = True
    """False: it belongs to the thing but not to what its class names, as a television's stand."""


def block(
    x: tuple[float, float], y: tuple[float, float], z: tuple[float, float], paint: Rgb
) -> GeomPart:
    """Fill a box between two values along each axis."""
    half = [_text((high - low) / 2) for low, high in (x, y, z)]
    middle = [_text((high + low) / 2) for low, high in (x, y, z)]
    return GeomPart(f'type="box" size="{" ".join(half)}" pos="{" ".join(middle)}"', paint)


def tube(at: tuple[float, float], z: tuple[float, float], radius_m: float, paint: Rgb) -> GeomPart:
    """Stand a cylinder up."""
    size = f"{_text(radius_m)} {_text((z[1] - z[0]) / 2)}"
    pos = f"{_text(at[0])} {_text(at[1])} {_text((z[0] + z[1]) / 2)}"
    return GeomPart(f'type="cylinder" size="{size}" pos="{pos}"', paint)


def ball(
    at: tuple[float, float, float], radii_m: tuple[float, float, float] | float, paint: Rgb
) -> GeomPart:
    """Place a ball, or an egg with three radii."""
    radii = radii_m if isinstance(radii_m, tuple) else (radii_m,) * 3
    kind = "ellipsoid" if isinstance(radii_m, tuple) else "sphere"
    size = " ".join(map(_text, radii if kind == "ellipsoid" else radii[:1]))
    return GeomPart(f'type="{kind}" size="{size}" pos="{" ".join(map(_text, at))}"', paint)


def rod(
    start: tuple[float, float, float],
    end: tuple[float, float, float],
    radius_m: float,
    paint: Rgb,
) -> GeomPart:
    """Lay a round-ended rod from one point to another."""
    ends = " ".join(map(_text, (*start, *end)))
    return GeomPart(f'type="capsule" size="{_text(radius_m)}" fromto="{ends}"', paint)


def without_labels(parts: list[GeomPart]) -> list[GeomPart]:
    """Return them as belonging to the thing but not to its class."""
    return [replace(part, labelled=False) for part in parts]


def shade(paint: Rgb, factor: float) -> Rgb:
    """Return a colour darker (below 1) or lighter (towards white above 1)."""
    if factor <= 1.0:
        red, green, blue = (channel * factor for channel in paint)
    else:
        red, green, blue = (channel + (255.0 - channel) * (factor - 1.0) for channel in paint)
    return red, green, blue


def _text(value: float) -> str:
    # MuJoCo refuses a size of zero: nothing drawn is thinner than a fifth of a millimetre.
    return f"{value if abs(value) >= 1e-4 else 0.0:.5g}" if value <= 0.0 else f"{value:.5g}"
