"""Choose where a camera stands and looks: mostly at something, sometimes anywhere.

What is looked at is drawn class by class, so that cups are seen as often as chairs.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, hypot, pi
from typing import TYPE_CHECKING

from sim.site.objects import furniture_class, uprights
from sim.site.plan import furniture_shape, solids
from wire import CameraConfig, Pose2
from wire.geometry import wrap

if TYPE_CHECKING:
    from random import Random

    from sim.site import Home, Solid

LOOKED_AT = 0.75
NEAR_M, FAR_M = 0.5, 6.0
AIM_RAD = 0.3
"""How far off the middle of the picture a thing that is looked at lies, one standard deviation."""
CLEAR_M = 0.32
"""From the robot's middle to anything solid: it has a radius of 0.30 m."""
TRIES = 40


@dataclass(frozen=True, slots=True)
class ViewTarget:
    """Name a thing to look at."""

    class_id: str
    x_m: float
    y_m: float


def targets(home: Home) -> list[ViewTarget]:
    """Return all that has a class of ours."""
    found = [
        ViewTarget(class_id, (box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2)
        for item_id, item in home.furniture.items()
        if (class_id := furniture_class(item_id, item)) != "none"
        for box in (furniture_shape(item).bounds,)
    ]
    found += [ViewTarget(item.class_id, *item.at) for item in home.objects.values()]
    return found + [ViewTarget("person", *person.at) for person in home.people.values()]


def camera(random: Random) -> CameraConfig:
    """Mount the usual camera, or one a little higher or lower, wider or narrower, and tilted."""
    if random.random() < 0.5:
        return CameraConfig()
    return CameraConfig(
        z_m=random.uniform(0.75, 1.25),
        pitch_rad=random.uniform(0.05, 0.4),
        fov_rad=random.uniform(1.05, 1.35),
    )


class Views:
    """Draw poses of the robot in one home."""

    def __init__(self, home: Home) -> None:
        self._rooms = list(home.rooms.values())
        self._solid: list[Solid] = [*solids(home), *(thing.solid for thing in uprights(home))]
        self._by_class: dict[str, list[ViewTarget]] = {}
        for target in targets(home):
            self._by_class.setdefault(target.class_id, []).append(target)

    def draw_pose(self, random: Random) -> Pose2:
        """Return a pose where a robot can stand.

        Raises:
            ValueError: the home has no free floor.
        """
        for _ in range(TRIES):
            aimed = self._by_class and random.random() < LOOKED_AT
            pose = self._aim(random) if aimed else self._anyhow(random)
            if pose is not None:
                return pose
        raise ValueError("no free floor was found")

    def _anyhow(self, random: Random) -> Pose2 | None:
        room = random.choice(self._rooms)
        x, y = random.uniform(room.box[0], room.box[2]), random.uniform(room.box[1], room.box[3])
        return Pose2(x, y, random.uniform(-pi, pi)) if self._free(x, y) else None

    def _aim(self, random: Random) -> Pose2 | None:
        target = random.choice(self._by_class[random.choice(sorted(self._by_class))])
        for _ in range(TRIES):
            pose = self._anyhow(random)
            if pose is None or not self._same_room(pose, target):
                continue
            away = hypot(target.x_m - pose.x_m, target.y_m - pose.y_m)
            # Near views are as likely as far ones: there is more floor far away.
            if NEAR_M <= away <= FAR_M and random.random() < min(1.0, 1.8 / away):
                bearing = atan2(target.y_m - pose.y_m, target.x_m - pose.x_m)
                return Pose2(pose.x_m, pose.y_m, wrap(bearing + random.gauss(0.0, AIM_RAD)))
        return None

    def _same_room(self, pose: Pose2, target: ViewTarget) -> bool:
        return any(
            room.box[0] <= pose.x_m <= room.box[2]
            and room.box[1] <= pose.y_m <= room.box[3]
            and room.box[0] - 0.1 <= target.x_m <= room.box[2] + 0.1
            and room.box[1] - 0.1 <= target.y_m <= room.box[3] + 0.1
            for room in self._rooms
        )

    def _free(self, x_m: float, y_m: float) -> bool:
        return all(solid.shape.distance(x_m, y_m) >= CLEAR_M for solid in self._solid)
