"""Find in the simulator's truth what a detector would find in a picture: no pixel is drawn.

What is in the field of view, large enough and not hidden is found, with noise, misses, wrong
colours and ghosts by seed. Stands in for camera and detector together; ``Finder`` is what another
pair of them would be.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, sqrt, tan
from random import Random
from typing import TYPE_CHECKING, Protocol

from planner.perception.pose_buffer import Stance
from planner.perception.projection import View, pixel_of
from planner.perception.snapshot import Detection
from sim.site import Home, solids
from sim.site.classes import CLASSES, COLORS, PERSON_HEIGHT_M, PERSON_RADIUS_M
from sim.site.objects import furniture_class, ground_m, rest_m
from sim.site.plan import furniture_shape
from sim.site.shapes import Disc, Solid
from tools.lockstep.line_of_sight import is_hidden
from wire import ImageHeader

if TYPE_CHECKING:
    from collections.abc import Iterator

    from sim import SimRobot
    from wire import CameraConfig

NAMES = tuple(name for name in CLASSES if name != "door")


class Finder(Protocol):
    """Be a camera and a detector in one."""

    def find(self, sim: SimRobot, header: ImageHeader) -> tuple[Detection, ...]:
        """Return what is found in a picture taken now."""


@dataclass(frozen=True, slots=True)
class Sharpness:
    """Say how well is seen. The defaults are worse than a good detector in a tidy home."""

    miss: float = 0.08
    """Share of the things in view that one look misses."""
    wrong_color: float = 0.03
    ghosts: float = 0.003
    """Things in one look that are nowhere."""
    smallest_px: float = 7.0
    """What shows smaller is not found."""
    depth_noise: float = 0.015
    """Of the distance."""
    edge_px: float = 1.5
    """Noise of a box's edges."""


@dataclass(frozen=True, slots=True)
class VisibleThing:
    """Hold one thing as it stands now."""

    id: str
    label: str
    color: str | None
    x_m: float
    y_m: float
    low_m: float
    """Height of its foot above the floor."""
    breadth_m: float
    depth_m: float
    """Its lesser extent on the floor plane."""
    height_m: float


class TruthFinder:
    """Look at the simulator's truth."""

    def __init__(self, camera: CameraConfig, seed: int, sharpness: Sharpness | None = None) -> None:
        self._camera = camera
        self._random = Random(f"eyes {seed}")
        self.sharpness = sharpness or Sharpness()
        self._solids: tuple[Solid, ...] = ()

    def find(self, sim: SimRobot, header: ImageHeader) -> tuple[Detection, ...]:
        """Return what is found from where the robot truly is."""
        view = View(header, self._camera, Stance(sim.base_in_map))
        things = list_visible(sim)
        self._solids = self._solids or tuple(solids(sim.home))  # of one home: finding walls is slow
        blocks = (*self._solids, *_bodies(things))
        found = [
            seen for thing in things if (seen := self._detect(view, thing, blocks)) is not None
        ]
        if self._random.random() < self.sharpness.ghosts:
            found.append(self._ghost(header))
        return tuple(found)

    def _detect(
        self, view: View, thing: VisibleThing, blocks: tuple[Solid, ...]
    ) -> Detection | None:
        r, sharp, camera = self._random, self.sharpness, view.camera_in_map
        missed, color_wrong = r.random() < sharp.miss, r.random() < sharp.wrong_color
        noise = [r.gauss(0.0, 1.0) for _ in range(5)]
        middle = pixel_of(view, thing.x_m, thing.y_m, thing.low_m + thing.height_m / 2)
        if middle is None or missed:
            return None
        depth_m = middle[2] - thing.depth_m / 2
        if not self._camera.depth_min_m <= depth_m <= self._camera.depth_max_m:
            return None
        focal = view.header.focal_px
        down_m = self._camera.z_m - thing.low_m - thing.height_m / 2
        down = max(0.0, down_m) / hypot(down_m, middle[2])  # sine: what lies flat shows its top
        upright_m = thing.height_m * sqrt(1.0 - down * down) + thing.depth_m * down
        wide, high = (extent * focal / middle[2] for extent in (thing.breadth_m, upright_m))
        whole = (middle[0] - wide / 2, middle[1] - high / 2, middle[0] + wide / 2,
                 middle[1] + high / 2)  # fmt: skip
        box = _clip(whole, view.header)
        if box is None or min(wide, high) < sharp.smallest_px:
            return None
        eye = (camera.x_m, camera.y_m, self._camera.z_m)
        heights = (thing.low_m + share * thing.height_m for share in (0.35, 0.65, 0.95))
        others = [b for b in blocks if b.shape.distance(thing.x_m, thing.y_m) > 0.0]
        clear = sum(not is_hidden(eye, (thing.x_m, thing.y_m, z_m), others) for z_m in heights)
        if clear < 2:
            return None
        color = thing.color if not color_wrong else r.choice(COLORS)
        left, top, right, bottom = (a + sharp.edge_px * n for a, n in zip(box, noise, strict=False))
        return Detection(
            thing.label,
            0.85,
            (left, top, max(right, left + 1.0), max(bottom, top + 1.0)),
            color,
            depth_m * (1.0 + sharp.depth_noise * noise[4]),
            0.02,
        )

    def _ghost(self, header: ImageHeader) -> Detection:
        r = self._random
        u, v, side = r.uniform(0, header.width), r.uniform(0.4, 1.0) * header.height, 20.0
        box = (u - side / 2, v - side / 2, u + side / 2, v + side / 2)
        return Detection(r.choice(NAMES), 0.6, box, r.choice(COLORS), r.uniform(1.0, 4.0), 0.05)


