"""Own what is known of each class by itself: how large it is, whether it walks.

What it is called stands in the catalogue, under ``noun``. One table: the classes of the default
model first, then what detectors trained on COCO's 80 classes add (Lin et al. 2014; their names are
facts). Sizes are of ordinary things, to the nearest handful of centimetres; they say where a middle
lies behind what is seen, and from how far a miss counts.
"""

from __future__ import annotations

from dataclasses import dataclass

LARGE_M = 0.5
"""Things of at least this reach show by their sides, and may show as two boxes."""
READ_BEHIND_M, CUT_SHARE = 0.1, 0.8
"""The depth of what is large is read somewhat behind its front edge, on its seat or its top, and
still farther in where it is cut off. In 681 looks at large things of drawn homes their middles lay
0.04 to 0.34 m nearer than without, by class and cut."""
MIDDLE = (0.25, 0.25, 0.75, 0.75)
"""The part of a box that is most surely the thing: left, top, right, bottom, as shares."""
ENOUGH = 0.3
"""Share of that part which the thing has at least: a leg or a leaf before it has less."""


@dataclass(frozen=True, slots=True)
class Kind:
    """Describe one class."""

    id: str
    reach_m: float = 0.15
    """Half of its greatest extent on the floor plane."""
    behind_m: float = 0.10
    """How far its middle lies behind the surface that is seen, from its broad side."""
    height_m: float = 0.30
    perched: bool = False
    """It often stands on something: the foot of its box need not be on the floor."""
    mobile: bool = False
    """It walks by itself."""
    least_m: tuple[float, float] = (0.0, 0.0)
    """Width and height that every one of it has; 0 where that is not known."""

    part: tuple[float, float, float, float] = MIDDLE
    """Where in its box its depth is read."""
    enough: float = ENOUGH

    def middle_m(self, width_m: float, *, cut: bool = False) -> float:
        """Return how far its middle lies behind where its depth is read [m].

        What is large shows its broad side or its narrow one: a box of sides L and S, turned
        anyhow, shows about as much more in width as it has less in depth.

        Args:
            width_m: so wide as it shows.
            cut: the picture's edge cuts it off: nobody knows which side that is.
        """
        if self.reach_m < LARGE_M:
            narrow = self.reach_m < 0.2 and not cut
            return min(self.behind_m, width_m / 2) if narrow else self.behind_m
        if cut:
            return CUT_SHARE * self.behind_m
        behind_m = self.reach_m + self.behind_m - width_m / 2
        return min(max(behind_m, self.behind_m), self.reach_m) - READ_BEHIND_M

    def nearest_m(self, width_px: float, height_px: float, focal_px: float) -> float:
        """Return how far away a box of it must be at least [m]; 0 where nobody can tell.

        It may be hidden in part: then one of width and height shows whole.
        """
        if not (width_px > 0.0 and height_px > 0.0):
            return 0.0
        return focal_px * min(self.least_m[0] / width_px, self.least_m[1] / height_px)


def _k(
    id_: str,
    sizes: tuple[float, float, float] = (0.15, 0.10, 0.30),
    *,
    perched: bool = False,
    mobile: bool = False,
    least_m: tuple[float, float] = (0.0, 0.0),
    part: tuple[float, float, float, float] = MIDDLE,
    enough: float = ENOUGH,
) -> Kind:
    """Return a kind of its (reach, behind, height)."""
    return Kind(
        id_, *sizes, perched=perched, mobile=mobile, least_m=least_m, part=part, enough=enough
    )


TOP = (0.15, 0.03, 0.85, 0.45)
"""Of what stands on legs: below, one looks through it, or something stands before it."""
HIGH = (0.30, 0.05, 0.70, 0.50)
_CUTLERY = (0.10, 0.02, 0.03)
_FRUIT = (0.06, 0.04, 0.08)
_FOOD = (0.10, 0.06, 0.08)
_VEHICLE = (2.2, 0.9, 1.6)
_ANIMAL = (0.9, 0.4, 1.3)

HOME: tuple[Kind, ...] = (
    _k("person", (0.30, 0.12, 1.65), mobile=True, part=HIGH, least_m=(0.25, 0.9)),
    _k("chair", (0.30, 0.04, 0.90), part=TOP, enough=0.15, least_m=(0.30, 0.70)),
    _k("sofa", (1.05, 0.42, 0.80), least_m=(0.7, 0.6)),
    _k("table", (0.65, 0.33, 0.70), part=TOP, enough=0.2),
    _k("bed", (1.05, 0.80, 0.50), least_m=(0.8, 0.35)),
    _k("tv", (0.55, 0.05, 0.60), perched=True),
    _k("fridge", (0.40, 0.33, 1.70), least_m=(0.45, 0.8)),
    _k("plant", (0.22, 0.18, 0.80)),
    _k("door", (0.45, 0.03, 2.00), least_m=(0.0, 1.8)),
    _k("box", (0.20, 0.14, 0.28)),
    _k("cup", (0.05, 0.04, 0.10), perched=True),
    _k("ball", (0.12, 0.10, 0.20)),
    _k("bottle", (0.05, 0.04, 0.26), perched=True),
    _k("book", (0.13, 0.05, 0.10), perched=True),
)  # fmt: skip

