"""Stand something on the goal, or shut the door to it: how and when the drive ends.

In lockstep on the default home; localization is by scans. Judged on the simulator's truth: a robot
has arrived beside a goal within 1.5 m of it. It visits a door each time that it comes within 1 m
from farther than 1.5 m.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from math import cos, hypot, pi, sin
from random import Random
from typing import TYPE_CHECKING, Any

from planner.navigation import RouteRequest
from planner.plan import GoalState
from pons.settings import CHECKOUT
from sim import Domain
from sim.site import pose2
from sim.site.objects import LEAF
from tools.bench.report import ReportRow, row_of
from tools.lockstep import LockstepWorld
from wire import Pose2, RobotDescription
from wire.robot import LocalizationConfig

if TYPE_CHECKING:
    from collections.abc import Iterable

    from tools.bench.context import BenchLab
    from tools.lockstep.goal_handle import GoalHandle

NAME = "shut_ways"
TITLE = "goals that are occupied, doors that are shut"
LONG_ONLY = True
SITE = CHECKOUT / "sites" / "home"
OCCUPIED = 50
THINGS = ("person_0", "crate_0", "carton")
"""The carton is as large as a chair."""
ASIDE_M = 0.2
"""Off the goal's middle, at most."""
BESIDE_M = 1.5
NEAR_M, FAR_M = 1.0, 1.5
LIMIT_S = 240.0
DOORS = 7
NO_LEAF = 16
"""More doors than the home has: every one gets a leaf."""


@dataclass(frozen=True, slots=True)
class ShutWayDrive:
    """Hold what one drive came to."""

    name: str
    code: str
    """How the goal ended: its outcome's code."""
    took_s: float
    beside_s: float | None
    """From arriving beside the goal, or at the door, until the end."""
    driven_share: float
    """Driven over shortest, as the map has it."""
    visits: int
    """Of the goal or the shut door."""
    contacts: int
    said: str
    again_s: float | None = None
    """Once the door was opened and the goal given anew: until it was reached."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Occupy 50 goals and shut each door in a long run, 2 of each in a quick one."""
    count, doors = lab.count(2, OCCUPIED), lab.count(2, DOORS)
    goals = [ShutWayDrive(**one) for one in lab.side_by_side("goal", count, occupy)]
    shut = [ShutWayDrive(**one) for one in lab.side_by_side("door", doors, shut_door)]
    ended = sorted({one.code for one in (*goals, *shut)})
    beside = [one.beside_s for one in goals if one.beside_s is not None]
    waits = [one.beside_s for one in shut if one.beside_s is not None]
    opened = [one.again_s for one in shut if one.again_s is not None]
    return [
        row_of("goal occupied: beside it -> ended", "s", "<= 30", beside, ", ".join(ended)),
        row_of("goal occupied: visits", "", "<= 2", [float(o.visits) for o in goals]),
        row_of("goal occupied: driven", "x", "<= 1.3", [one.driven_share for one in goals]),
        row_of("door shut: at it -> ended", "s", "20 s + drive", waits),
        row_of("door shut: visits", "", "<= 2", [float(one.visits) for one in shut]),
        row_of("door opened again: reached", "s", "<= 60", opened, f"{len(opened)} of {doors}"),
        _count("contacts", (one.contacts for one in (*goals, *shut))),
    ]  # fmt: skip


def _count(what: str, figures: Iterable[int]) -> ReportRow:
    found = list(figures)
    return ReportRow(what, "", "0", value=str(sum(found)), note=f"n {len(found)}")


def occupy(seed: int) -> dict[str, Any]:
    """Stand a thing on the goal of a drive from one room to another."""
    random, world = Random(f"occupied {seed}"), _world(seed, Domain())
    home = world.sim.home
    room = home.rooms[random.choice(sorted(set(home.rooms) - {"hallway"}))]
    pose, away_m, angle = pose2(room.pose), random.uniform(0.0, ASIDE_M), random.uniform(-pi, pi)
    thing = THINGS[seed % len(THINGS)]
    at = Pose2(pose.x_m + away_m * cos(angle), pose.y_m + away_m * sin(angle), angle)
    world.sim.place_thing(thing, at)
    drive = _WatchedDrive(world, (pose.x_m, pose.y_m), BESIDE_M)
    return asdict(
        drive.run(world.say(f"go to the {room.name.en}"), f"{thing} {room.name.en}", pose)
    )


def shut_door(number: int) -> dict[str, Any]:
    """Shut a door of the home, drive to behind it; where that fails, open it and drive anew."""
    world = _world(number, Domain(doors=NO_LEAF, door_open_s=0.0))
    home, leaf = world.sim.home, f"{LEAF}{number}"
    door = home.doors[number]
    first, second = (home.rooms[room] for room in door.between)
    room = first if door.between[1] == "hallway" else second
    pose = pose2(room.pose)
    world.sim.place_thing(leaf, world.sim.things.declared[leaf])
    drive = _WatchedDrive(world, door.at, NEAR_M)
    told = drive.run(world.say(f"go to the {room.name.en}"), f"{room.name.en}, {leaf}", pose)
    world.sim.place_thing(leaf, None)
    if told.code != "blocked":
        return asdict(told)
    began_s, again = world.now_s, world.say(f"go to the {room.name.en}")
    while not again.has_ended and world.now_s < began_s + LIMIT_S:
        world.tick()
    reached = again.state is GoalState.SUCCEEDED
    return {**asdict(told), "again_s": world.now_s - began_s if reached else None}


def _world(seed: int, domain: Domain) -> LockstepWorld:
    robot = RobotDescription(localization=LocalizationConfig(kind="scans"))
    return LockstepWorld(site=SITE, seed=seed + 1, robot=robot, domain=domain)


class _WatchedDrive:
    """Drive one goal, and count how often the robot comes near a spot."""

    def __init__(self, world: LockstepWorld, spot: tuple[float, float], near_m: float) -> None:
        self._world, self._spot, self._near_m = world, spot, near_m
        self._is_near, self._visits, self._driven_m = False, 0, 0.0
        self._near_s: float | None = None

    def run(self, goal: GoalHandle, name: str, pose: Pose2) -> ShutWayDrive:
        """Let time pass until the goal has ended."""
        world, began_s, touched = self._world, self._world.now_s, self._world.contacts
        shortest_m = world.scene.router.route(RouteRequest(world.truth, pose)).length_m
        while not goal.has_ended and world.now_s < began_s + LIMIT_S:
            self._look()
        outcome = goal.record.outcome
        return ShutWayDrive(
            name=name,
            code=outcome.code.value if outcome is not None else "never ended",
            took_s=world.now_s - began_s,
            beside_s=None if self._near_s is None else world.now_s - self._near_s,
            driven_share=self._driven_m / max(1.0, shortest_m),
            visits=self._visits,
            contacts=world.contacts - touched,
            said=outcome.message.en if outcome is not None else "",
        )

    def _look(self) -> None:
        world, before = self._world, self._world.truth
        world.tick()
        here = world.truth
        self._driven_m += hypot(here.x_m - before.x_m, here.y_m - before.y_m)
        away_m = hypot(here.x_m - self._spot[0], here.y_m - self._spot[1])
        if self._is_near:
            self._is_near = away_m <= max(FAR_M, self._near_m + 0.5)
        elif away_m <= self._near_m:
            self._is_near, self._visits = True, self._visits + 1
            self._near_s = self._near_s if self._near_s is not None else world.now_s
