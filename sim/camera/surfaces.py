"""Define the look of a home: light, floors, walls, colours, noise.

All that training varies is here, drawn from one seed.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians, sin
from random import Random
from typing import Final, Literal

from sim.camera.primitives import Rgb

Weave = Literal["plain", "checker", "planks", "stripes"]


@dataclass(frozen=True, slots=True)
class Texture:
    """Cover a floor or a wall: a weave of two colours, its scale and its turn."""

    weave: Weave
    first: Rgb
    second: Rgb
    scale_m: float = 0.3
    turn_rad: float = 0.0


_PLAIN_FLOORS: Final = (
    Texture("planks", (176, 138, 98), (160, 122, 84), 0.16),
    Texture("checker", (206, 204, 198), (172, 172, 170), 0.33),
    Texture("planks", (150, 112, 78), (136, 100, 68), 0.14),
    Texture("plain", (168, 160, 148), (168, 160, 148)),
)
_PLAIN_WALLS: Final = (
    Texture("plain", (222, 218, 206), (222, 218, 206)),
    Texture("plain", (206, 214, 218), (206, 214, 218)),
)


@dataclass(frozen=True, slots=True)
class Appearance:
    """Hold one look of the scene. The plain one is the simulator's."""

    seed: int = 0
    light: tuple[float, float, float] = (0.42, 0.30, 0.86)
    """Towards the lamp, a unit vector in ``map``."""
    key: float = 0.42
    """Of the lamp; ambient and sky make the rest of a white wall's brightness."""
    ambient: float = 0.46
    sky: float = 0.16
    """What comes from above, whatever the lamp does."""
    tint: Rgb = (1.0, 1.0, 1.0)
    floors: tuple[Texture, ...] = _PLAIN_FLOORS
    walls: tuple[Texture, ...] = _PLAIN_WALLS
    ceiling: Rgb = (240.0, 240.0, 238.0)
    skirting: Rgb = (246.0, 246.0, 244.0)
    spread: float = 0.0
    """How far colours vary around their names: 0 not at all, 1 much."""
    mixed: bool = False
    """Whether things that nobody painted differ from home to home."""
    noise: float = 1.0
    """Of the camera, times its usual."""

    @classmethod
    def random(cls, seed: int) -> Appearance:
        """Draw a look for training."""
        random = Random(f"look {seed}")
        turn, rise = random.uniform(0.0, radians(360)), random.uniform(radians(25), radians(85))
        return cls(
            seed=seed,
            light=(cos(turn) * cos(rise), sin(turn) * cos(rise), sin(rise)),
            key=random.uniform(0.15, 0.6),
            ambient=random.uniform(0.25, 0.6),
            sky=random.uniform(0.05, 0.25),
            tint=(
                random.uniform(0.88, 1.08),
                random.uniform(0.95, 1.03),
                random.uniform(0.85, 1.1),
            ),
            floors=tuple(_floor(random) for _ in range(4)),
            walls=tuple(_wall(random) for _ in range(4)),
            ceiling=_gray(random, 190, 250),
            skirting=_gray(random, 60, 250),
            spread=random.uniform(0.2, 1.0),
            mixed=True,
            noise=random.uniform(0.3, 2.5),
        )


def _gray(random: Random, low: float, high: float) -> Rgb:
    level = random.uniform(low, high)
    return level, level + random.uniform(-8, 5), level + random.uniform(-16, 6)


def _near(random: Random, paint: Rgb, by: float) -> Rgb:
    red, green, blue = (min(255.0, max(0.0, c + random.uniform(-by, by))) for c in paint)
    return red, green, blue


def _floor(random: Random) -> Texture:
    weave: Weave = random.choice(("plain", "checker", "planks", "planks", "stripes"))
    wood = (random.uniform(70, 200), random.uniform(60, 160), random.uniform(50, 130))
    first = random.choice((wood, _gray(random, 60, 220), _near(random, (140, 140, 140), 80)))
    second = _near(random, first, 40)
    return Texture(weave, first, second, random.uniform(0.08, 0.6), random.choice((0.0, 1.5708)))


def _wall(random: Random) -> Texture:
    weave: Weave = random.choice(("plain", "plain", "plain", "stripes", "checker"))
    first = random.choice((_gray(random, 150, 250), _near(random, (190, 190, 190), 60)))
    return Texture(weave, first, _near(random, first, 18), random.uniform(0.1, 0.8))