COCO: tuple[Kind, ...] = (
    _k("bicycle", (0.85, 0.30, 1.00)),
    _k("car", _VEHICLE),
    _k("motorcycle", (1.05, 0.35, 1.10)),
    _k("airplane", (5.0, 2.0, 4.0)),
    _k("bus", (5.0, 1.3, 3.0)),
    _k("train", (10.0, 1.5, 3.5)),
    _k("truck", (3.5, 1.2, 2.8)),
    _k("boat", (2.5, 1.0, 1.5)),
    _k("traffic_light", (0.20, 0.12, 0.80), perched=True),
    _k("fire_hydrant", (0.20, 0.15, 0.75)),
    _k("stop_sign", (0.38, 0.03, 0.75), perched=True),
    _k("parking_meter", (0.15, 0.10, 1.30)),
    _k("bench", (0.60, 0.22, 0.50)),
    _k("bird", (0.12, 0.06, 0.15), perched=True, mobile=True),
    _k("cat", (0.25, 0.10, 0.28), mobile=True),
    _k("dog", (0.40, 0.14, 0.50), mobile=True),
    _k("horse", _ANIMAL, mobile=True),
    _k("sheep", (0.55, 0.25, 0.80), mobile=True),
    _k("cow", _ANIMAL, mobile=True),
    _k("elephant", (2.2, 1.0, 2.8), mobile=True),
    _k("bear", _ANIMAL, mobile=True),
    _k("zebra", _ANIMAL, mobile=True),
    _k("giraffe", (1.2, 0.5, 4.5), mobile=True),
    _k("backpack", (0.20, 0.13, 0.45)),
    _k("umbrella", (0.35, 0.10, 0.60)),
    _k("handbag", (0.18, 0.08, 0.28), perched=True),
    _k("tie", (0.10, 0.02, 0.50), perched=True),
    _k("suitcase", (0.25, 0.15, 0.65)),
    _k("frisbee", (0.14, 0.08, 0.04)),
    _k("skis", (0.80, 0.05, 0.15)),
    _k("snowboard", (0.75, 0.10, 0.20)),
    _k("kite", (0.50, 0.05, 0.60), perched=True),
    _k("baseball_bat", (0.42, 0.03, 0.08)),
    _k("baseball_glove", (0.15, 0.08, 0.15), perched=True),
    _k("skateboard", (0.40, 0.10, 0.12)),
    _k("surfboard", (1.00, 0.10, 0.50)),
    _k("tennis_racket", (0.34, 0.03, 0.25)),
    _k("wine_glass", (0.04, 0.04, 0.20), perched=True),
    _k("fork", _CUTLERY, perched=True),
    _k("knife", _CUTLERY, perched=True),
    _k("spoon", _CUTLERY, perched=True),
    _k("bowl", (0.09, 0.07, 0.08), perched=True),
    _k("banana", _FRUIT, perched=True),
    _k("apple", _FRUIT, perched=True),
    _k("sandwich", _FOOD, perched=True),
    _k("orange", _FRUIT, perched=True),
    _k("broccoli", _FOOD, perched=True),
    _k("carrot", _FOOD, perched=True),
    _k("hot_dog", _FOOD, perched=True),
    _k("pizza", (0.17, 0.12, 0.05), perched=True),
    _k("donut", _FRUIT, perched=True),
    _k("cake", (0.13, 0.10, 0.12), perched=True),
    _k("toilet", (0.35, 0.25, 0.60)),
    _k("laptop", (0.19, 0.10, 0.22), perched=True),
    _k("mouse", (0.06, 0.03, 0.04), perched=True),
    _k("remote", (0.10, 0.02, 0.03), perched=True),
    _k("keyboard", (0.22, 0.07, 0.03), perched=True),
    _k("cell_phone", (0.08, 0.02, 0.08), perched=True),
    _k("microwave", (0.26, 0.18, 0.30), perched=True),
    _k("oven", (0.32, 0.28, 0.80)),
    _k("toaster", (0.16, 0.10, 0.20), perched=True),
    _k("sink", (0.30, 0.20, 0.30), perched=True),
    _k("clock", (0.15, 0.04, 0.30), perched=True),
    _k("vase", (0.09, 0.08, 0.28), perched=True),
    _k("scissors", _CUTLERY, perched=True),
    _k("teddy_bear", (0.18, 0.12, 0.35)),
    _k("hair_drier", (0.12, 0.05, 0.20), perched=True),
    _k("toothbrush", (0.09, 0.01, 0.02), perched=True),
)  # fmt: skip

KINDS: dict[str, Kind] = {kind.id: kind for kind in (*HOME, *COCO)}


def kind_of(label: str) -> Kind:
    """Return what is known of a class; of one that is in no table, what is usual."""
    known = KINDS.get(label)
    return known if known is not None else Kind(label)