def list_visible(sim: SimRobot) -> tuple[VisibleThing, ...]:
    """Return everything that a camera could see, where it is now."""
    return (*_furniture(sim.home), *_objects(sim), *_people(sim))


def _furniture(home: Home) -> Iterator[VisibleThing]:
    for item_id, item in home.furniture.items():
        label = furniture_class(item_id, item)
        if label == "none":
            continue
        box = furniture_shape(item).bounds
        sides = sorted((box.x1 - box.x0, box.y1 - box.y0))
        at = (box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2, 0.0
        yield VisibleThing(item_id, label, item.color, *at, sides[1], sides[0], item.height_m)


def _objects(sim: SimRobot) -> Iterator[VisibleThing]:
    for name, item in sim.home.objects.items():
        pose = sim.things.pose_of(name) if item.class_id != "door" else None
        if pose is None:
            continue
        moved = (pose.x_m, pose.y_m) != tuple(item.at)
        low_m = ground_m(sim.home, pose.x_m, pose.y_m) if moved else rest_m(sim.home, item)
        sides = sorted(item.size_m[:2])
        at = pose.x_m, pose.y_m, low_m
        yield VisibleThing(name, item.class_id, item.color, *at, sides[1], sides[0], item.size_m[2])


def _people(sim: SimRobot) -> Iterator[VisibleThing]:
    people = {who: one.color for who, one in sim.home.people.items()}
    people |= {name: None for name in sim.things.declared if name.startswith("person_")}
    breadth_m = 2 * PERSON_RADIUS_M
    for who, color in people.items():
        pose = sim.things.pose_of(who)
        if pose is not None:
            at = pose.x_m, pose.y_m, 0.0
            yield VisibleThing(who, "person", color, *at, breadth_m, breadth_m, PERSON_HEIGHT_M)


def _bodies(things: tuple[VisibleThing, ...]) -> tuple[Solid, ...]:
    """Return people and what stands high on the floor, as what hides."""
    return tuple(
        Solid(t.id, Disc(t.x_m, t.y_m, t.breadth_m / 2), t.height_m)
        for t in things
        if t.label == "person"
    )


def _clip(
    box: tuple[float, float, float, float], header: ImageHeader
) -> tuple[float, float, float, float] | None:
    """Return the part of a box that is in the picture, where that is more than half of it."""
    left, top = max(0.0, box[0]), max(0.0, box[1])
    right, bottom = min(float(header.width), box[2]), min(float(header.height), box[3])
    if not (left < right and top < bottom):
        return None
    whole = (box[2] - box[0]) * (box[3] - box[1])
    return (left, top, right, bottom) if (right - left) * (bottom - top) > 0.5 * whole else None


def header_of(camera: CameraConfig, seq: int, now_s: float) -> ImageHeader:
    """Return the header of a picture by this camera."""
    return ImageHeader(
        boot_id="lockstep",
        seq=seq,
        stamp_s=now_s,
        width=camera.width_px,
        height=camera.height_px,
        focal_px=camera.width_px / 2 / tan(camera.fov_rad / 2),
        center_x_px=camera.width_px / 2,
        center_y_px=camera.height_px / 2,
    )
