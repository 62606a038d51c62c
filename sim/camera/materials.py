"""Choose the colours of one thing: as its home declares, else as such things often have.

Seeded by appearance and id, so that the same home looks the same every time.
"""

from __future__ import annotations

from dataclasses import dataclass
from random import Random
from typing import TYPE_CHECKING, Final

from sim.camera.primitives import Rgb, shade

if TYPE_CHECKING:
    from sim.camera.surfaces import Appearance

PAINTS: Final[dict[str, Rgb]] = {
    "red": (196, 34, 36), "orange": (232, 122, 26), "yellow": (236, 200, 44),
    "green": (46, 140, 62), "blue": (36, 84, 188), "purple": (120, 58, 150),
    "pink": (236, 140, 172), "brown": (122, 80, 48), "black": (32, 32, 36),
    "gray": (132, 134, 138), "white": (238, 238, 236),
}  # fmt: skip
"""The middle of what people call so."""

_WOODS: Final[tuple[Rgb, ...]] = (
    (150, 104, 62), (122, 80, 48), (186, 142, 94), (96, 62, 42), (206, 172, 128), (220, 218, 212),
)  # fmt: skip
_CLOTHS: Final[tuple[Rgb, ...]] = (
    (92, 104, 124), (120, 116, 110), (140, 60, 52), (70, 96, 84), (176, 160, 138), (60, 64, 84),
    (150, 128, 60), (104, 76, 110), (54, 54, 58), (196, 190, 180),
)  # fmt: skip
_BRIGHT: Final[tuple[Rgb, ...]] = tuple(PAINTS.values())
_METALS: Final[tuple[Rgb, ...]] = ((232, 233, 235), (176, 180, 186), (70, 74, 80), (214, 206, 190))
USUAL: Final[dict[str, tuple[Rgb, ...]]] = {
    "chair": _WOODS + _CLOTHS[:4], "armchair": _CLOTHS, "sofa": _CLOTHS, "table": _WOODS,
    "bed": _CLOTHS, "tv": _WOODS, "fridge": _METALS, "plant": _WOODS, "none": _WOODS,
    "door": _WOODS, "box": ((178, 138, 92), (160, 120, 78), (196, 160, 116)),
    "person": _CLOTHS + _BRIGHT, "cup": _BRIGHT, "ball": _BRIGHT, "bottle": _BRIGHT,
    "book": _BRIGHT,
}  # fmt: skip
"""What things of a class are painted when nobody says; the first is the plain look's."""
_SKINS: Final[tuple[Rgb, ...]] = ((222, 178, 148), (190, 138, 104), (138, 92, 66), (240, 204, 178))
_HAIRS: Final[tuple[Rgb, ...]] = ((52, 38, 30), (28, 26, 26), (140, 100, 56), (168, 164, 160))
_TROUSERS: Final[tuple[Rgb, ...]] = ((44, 52, 78), (60, 58, 56), (104, 92, 74), (30, 30, 34))
_POTS: Final[tuple[Rgb, ...]] = ((176, 92, 60), (226, 222, 214), (92, 96, 104), (60, 84, 120))


@dataclass(frozen=True, slots=True)
class Coat:
    """Hold the colours of one thing, by their use."""

    main: Rgb
    frame: Rgb
    pot: Rgb
    leaf: Rgb
    skin: Rgb
    hair: Rgb
    trousers: Rgb
    band: Rgb
    glass: Rgb
    black: Rgb = (34.0, 34.0, 38.0)
    metal: Rgb = (168.0, 170.0, 174.0)

    @property
    def shade_color(self) -> Rgb:
        """Return the main colour, a little darker."""
        return shade(self.main, 0.82)

    @property
    def light(self) -> Rgb:
        """Return the main colour a little lighter."""
        return shade(self.main, 1.14)

    @property
    def cap(self) -> Rgb:
        """Return the colour of a bottle's cap."""
        return shade(self.main, 0.55)


def coat(look: Appearance, thing_id: str, class_id: str, color: str | None) -> Coat:
    """Choose the colours of one thing."""
    random = Random(f"{look.seed} {thing_id}")
    usual = USUAL.get(class_id, _WOODS)
    main = PAINTS[color] if color is not None else _choose(look, random, usual)
    bright = sum(main) > 3 * 190
    return Coat(
        main=_vary(look, random, main),
        frame=_vary(look, random, _choose(look, random, _WOODS)),
        pot=_vary(look, random, _choose(look, random, _POTS)),
        leaf=_vary(look, random, (58.0, 128.0, 58.0)),
        skin=_vary(look, random, _choose(look, random, _SKINS)),
        hair=_vary(look, random, _choose(look, random, _HAIRS)),
        trousers=_vary(look, random, _choose(look, random, _TROUSERS)),
        band=shade(main, 0.7) if bright else (240.0, 238.0, 232.0),
        glass=_vary(look, random, (18.0, 20.0, 28.0)),
    )


def _choose(look: Appearance, random: Random, options: tuple[Rgb, ...]) -> Rgb:
    drawn = random.choice(options)  # drawn in any case: what follows stays the same
    return drawn if look.mixed else options[0]


def _vary(look: Appearance, random: Random, paint: Rgb) -> Rgb:
    """Vary lightness most, hue a little; a red thing stays red."""
    light = 1.0 + look.spread * random.uniform(-0.25, 0.18)
    red, green, blue = (
        min(255.0, max(0.0, channel * light + look.spread * random.uniform(-10.0, 10.0)))
        for channel in paint
    )
    return red, green, blue
