"""Draw small things and people. The origin is where a thing touches what it stands on."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sim.camera.primitives import GeomPart, ball, block, rod, shade, tube

if TYPE_CHECKING:
    from sim.camera.materials import Coat
    from sim.site.classes import Size

_PAPER = (240.0, 236.0, 222.0)


def cup(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw a mug: body, dark inside, and a handle to the left."""
    radius, top = 0.4 * min(size[0], size[1]), size[2]
    grip = radius + 0.32 * radius
    thick = 0.055 * top
    return [
        tube((0.0, 0.0), (0.0, top), radius, coat.main),
        tube((0.0, 0.0), (top, top + 0.001), 0.85 * radius, shade(coat.main, 0.35)),
        rod((0.0, radius * 0.9, 0.8 * top), (0.0, grip, 0.72 * top), thick, coat.main),
        rod((0.0, grip, 0.72 * top), (0.0, grip, 0.35 * top), thick, coat.main),
        rod((0.0, grip, 0.35 * top), (0.0, radius * 0.9, 0.25 * top), thick, coat.main),
    ]


def toy_ball(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw a ball with a thin light band around it."""
    radius = min(size) / 2
    band = tube((0.0, 0.0), (0.93 * radius, 1.07 * radius), 1.002 * radius, coat.band)
    return [ball((0.0, 0.0, radius), radius, coat.main), band]


def bottle(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw body, label, shoulder, neck and cap."""
    radius, top = min(size[0], size[1]) / 2, size[2]
    return [
        tube((0.0, 0.0), (0.0, 0.58 * top), radius, coat.main),
        tube((0.0, 0.0), (0.18 * top, 0.42 * top), 1.01 * radius, coat.band),
        ball((0.0, 0.0, 0.58 * top), (radius, radius, 0.17 * top), coat.main),
        tube((0.0, 0.0), (0.6 * top, 0.93 * top), 0.36 * radius, coat.main),
        tube((0.0, 0.0), (0.9 * top, top), 0.44 * radius, coat.cap),
    ]


def book(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw two covers, a spine and the pages between; it lies, or stands when it is higher."""
    x, y, z = size[0] / 2, size[1] / 2, size[2]
    lid, spine = min(0.006, 0.15 * z), (-y, -y + 0.008)
    if size[2] > size[0]:  # upright: its covers look along x
        lid = min(0.006, 0.3 * x)
        covers = [block(c, (-y, y), (0.0, z), coat.main) for c in ((-x, -x + lid), (x - lid, x))]
        pages = block((-x + lid, x - lid), (-y + 0.008, y - 0.006), (0.005, z - 0.006), _PAPER)
        return [*covers, block((-x, x), spine, (0.0, z), coat.main), pages]
    title = block((-0.55 * x, -0.2 * x), (-0.6 * y, 0.6 * y), (z, z + 0.0008), coat.band)
    covers = [block((-x, x), (-y, y), c, coat.main) for c in ((0.0, lid), (z - lid, z))]
    pages = block((-x + 0.005, x - 0.005), (-y + 0.008, y - 0.005), (lid, z - lid), _PAPER)
    return [*covers, block((-x, x), spine, (0.0, z), coat.main), pages, title]


def carton(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw a box with tape over its middle and a label on its front."""
    x, y, z = size[0] / 2, size[1] / 2, size[2]
    tape = shade(coat.main, 1.45)
    wide = 0.08 * size[1]
    return [
        block((-x + 0.002, x - 0.002), (-y + 0.002, y - 0.002), (0.0, z - 0.002), coat.main),
        block((-x, x), (-wide, wide), (0.72 * z, z), tape),
        block((x - 0.003, x), (0.25 * y, 0.8 * y), (0.2 * z, 0.5 * z), _PAPER),
        block((-x + 0.002, x - 0.002), (-0.004, 0.004), (z - 0.002, z + 0.0005), coat.shade_color),
    ]


def door(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw a leaf in its frame, seen from both sides: panels, handles, a dark gap below."""
    x, y, top = size[0] / 2, size[1] / 2, size[2]
    inner, frame = y - 0.06, coat.light
    parts = [
        block((-x, x), (-y, -inner), (0.0, top), frame),
        block((-x, x), (inner, y), (0.0, top), frame),
        block((-x, x), (-inner, inner), (top - 0.06, top), frame),
        block((-x + 0.012, x - 0.012), (-inner, inner), (0.012, top - 0.06), coat.main),
    ]
    for side in (-1.0, 1.0):
        face = sorted((side * (x - 0.012), side * (x - 0.004)))
        for low, high in ((0.12, 0.42), (0.52, 0.92)):
            parts.append(
                block(
                    (face[0], face[1]),
                    (-0.72 * inner, 0.72 * inner),
                    (low * top, high * top),
                    coat.shade_color,
                )
            )
        grip = side * (x + 0.03)
        parts.append(ball((side * x, inner - 0.07, 0.5 * top), 0.028, coat.metal))
        parts.append(
            rod((grip, inner - 0.07, 0.5 * top), (grip, inner - 0.19, 0.5 * top), 0.012, coat.metal)
        )
    return parts


def person(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw shoes, legs, hips, a torso with arms, hands, a neck, a head with hair and a nose."""
    tall, wide = size[2] / 1.7, min(size[0], size[1]) / 0.5
    skin, trousers, shoe = coat.skin, coat.trousers, (48.0, 42.0, 40.0)
    parts = []
    for side in (-1.0, 1.0):
        hip, shoulder = side * 0.085 * wide, side * 0.19 * wide
        foot = sorted((hip - 0.045, hip + 0.045))
        parts += [
            block((-0.08, 0.15 * wide), (foot[0], foot[1]), (0.0, 0.07 * tall), shoe),
            rod((0.0, hip, 0.1 * tall), (0.0, hip, 0.8 * tall), 0.07 * wide, trousers),
            rod((0.0, shoulder, 1.36 * tall), (0.01, side * 0.205 * wide, 1.1 * tall), 0.045,
                coat.main),
            rod((0.01, side * 0.205 * wide, 1.1 * tall), (0.09, side * 0.195 * wide, 0.88 * tall),
                0.035, skin),
            ball((0.1, side * 0.195 * wide, 0.84 * tall), 0.043, skin),
        ]  # fmt: skip
    return [
        *parts,
        ball((0.0, 0.0, 0.86 * tall), (0.11 * wide, 0.155 * wide, 0.12 * tall), trousers),
        ball((0.0, 0.0, 1.14 * tall), (0.115 * wide, 0.165 * wide, 0.33 * tall), coat.main),
        rod((0.0, -0.14 * wide, 1.36 * tall), (0.0, 0.14 * wide, 1.36 * tall), 0.055, coat.main),
        tube((0.0, 0.0), (1.38 * tall, 1.5 * tall), 0.045, skin),
        ball((0.005, 0.0, 1.58 * tall), (0.088, 0.075, 0.115 * tall), skin),
        ball((-0.015, 0.0, 1.61 * tall), (0.088, 0.082, 0.1 * tall), coat.hair),
        ball((0.094, 0.0, 1.57 * tall), 0.016, skin),
    ]  # fmt: skip
