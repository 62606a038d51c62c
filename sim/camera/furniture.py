"""Draw furniture that a person recognizes at a glance. Each piece stays in its outline.

Every function takes a size (depth, breadth, height) [m] and the coat of one piece and gives its
parts in the piece's own frame.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sim.camera.primitives import GeomPart, ball, block, rod, shade, tube, without_labels
from sim.site.classes import surface_m

if TYPE_CHECKING:
    from sim.camera.materials import Coat
    from sim.site.classes import Size


def _legs(x: float, y: float, top: float, thick: float, coat: Coat) -> list[GeomPart]:
    half = thick / 2
    return [
        block((px - half, px + half), (py - half, py + half), (0.0, top), coat.frame)
        for px in (-x + half, x - half)
        for py in (-y + half, y - half)
    ]


def chair(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw seat, four legs and a back of two posts and three slats; wide ones get arms."""
    x, y, seat = size[0] / 2, size[1] / 2, surface_m("chair", size[2])
    if min(size[0], size[1]) > 0.6:
        return _armchair(size, coat)
    parts = [block((-x, x), (-y, y), (seat - 0.05, seat), coat.main)]
    parts += _legs(x, y, seat - 0.05, 0.04, coat)
    back = (-x, -x + 0.035)
    parts += [
        block(back, (py - 0.02, py + 0.02), (seat, size[2]), coat.frame)
        for py in (-y + 0.02, y - 0.02)
    ]
    rise = size[2] - seat
    parts += [
        block(back, (-y + 0.04, y - 0.04), (seat + rise * low, seat + rise * high), coat.main)
        for low, high in ((0.30, 0.50), (0.58, 0.72), (0.80, 1.0))
    ]
    return parts


def _armchair(size: Size, coat: Coat) -> list[GeomPart]:
    x, y, seat = size[0] / 2, size[1] / 2, surface_m("chair", size[2])
    return [
        *_legs(x, y, 0.1, 0.05, coat),
        block((-x, x), (-y, y), (0.1, seat - 0.12), coat.shade_color),
        block((-x + 0.16, x), (-y + 0.14, y - 0.14), (seat - 0.12, seat), coat.light),
        block((-x, -x + 0.16), (-y, y), (seat - 0.12, size[2]), coat.main),
        *(
            block((-x + 0.16, x), side, (seat - 0.12, seat + 0.16), coat.main)
            for side in ((-y, -y + 0.13), (y - 0.13, y))
        ),
    ]


