"""Play what a domain does while time passes: walkers, doors, ice, pushes, the robot carried.

Knows the domain, the floor and where things stand; no physics and no wire. Each kind of event has a
stream of chance of its own, so that turning one knob changes no other. Counts ticks; owns no clock.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, sin
from random import Random
from typing import TYPE_CHECKING

from sim.site.classes import PERSON_RADIUS_M
from sim.site.objects import LEAF
from sim.site.shapes import Rect
from sim.staging import LEAF_M, walker_names
from sim.walkers import ScriptedWalker, WalkerManner
from sim.walking_floor import WalkingFloor
from wire import Pose2

if TYPE_CHECKING:
    from sim.domain import Domain
    from sim.movable_objects import Things
    from sim.site import Home

WALK_TICKS = 5
"""Ticks between two steps of a walker: 0.05 s."""
SPOTS = 8
PUSH_S = 0.3
START_CLEAR_M = 1.0
CARRY_CLEAR_M = 0.5
"""Beyond both radii: nobody puts a robot down onto a person's feet."""
LEAF_ROOM_M = 0.10
"""A leaf closes only where nothing stands in its way: nobody shuts a door onto somebody."""


@dataclass(frozen=True, slots=True)
class DomainActs:
    """Hold what happens to the home and the robot in one tick."""

    moved: tuple[tuple[str, Pose2 | None], ...] = ()
    """Things that stand elsewhere from now on."""
    ice: tuple[bool, bool] = (False, False)
    """Whether the left and the right wheel have lost their grip."""
    force_n: tuple[float, float] = (0.0, 0.0)
    """With which somebody leans on the robot, x and y in ``map``."""
    carried_to: Pose2 | None = None


class Recurrence:
    """Say in which ticks something that comes again and again holds."""

    def __init__(self, random: Random, every_s: float, for_s: float, tick_s: float) -> None:
        self._random, self._every_s, self._for_s, self._tick_s = random, every_s, for_s, tick_s
        self._begins = self._ends = self._draw(0)

    def _draw(self, tick: int) -> int:
        return tick + max(1, round(self._random.uniform(0.5, 1.5) * self._every_s / self._tick_s))

    def begins(self, tick: int) -> bool:
        """Return whether it begins in this tick; asked once a tick, in order."""
        if self._every_s <= 0.0 or tick != self._begins:
            return False
        self._ends = tick + round(self._for_s / self._tick_s)
        self._begins = self._draw(self._ends)
        return True

    def holds(self, tick: int) -> bool:
        """Return whether it began and has not ended."""
        return tick < self._ends and self._begins > self._ends