def sofa(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw base, back, arms and two seat and back cushions."""
    x, y, seat = size[0] / 2, size[1] / 2, surface_m("sofa", size[2])
    arm = min(0.2, 0.12 * size[1])
    back = -x + 0.28 * size[0]
    halves = ((-y + arm + 0.01, -0.01), (0.01, y - arm - 0.01))
    return [
        *_legs(x - 0.03, y - 0.03, 0.06, 0.06, coat),
        block((-x, x - 0.02), (-y + 0.02, y - 0.02), (0.06, seat - 0.13), coat.shade_color),
        block((-x, -x + 0.14), (-y + arm, y - arm), (seat - 0.13, size[2]), coat.main),
        *(block((back, x), side, (seat - 0.12, seat), coat.light) for side in halves),
        *(block((-x + 0.14, back), s, (seat - 0.12, size[2] - 0.06), coat.light) for s in halves),
        *(
            block((-x, x), side, (0.06, seat + 0.17), coat.main)
            for side in ((-y, -y + arm), (y - arm, y))
        ),
    ]


def table(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw a top on an apron and four legs."""
    x, y, top = size[0] / 2, size[1] / 2, size[2]
    return [
        block((-x, x), (-y, y), (top - 0.04, top), coat.main),
        block(
            (-x + 0.06, x - 0.06), (-y + 0.06, y - 0.06), (top - 0.11, top - 0.04), coat.shade_color
        ),
        *_legs(x - 0.03, y - 0.03, top - 0.04, 0.06, coat),
    ]


def round_table(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw a round top on one column and a foot."""
    radius, top = min(size[0], size[1]) / 2, size[2]
    return [
        tube((0.0, 0.0), (top - 0.04, top), radius, coat.main),
        tube((0.0, 0.0), (0.03, top - 0.04), 0.05, coat.frame),
        tube((0.0, 0.0), (0.0, 0.03), 0.55 * radius, coat.frame),
    ]


def bed(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw a frame, a white mattress, two pillows, a blanket over the foot and a headboard."""
    x, y, top = size[0] / 2, size[1] / 2, surface_m("bed", size[2])
    white, head = (238.0, 236.0, 230.0), -x + 0.07
    pillow = (head + 0.06, head + 0.06 + min(0.42, 0.25 * size[0]))
    count = 2 if size[1] > 1.2 else 1
    width = size[1] / count
    pillows = [
        block(
            pillow,
            (-y + i * width + 0.08, -y + (i + 1) * width - 0.08),
            (top, top + 0.10),
            (250.0, 250.0, 252.0),
        )
        for i in range(count)
    ]
    blanket = pillow[1] + 0.12
    return [
        block((-x, head), (-y, y), (0.0, size[2] + 0.45), coat.frame),
        block((head, x), (-y + 0.02, y - 0.02), (0.08, top - 0.2), coat.frame),
        *_legs(x, y, 0.08, 0.08, coat),
        block((head, x - 0.01), (-y + 0.03, y - 0.03), (top - 0.2, top), white),
        *pillows,
        block((blanket, x), (-y, y), (top - 0.19, top + 0.03), coat.main),
        block((blanket, blanket + 0.2), (-y, y), (top + 0.0, top + 0.05), coat.light),
    ]


def fridge(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw a tall body with two doors, the gap between them and two handles."""
    x, y, top = size[0] / 2, size[1] / 2, size[2]
    split, dark, handle = 0.66 * top, (60.0, 62.0, 66.0), (120.0, 124.0, 130.0)
    face = (x - 0.06, x - 0.03)
    return [
        block((-x, x - 0.06), (-y, y), (0.0, top), coat.shade_color),
        block((x - 0.06, x - 0.045), (-y + 0.01, y - 0.01), (0.06, top), dark),
        block(face, (-y, y), (0.08, split - 0.01), coat.main),
        block(face, (-y, y), (split + 0.01, top), coat.main),
        block((x - 0.03, x), (-y + 0.05, -y + 0.085), (split - 0.5, split - 0.06), handle),
        block((x - 0.03, x), (-y + 0.05, -y + 0.085), (split + 0.06, split + 0.4), handle),
    ]


def tv(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw a dark screen in a thin frame on a low cabinet; only the screen is the television."""
    base = size[2] if size[2] <= 0.7 else 0.42 * size[2]
    height = 0.62 if size[2] <= 0.7 else size[2] - base
    return [
        *without_labels(cabinet((size[0], size[1], base), coat)),
        *screen((size[0], min(size[1], 1.75 * height), height), coat, base),
    ]


def screen(size: Size, coat: Coat, base: float = 0.0) -> list[GeomPart]:
    """Draw a television without its stand: a foot and a screen."""
    y, low, top = size[1] / 2, base + 0.05, base + size[2]
    foot = min(0.1, size[0] / 2)
    edge = 0.015
    return [
        block((-foot, foot), (-0.3 * y, 0.3 * y), (base, base + 0.015), coat.black),
        block((-0.02, 0.01), (-0.06, 0.06), (base, low), coat.black),
        block((-0.03, 0.015), (-y, y), (low, top), coat.black),
        block((0.0, 0.02), (-y + edge, y - edge), (low + edge, top - edge), coat.glass),
    ]


def plant(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw a pot with earth, a stem and a bush of leaves in three greens."""
    radius, top = min(size[0], size[1]) / 2, size[2]
    pot = min(0.34 * top, 0.4)
    leaf = coat.leaf
    parts = [
        tube((0.0, 0.0), (0.0, 0.75 * pot), 0.55 * radius, coat.pot),
        tube((0.0, 0.0), (0.75 * pot, pot), 0.68 * radius, coat.pot),
        tube((0.0, 0.0), (pot, pot + 0.004), 0.58 * radius, (70.0, 50.0, 38.0)),
        rod((0.0, 0.0, pot), (0.0, 0.0, 0.7 * top), 0.06 * radius + 0.005, (96.0, 120.0, 60.0)),
    ]
    middle, rise = (top + pot) / 2, (top - pot) / 2
    ring = ((0.55, 0.1), (0.2, 0.55), (-0.4, 0.42), (-0.55, -0.2), (-0.05, -0.58), (0.45, -0.4))
    for index, (dx, dy) in enumerate(ring):
        green = shade(leaf, (0.75, 1.0, 1.15)[index % 3])
        high = middle + rise * (-0.35, 0.1, 0.45)[index % 3]
        at = (dx * radius, dy * radius, high)
        parts.append(ball(at, (0.42 * radius, 0.42 * radius, 0.5 * rise), green))
    parts.append(
        ball((0.0, 0.0, middle + 0.45 * rise), (0.5 * radius, 0.5 * radius, 0.55 * rise), leaf)
    )
    return parts


def cabinet(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw a body with doors and knobs: any piece that no class names."""
    x, y, top = size[0] / 2, size[1] / 2, size[2]
    count = max(1, round(size[1] / 0.55))
    width = size[1] / count
    parts = [
        block((-x, x - 0.02), (-y, y), (0.0, top - 0.03), coat.shade_color),
        block((-x, x), (-y, y), (top - 0.03, top), coat.main),
    ]
    for index in range(count):
        low, high = -y + index * width + 0.01, -y + (index + 1) * width - 0.01
        knob = high - 0.06 if index % 2 == 0 else low + 0.06
        parts.append(block((x - 0.02, x - 0.005), (low, high), (0.05, top - 0.05), coat.main))
        parts.append(ball((x - 0.015, knob, 0.6 * top), 0.015, coat.metal))
    return parts