class DomainScript:
    """Play one domain in one home."""

    def __init__(
        self, domain: Domain, home: Home, things: Things, robot_radius_m: float, tick_s: float
    ) -> None:
        """Take the staged home (sim.staging), in which walkers are people and leaves objects."""
        self._things, self._radius_m, self._tick_s = things, robot_radius_m, tick_s
        self._chance = {
            part: Random(f"{part} {domain.seed}") for part in ("ice", "push", "carry", "doors")
        }
        self._ice = self._recur("ice", domain.ice_every_s, domain.ice_for_s)
        self._push = self._recur("push", domain.push_every_s, PUSH_S)
        self._carry = self._recur("carry", domain.carry_every_s, tick_s)
        self._slips, self._force_n, self._push_n = (False, False), (0.0, 0.0), domain.push_n
        self._domain = domain
        walks = domain.polite_walkers + domain.blind_walkers > 0
        self.floor = WalkingFloor(home) if walks or domain.carry_every_s > 0.0 else None
        self.walkers = tuple(self._walkers(home))
        self.leaves = {
            name: _leaf_rect(one.at, one.size_m[1], upright=abs(one.yaw) < 1.0)
            for name, one in home.objects.items()
            if name.startswith(LEAF)
        }
        """The outline of each leaf, shut."""
        self._due = {name: self._door_ticks(domain.door_open_s) for name in self.leaves}

    def start(self, robot: Pose2) -> DomainActs:
        """Open all leaves, and make room where the robot is put down first."""
        moved: list[tuple[str, Pose2 | None]] = [(name, None) for name in self.leaves]
        for walker in self.walkers:
            if self.floor is not None and walker.gap_m(robot, self._radius_m) < START_CLEAR_M:
                random = Random(f"start {walker.name} {self._domain.seed}")
                away = [(robot.x_m, robot.y_m, START_CLEAR_M + 1.0)]
                walker.stand_at(*self.floor.draw_spot(random, away))
                moved.append((walker.name, Pose2(walker.x_m, walker.y_m, 0.0)))
        return DomainActs(moved=tuple(moved))

    def turn(self, tick: int, robot: Pose2) -> DomainActs:
        """Return what happens in a tick."""
        if self._ice.begins(tick):
            self._slips = self._chance["ice"].choice(((True, True), (True, False), (False, True)))
        if self._push.begins(tick):
            angle_rad = self._chance["push"].uniform(-pi, pi)
            self._force_n = (self._push_n * cos(angle_rad), self._push_n * sin(angle_rad))
        ice = self._slips if self._ice.holds(tick) else (False, False)
        # On ice 120 N fling 20 kg away at 1.8 m/s: a wall it hits then is not the robot's doing.
        leans = self._push.holds(tick) and not any(ice)
        return DomainActs(
            moved=(*self._walk(tick, robot), *self._swing(tick, robot)),
            ice=ice,
            force_n=self._force_n if leans else (0.0, 0.0),
            carried_to=self._spot() if self._carry.begins(tick) else None,
        )

    def shut_leaves(self) -> list[Rect]:
        """Return the outlines of the leaves that stand shut now."""
        return [leaf for name, leaf in self.leaves.items() if self._is_shut(name)]

    def _recur(self, part: str, every_s: float, for_s: float) -> Recurrence:
        return Recurrence(self._chance[part], every_s, for_s, self._tick_s)

    def _walkers(self, home: Home) -> list[ScriptedWalker]:
        if self.floor is None:
            return []
        spots_by = Random(f"spots {self._domain.seed}")
        spots = [self.floor.draw_spot(spots_by, ()) for _ in range(SPOTS)]
        found = []
        for name in walker_names(self._domain):
            random = Random(f"{name} {self._domain.seed}")
            mine = random.sample(spots, len(spots))
            speed_mps = random.uniform(0.5, self._domain.walker_speed_mps)
            manner = WalkerManner(name.split("_")[0])
            at = home.people[name].at
            found.append(ScriptedWalker(name, manner, self.floor, mine, speed_mps, at))
        for spot in spots if found else ():
            self.floor.prepare(spot)
        return found

    def _walk(self, tick: int, robot: Pose2) -> list[tuple[str, Pose2]]:
        if tick % WALK_TICKS != 0:
            return []
        shut = self.shut_leaves()
        moved = []
        for walker in self.walkers:
            stands = self._things.pose_of(walker.name)
            if stands is None:
                continue  # a test took it away
            if (stands.x_m, stands.y_m) != (walker.x_m, walker.y_m):
                walker.stand_at(stands.x_m, stands.y_m)  # a test carried it
            pose = walker.step(WALK_TICKS * self._tick_s, robot, self._radius_m, shut)
            if pose is not None:
                moved.append((walker.name, pose))
        return moved

    def _swing(self, tick: int, robot: Pose2) -> list[tuple[str, Pose2 | None]]:
        """Open and shut the leaves that are due."""
        moved: list[tuple[str, Pose2 | None]] = []
        if self._domain.door_open_s <= 0.0:
            return moved
        for name, leaf in self.leaves.items():
            if tick < self._due[name]:
                continue
            shut = self._is_shut(name)
            if not shut and not self._has_room(leaf, robot):
                continue  # it tries again in the next tick
            moved.append((name, None if shut else self._things.declared[name]))
            lasts_s = self._domain.door_open_s if shut else self._domain.door_shut_s
            self._due[name] = tick + self._door_ticks(lasts_s)
        return moved

    def _has_room(self, leaf: Rect, robot: Pose2) -> bool:
        if not leaf.distance(robot.x_m, robot.y_m) >= self._radius_m + LEAF_ROOM_M:
            return False
        people = (self._things.pose_of(name) for name in self._things.people)
        return all(
            leaf.distance(one.x_m, one.y_m) >= PERSON_RADIUS_M + LEAF_ROOM_M
            for one in people
            if one is not None
        )

    def _is_shut(self, name: str) -> bool:
        return self._things.pose_of(name) is not None

    def _door_ticks(self, mean_s: float) -> int:
        return max(1, round(self._chance["doors"].uniform(0.5, 1.5) * mean_s / self._tick_s))

    def _spot(self) -> Pose2 | None:
        """Return where the robot is put down."""
        if self.floor is None:
            return None
        far_m = self._radius_m + PERSON_RADIUS_M + CARRY_CLEAR_M
        people = (self._things.pose_of(name) for name in self._things.people)
        away = [(one.x_m, one.y_m, far_m) for one in people if one is not None]
        x_m, y_m = self.floor.draw_spot(self._chance["carry"], away)
        return Pose2(x_m, y_m, self._chance["carry"].uniform(-pi, pi))


def _leaf_rect(at: tuple[float, float], width_m: float, *, upright: bool) -> Rect:
    half = (LEAF_M / 2, width_m / 2) if upright else (width_m / 2, LEAF_M / 2)
    return Rect(at[0] - half[0], at[1] - half[1], at[0] + half[0], at[1] + half[1])
